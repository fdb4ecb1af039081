#include "rbpf/TargetMixture.h"

#include <gtest/gtest.h>
#include <slamot/math/random.h>

#include <numeric>

namespace slamot::filters::rbpf
{
namespace
{
using math::RandomStream;
using Motion = models::ConstantVelocityTarget;
using State = Motion::State;
using Mixture = TargetMixture<Motion>::Mixture;
using Vector4 = Eigen::Vector4d;

constexpr double kRange = 0.5, kBearing = 0.02, kReach = 60, kSeen = 0.9;

template <int N>
double gauss(const Eigen::Matrix<double, N, 1>& d, const Eigen::Matrix<double, N, N>& cov)
{
  return std::exp(-0.5 * d.dot(cov.inverse() * d)) / std::sqrt((math::kTwoPi * cov).determinant());
}

/// A few targets and blobs of them, seen from the origin.
class MixtureOfTargets : public ::testing::Test
{
 protected:
  static TargetSetSettings settings()
  {
    return {{0.01, 1e-6, 4, 0, 100, 0.5, 0.02}, 0.9, kSeen, 0.5};
  }
  std::uint64_t add(const Vector4& x, const Eigen::Matrix4d& P, double weight,
                    const std::string& label = "target", int id = core::kNoId)
  {
    core::Blob of = blob({x[0], x[1]});
    of.label = label;
    of.id = id;
    const std::uint64_t key = labels.birthKeys({of}, ++births).front();
    labels.add(key, of, 0);
    mixture.push_back({State{x, P}, weight, key});
    return key;
  }
  std::uint64_t add(const Point2D& at, double weight, const std::string& label = "target",
                    int id = core::kNoId)
  {
    return add({at.x, at.y, 0, 0}, 0.04 * Eigen::Matrix4d::Identity(), weight, label, id);
  }
  static core::Blob blob(const Point2D& at)
  {
    return {"target", std::hypot(at.x, at.y), std::atan2(at.y, at.x), kRange, kBearing};
  }
  void look(std::vector<core::Blob> blobs)
  {
    scan.fov = {0, kReach, -math::kPi, math::kPi};
    scan.blobs = std::move(blobs);
    rays.blobs = &scan.blobs;
    rays.rays.clear();
    for (const core::Blob& b : scan.blobs)
      rays.rays.push_back(b.range ? Ray::of(*b.range, b.bearing, kRange, kBearing)
                                  : Ray::ofBearing(b.bearing, kBearing));
    targets.begin(scan, rays, 1000 + ++births, std::vector<double>(labels.list().size(), 1.0));
  }
  double update() { return targets.update(mixture, Eye(Pose2D{}), matches, scratch); }
  [[nodiscard]] double total() const
  {
    return std::accumulate(mixture.begin(), mixture.end(), 0.0,
                           [](double sum, const auto& c) { return sum + c.weight; });
  }
  [[nodiscard]] double total(std::uint64_t key) const
  {
    double sum = 0;
    for (const auto& c : mixture) sum += c.label == key ? c.weight : 0;
    return sum;
  }
  /// A few components and blobs, any of which may be of any; some blobs without a range.
  void drawCase(RandomStream& random, int components, int blobs)
  {
    mixture.clear();
    for (int j = 0; j < components; ++j)
    {
      Eigen::Matrix4d A;
      for (double& a : A.reshaped()) a = 0.3 * random.normal();
      add({40 + random.uniform(-1, 1), random.uniform(-1, 1), random.normal(), random.normal()},
          A * A.transpose() + 0.05 * Eigen::Matrix4d::Identity(), random.uniform(0.05, 1.4));
    }
    std::vector<core::Blob> seen;
    for (int k = 0; k < blobs; ++k)
    {
      seen.push_back(blob({40 + random.uniform(-1, 1), random.uniform(-1, 1)}));
      if (random.uniform() < 0.3) seen.back().range.reset();
    }
    look(seen);
  }
  /// p_D w q of a component and a blob, straight from the definition.
  [[nodiscard]] double term(const Mixture::value_type& c, const core::Blob& b) const
  {
    const double x = c.state.x[0], y = c.state.x[1], r = std::hypot(x, y);
    Eigen::Matrix<double, 2, 4> H = Eigen::Matrix<double, 2, 4>::Zero();
    H.leftCols<2>() << x / r, y / r, -y / (r * r), x / (r * r);
    Matrix2 S = H * c.state.P * H.transpose();
    S(0, 0) += kRange * kRange;
    S(1, 1) += kBearing * kBearing;
    const Vector2 d(b.range.value_or(r) - r, math::wrapToPi(b.bearing - std::atan2(y, x)));
    if (b.range) return kSeen * c.weight * gauss<2>(d, S);
    return kSeen * c.weight * std::exp(-0.5 * d[1] * d[1] / S(1, 1)) /
           std::sqrt(math::kTwoPi * S(1, 1));
  }
  [[nodiscard]] double clutter(const core::Blob& b) const
  {
    return set.clutter / (b.range ? kReach * math::kTwoPi : math::kTwoPi);
  }

  TargetSetSettings set = settings();
  Gates gates{50, 100, 50, 100};
  Motion motion{Motion::Params{1, 0, 0.1}};
  TargetLabels labels{set, {3, 1, 30, 5}};
  TargetMixture<Motion> targets{set, gates, motion, labels};
  TargetMixture<Motion>::Scratch scratch;
  Mixture mixture;
  core::BlobScan scan;
  BlobRays rays;
  std::vector<std::int32_t> matches;
  std::uint64_t births = 0;
};

/// The sum over all ways to give each blob to clutter or a component.
double sumOverWays(const std::vector<std::vector<double>>& terms, std::size_t k = 0)
{
  if (k == terms.size()) return 1;
  double sum = 0;
  for (const double t : terms[k]) sum += t * sumOverWays(terms, k + 1);
  return sum;
}
}  // namespace

TEST_F(MixtureOfTargets, WeighsAParticleByTheSumOverAllWaysToExplainTheScan)
{
  for (std::uint64_t seed = 1; seed <= 80; ++seed)
  {
    RandomStream random{seed};
    drawCase(random, static_cast<int>(seed % 4), static_cast<int>(seed / 4 % 4));
    std::vector<std::vector<double>> terms;
    double expected = 0;
    for (const auto& c : mixture) expected += kSeen * c.weight;
    for (const core::Blob& b : scan.blobs)
    {
      terms.push_back({clutter(b)});
      for (const auto& c : mixture) terms.back().push_back(term(c, b));
    }
    const double direct = std::log(sumOverWays(terms)) - expected;
    EXPECT_NEAR(update(), direct, 1e-9 * (1 + std::abs(direct))) << "seed " << seed;
  }
}

TEST_F(MixtureOfTargets, HasTheWeightsOfTheDefinitionAfterAnUpdate)
{
  for (std::uint64_t seed = 1; seed <= 80; ++seed)
  {
    RandomStream random{seed};
    drawCase(random, static_cast<int>(seed % 4), static_cast<int>(seed / 4 % 4));
    double expected = (1 - kSeen) * total();
    for (const core::Blob& b : scan.blobs)
    {
      double seen = 0;
      for (const auto& c : mixture) seen += term(c, b);
      expected += seen / (clutter(b) + seen);
      if (seen <= clutter(b) && b.range) expected += set.birthWeight;
    }
    update();
    EXPECT_NEAR(total(), expected, 3e-5) << "seed " << seed;  // some are pruned
  }
}

// Closed form: what is seen is Kalman's update with weight 1, what was missed the prior with the
// tenth that a miss leaves; together they have the moments of both.
TEST_F(MixtureOfTargets, OfOneTargetWithoutClutterIsKalmansFilterButForTheMissesTenth)
{
  set.clutter = 1e-12;
  const double w = 1.3;
  Eigen::Matrix4d P = 0.1 * Eigen::Matrix4d::Identity();
  P(0, 2) = P(2, 0) = P(1, 3) = P(3, 1) = 0.05;
  const std::uint64_t key = add({30, 4, 1, -1}, P, w);
  look({blob({30.2, 4.1})});
  const State prior = mixture[0].state;
  State seen = prior;
  correctTarget(motion, seen, Eye(Pose2D{}), rays.rays[0]);
  const double miss = (1 - kSeen) * w;
  const Vector4 mean = (seen.x + miss * prior.x) / (1 + miss);
  const Vector4 a = seen.x - mean, b = prior.x - mean;
  const Eigen::Matrix4d cov =
      (seen.P + a * a.transpose() + miss * (prior.P + b * b.transpose())) / (1 + miss);
  update();
  ASSERT_EQ(mixture.size(), 1u);
  EXPECT_EQ(mixture[0].label, key);
  EXPECT_NEAR(mixture[0].weight, 1 + miss, 1e-9);
  EXPECT_LT((mixture[0].state.x - mean).norm(), 1e-9);
  EXPECT_LT((mixture[0].state.P - cov).norm(), 1e-9);
  EXPECT_EQ(matches, (std::vector<std::int32_t>{0}));
}

TEST_F(MixtureOfTargets, SurvivesByTheSecondWhateverTheSteps)
{
  add({10, 0}, 1);
  add({0, 10}, 0.5);
  for (int n = 0; n < 20; ++n) targets.predict(mixture, 0.1);
  EXPECT_NEAR(mixture[0].weight, 0.81, 1e-12);
  EXPECT_NEAR(mixture[1].weight, 0.405, 1e-12);
  EXPECT_NEAR(mixture[0].state.P(0, 0), 0.04 + 4 * 0.04 + 0.01 * 8.0 / 3, 1e-12);
}

TEST_F(MixtureOfTargets, TakesBlobsOfItsLabelAndIdentityOnly)
{
  const auto robot = add({10, 0}, 0.5, "robot"), plain = add({10, 0}, 0.5),
             seven = add({10, 0}, 0.5, "target", 7), eight = add({10, 0}, 0.5, "target", 8);
  core::Blob b = blob({10, 0});
  b.id = 7;
  look({b});
  update();
  EXPECT_NEAR(total(robot), 0.05, 1e-9);
  EXPECT_NEAR(total(plain), 0.05, 1e-9);
  EXPECT_NEAR(total(eight), 0.05, 1e-9);
  EXPECT_GT(total(seven), 0.9);
  b.id = core::kNoId;  // may be of any target, but of no robot
  look({b});
  update();
  EXPECT_NEAR(total(robot), 0.005, 1e-9);
  EXPECT_GT(total(plain), 0.02);
}

TEST_F(MixtureOfTargets, IsBornSmallFromWhatNothingExplainsAndGrowsWhenSeenAgain)
{
  look({blob({5, 5})});
  update();
  EXPECT_EQ(matches, (std::vector<std::int32_t>{kNew}));
  ASSERT_EQ(mixture.size(), 1u);
  EXPECT_EQ(mixture[0].weight, 0.01);
  EXPECT_EQ(mixture[0].label, targets.birthKey(0));
  const std::uint64_t first = mixture[0].label;
  for (int n = 0; n < 4; ++n)
  {
    labels.add(targets.birthKey(0), scan.blobs[0], 0);
    targets.predict(mixture, 0.1);
    look({blob({5, 5})});
    update();
  }
  EXPECT_GT(total(first), 0.9);
  EXPECT_EQ(mixture.front().label, first);
}

TEST_F(MixtureOfTargets, BearsNothingFromABearingAloneButTakesIt)
{
  const auto key = add({10, 0}, 1);
  core::Blob known = blob({10, 0}), other = blob({-3, 8});
  known.range.reset();
  other.range.reset();
  look({known, other});
  const double before = mixture[0].state.P(1, 1);
  update();
  EXPECT_EQ(matches, (std::vector<std::int32_t>{0, kRejected}));
  ASSERT_EQ(mixture.size(), 1u);
  EXPECT_GT(total(key), 0.9);
  EXPECT_LT(mixture[0].state.P(1, 1), before);
}

TEST_F(MixtureOfTargets, KeepsItsWeightOutOfViewAndIsHalfMissedAtTheEdge)
{
  const auto far = add({80, 0}, 0.7), edge = add({60, 0}, 0.7), near = add({20, 0}, 0.7);
  look({});
  update();
  EXPECT_EQ(total(far), 0.7);
  EXPECT_NEAR(total(edge), 0.7 * 0.55, 1e-9);
  EXPECT_NEAR(total(near), 0.07, 1e-9);
}

TEST_F(MixtureOfTargets, MergesNearOnesUnderTheHeaviestsLabel)
{
  const auto light = add({10, 0.05}, 0.3), heavy = add({10, 0}, 0.6);
  look({});
  update();
  ASSERT_EQ(mixture.size(), 1u);
  EXPECT_EQ(total(light), 0);
  EXPECT_NEAR(total(heavy), 0.09, 1e-9);
}

TEST_F(MixtureOfTargets, KeepsThoseThatCrossApart)
{
  const Eigen::Matrix4d P = 0.04 * Eigen::Matrix4d::Identity();
  add({10, 0, 1, 0}, P, 0.9);
  add({10, 0.05, -1, 0}, P, 0.8);
  look({});
  update();
  EXPECT_EQ(mixture.size(), 2u);
}

TEST_F(MixtureOfTargets, KeepsTwoConfirmedOnesApartUnlessNearlyTheSame)
{
  for (const double apart : {0.2, 0.01})
  {
    mixture.clear();
    const auto a = add({10, 0}, 0.9), b = add({10, apart}, 0.8);
    for (const auto key : {a, b}) labels.settle(labels.find(key), 1);
    look({});
    update();
    EXPECT_EQ(mixture.size(), apart > 0.1 ? 2u : 1u) << apart;
  }
}

TEST_F(MixtureOfTargets, DividesALabelThatHoldsTwo)
{
  const auto key = add({10, 0}, 0.9);
  mixture.push_back(mixture[0]);
  mixture[1].state.x[1] = 3;
  look({blob({10, 0}), blob({10, 3})});
  update();
  ASSERT_EQ(mixture.size(), 2u);
  const double y = mixture[0].label == key ? mixture[1].state.x[1] : mixture[0].state.x[1];
  EXPECT_NE(mixture[0].label, mixture[1].label);
  EXPECT_EQ(total(targets.birthKey(y < 1 ? 0 : 1)), mixture[mixture[0].label == key].weight);
  for (int n = 0; n < 2; ++n)  // one place or the other, but one target
  {
    mixture.resize(1);
    mixture[0].label = key;
    mixture[0].weight = 0.6;
    mixture.push_back(mixture[0]);
    mixture[1].state.x[1] = 3 - mixture[1].state.x[1];
    look({});
    update();
    EXPECT_EQ(mixture[0].label, mixture[1].label);
  }
}

TEST_F(MixtureOfTargets, KeepsTheHeaviestWhereThereAreTooMany)
{
  set.mostComponents = 5;
  std::vector<std::uint64_t> keys;
  for (int j = 0; j < 9; ++j)
    keys.push_back(add({30 * std::cos(0.5 * j), 30 * std::sin(0.5 * j)}, 0.3 + 0.05 * j));
  look({});
  update();
  EXPECT_EQ(mixture.size(), 5u);
  EXPECT_EQ(total(keys[3]), 0);
  EXPECT_GT(total(keys[4]), 0);
}

TEST_F(MixtureOfTargets, DoesNotCareForTheOrderOfBlobs)
{
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
  {
    RandomStream random{seed};
    drawCase(random, 3, 4);
    const Mixture before = mixture;
    const double weight = update();
    const Mixture after = mixture;
    mixture = before;
    std::vector<core::Blob> blobs(scan.blobs.rbegin(), scan.blobs.rend());
    --births;  // the same scan
    look(blobs);
    EXPECT_NEAR(update(), weight, 1e-9) << "seed " << seed;
    ASSERT_EQ(mixture.size(), after.size());
    for (std::size_t j = 0; j < after.size(); ++j)
      EXPECT_NEAR(
          total(after[j].label),
          [&]
          {
            double sum = 0;
            for (const auto& c : after) sum += c.label == after[j].label ? c.weight : 0;
            return sum;
          }(),
          1e-9)
          << "seed " << seed;
  }
}

TEST_F(MixtureOfTargets, StaysPositiveAndFinite)
{
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
  {
    RandomStream random{seed};
    drawCase(random, 3, 3);
    for (int n = 0; n < 5; ++n)
    {
      ASSERT_TRUE(std::isfinite(update()));
      for (std::size_t k = 0; k < rays.rays.size(); ++k)
        labels.add(targets.birthKey(k), scan.blobs[k], 0);
      for (const auto& c : mixture)
      {
        EXPECT_GT(c.weight, 0);
        EXPECT_GT(math::smallestEigenvalue(c.state.P), 0) << "seed " << seed;
      }
      targets.predict(mixture, 0.2);
      look(scan.blobs);
    }
  }
}

TEST_F(MixtureOfTargets, LabelsAreOfOneTargetIfPlaceAndVelocityAreNear)
{
  core::TargetEstimate older, younger;
  older.pose.cov = 100 * Matrix3::Identity();  // of no account
  younger.pose.cov = 0.04 * Matrix3::Identity();
  younger.velocityCov = 0.04 * Matrix2::Identity();
  younger.pose.mean.x = 0.3;
  EXPECT_TRUE(areOne(older, younger, set));
  younger.velocity = {0, 0.3};  // 1.5 deviations each
  EXPECT_FALSE(areOne(older, younger, set));
  younger.velocity = {0, 0};
  for (const bool isRobot : {false, true})
  {
    core::TargetEstimate other = younger;
    other.identified = !isRobot;
    if (isRobot) other.label = "robot";
    EXPECT_FALSE(areOne(older, other, set));
  }
  younger.pose.mean.x = 0.41;
  EXPECT_FALSE(areOne(older, younger, set));
}

TEST_F(MixtureOfTargets, AnIdentityHasOneLabelWheneverItIsBorn)
{
  core::Blob b = blob({5, 5});
  b.id = 4;
  const auto first = labels.birthKeys({b}, 17).front();
  labels.add(first, b, 0);
  EXPECT_EQ(labels.birthKeys({b}, 18).front(), first);
  b.label = "robot";
  EXPECT_NE(labels.birthKeys({b}, 18).front(), first);
}
}  // namespace slamot::filters::rbpf
