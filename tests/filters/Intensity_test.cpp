#include "rbpf/Intensity.h"

#include <gtest/gtest.h>
#include <slamot/math/random.h>

#include <Eigen/LU>

#include <numeric>

namespace slamot::filters::rbpf
{
namespace
{
using math::RandomStream;

double gauss(const Vector2& x, const Vector2& mean, const Matrix2& cov)
{
  const Vector2 d = x - mean;
  return std::exp(-0.5 * d.dot(cov.inverse() * d)) / (math::kTwoPi * std::sqrt(cov.determinant()));
}

/// A map of a few components and a scan of them from a robot at the origin.
class IntensityMap : public ::testing::Test
{
 protected:
  static Settings settings()
  {
    Settings s{};
    s.gates = {50, 100, 50, 100};
    s.association = Association::kNearest;
    s.gateProbability = 0.99;
    s.newDensity = 1e-4;
    s.detection = 0.9;
    s.clutter = 0.5;
    s.intensity = {{0.01, 1e-6, 4, 0, 1000, 0.5, 0.02}, IntensityWeight::kCluster};
    return s;
  }

  /// Adds a component to the map, through the index as a filter does.
  std::uint32_t add(const Point2D& at, const Matrix2& cov, double weight)
  {
    look({at});
    const std::uint32_t slot = scan.newSlot(0);
    map.modify(pool, 0, slot) = {at.x,      at.y, cov(0, 0), cov(0, 1),
                                 cov(1, 1), 1,    0,         static_cast<float>(weight)};
    scan.slots().noteExtent(0, slot, *map.find(slot));
    for (const std::uint32_t other : scan.slots().touched())
      if (const maps::Landmark* m = map.find(other)) scan.slots().noteExtent(0, other, *m);
    scan.finish({});
    return slot;
  }
  void look(const std::vector<Point2D>& points)
  {
    seen = {};
    seen.fov = {0, kReach, -math::kPi, math::kPi};
    for (const Point2D& p : points)
      seen.sightings.push_back({std::hypot(p.x, p.y), std::atan2(p.y, p.x), kRange, kBearing});
    scan.begin(&seen, 0, {Pose2D{}}, {});
  }
  double update()
  {
    const double weight = intensity.update(map, Eye(Pose2D{}), matches, scratch, 0);
    scan.finish({&matches});
    return weight;
  }
  double total() const
  {
    double sum = 0;
    map.visit([&](std::uint32_t, const maps::Landmark& m) { sum += m.existence; });
    return sum;
  }
  /// A few components and sightings, any of which may be of any.
  void drawCase(RandomStream& random, int components, int sightings)
  {
    map = {};
    map.detach(pool.newToken());
    slots.clear();
    for (int k = 0; k < components; ++k)
    {
      Matrix2 A;
      for (int i = 0; i < 2; ++i) A.row(i) = 0.4 * random.normal3().head<2>().transpose();
      slots.push_back(add({40 + random.uniform(-1, 1), random.uniform(-1, 1)},
                          A * A.transpose() + 0.05 * Matrix2::Identity(),
                          random.uniform(0.05, 1.4)));
    }
    std::vector<Point2D> points;
    for (int j = 0; j < sightings; ++j)
      points.emplace_back(40 + random.uniform(-1, 1), random.uniform(-1, 1));
    look(points);
  }

  struct Linear  // a component as the definitions see it
  {
    Vector2 mean, expected;
    Matrix2 cov, H, S;
    double weight;
  };
  Linear linear(std::uint32_t slot) const
  {
    const maps::Landmark& m = *map.find(slot);
    Linear out;
    const double r = std::hypot(m.x, m.y);
    out.mean << m.x, m.y;
    out.cov = m.cov();
    out.expected << r, std::atan2(m.y, m.x);
    out.H << m.x / r, m.y / r, -m.y / (r * r), m.x / (r * r);
    Matrix2 R = Matrix2::Zero();
    R.diagonal() << kRange * kRange, kBearing * kBearing;
    out.S = out.H * out.cov * out.H.transpose() + R;
    out.weight = m.existence;
    return out;
  }
  Vector2 z(std::size_t j) const { return {seen.sightings[j].range, seen.sightings[j].bearing}; }
  [[nodiscard]] double clutter() const { return set.clutter / (kReach * math::kTwoPi); }

  static constexpr double kRange = 0.8, kBearing = 0.02, kReach = 60;
  Settings set = settings();
  maps::LandmarkPool pool{1};
  LandmarkScan scan{set, pool, 1};
  Intensity intensity{set, scan, pool};
  maps::LandmarkMap map;
  core::LandmarkScan seen;
  Intensity::Scratch scratch;
  std::vector<std::int32_t> matches;
  std::vector<std::uint32_t> slots;
};

/// The sum over all ways to give each sighting to clutter or to a component, of the likelihood of
/// that way: components are Poisson, so that each may be seen any number of times.
double sumOverWays(const std::vector<std::vector<double>>& terms, std::size_t j = 0)
{
  if (j == terms.size()) return 1;
  double sum = 0;
  for (const double t : terms[j]) sum += t * sumOverWays(terms, j + 1);
  return sum;
}
}  // namespace

TEST_F(IntensityMap, ClusterWeightIsTheSumOverAllWaysToExplainTheScan)
{
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
  {
    RandomStream random{seed};
    const int components = static_cast<int>(seed % 4), sightings = static_cast<int>(seed / 4 % 4);
    drawCase(random, components, sightings);
    std::vector<std::vector<double>> terms(static_cast<std::size_t>(sightings));
    double expected = 0;
    for (const std::uint32_t slot : slots) expected += 0.9 * linear(slot).weight;
    for (std::size_t j = 0; j < terms.size(); ++j)
    {
      terms[j].push_back(clutter());
      for (const std::uint32_t slot : slots)
      {
        const Linear c = linear(slot);
        terms[j].push_back(0.9 * c.weight * gauss(z(j), c.expected, c.S));
      }
    }
    const double direct = std::log(sumOverWays(terms)) - expected;
    EXPECT_NEAR(update(), direct, 1e-5 * (1 + std::abs(direct))) << "seed " << seed;
  }
}

// Mullane et al. 2011, section IV: p(Z | M) p(M) / p(M | Z) for a map M of no feature and of one,
// with prior and posterior Poisson.
TEST_F(IntensityMap, EmptyAndSingleFeatureWeightsAreBayesRatioAtThatMap)
{
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
  {
    RandomStream random{seed};
    const int components = 1 + static_cast<int>(seed % 3),
              sightings = static_cast<int>(seed / 3 % 4);
    const bool single = seed % 2 == 0;
    set.intensity->weight = single ? IntensityWeight::kSingleFeature : IntensityWeight::kEmptySet;
    drawCase(random, components, sightings);
    std::vector<Linear> cs;
    for (const std::uint32_t slot : slots) cs.push_back(linear(slot));
    double before = 0, after = 0;  // expected numbers
    std::size_t best = 0;
    for (std::size_t k = 0; k < cs.size(); ++k)
    {
      before += cs[k].weight;
      after += 0.1 * cs[k].weight;
      if (cs[k].weight > cs[best].weight) best = k;
    }
    const Vector2 m = cs[best].mean;
    Matrix2 R = Matrix2::Zero();
    R.diagonal() << kRange * kRange, kBearing * kBearing;
    double intensityBefore = 0, intensityAfter = 0, ways = 0.1;
    for (const Linear& c : cs) intensityBefore += c.weight * gauss(m, c.mean, c.cov);
    intensityAfter = 0.1 * intensityBefore;
    for (std::size_t j = 0; j < seen.sightings.size(); ++j)
    {
      double evidence = clutter();
      for (const Linear& c : cs) evidence += 0.9 * c.weight * gauss(z(j), c.expected, c.S);
      for (const Linear& c : cs)
      {
        const double w = 0.9 * c.weight * gauss(z(j), c.expected, c.S) / evidence;
        after += w;
        const Matrix2 K = c.cov * c.H.transpose() * c.S.inverse();
        intensityAfter += w * gauss(m, c.mean + K * (z(j) - c.expected), c.cov - K * c.H * c.cov);
      }
      ways += 0.9 * gauss(z(j), cs[best].expected, R) / clutter();
    }
    const double clutterOnly = std::log(clutter()) * static_cast<double>(seen.sightings.size());
    double direct = clutterOnly + after - before;
    if (single) direct += std::log(ways * intensityBefore / intensityAfter);
    EXPECT_NEAR(update(), direct, 1e-4 * (1 + std::abs(direct))) << "seed " << seed;
  }
}

TEST_F(IntensityMap, WeightsOfTheUpdateAreThoseOfTheDefinition)
{
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
  {
    RandomStream random{seed};
    drawCase(random, 1 + static_cast<int>(seed % 3), static_cast<int>(seed / 3 % 4));
    double expected = 0;
    std::size_t unexplained = 0;
    for (const std::uint32_t slot : slots) expected += 0.1 * linear(slot).weight;
    for (std::size_t j = 0; j < seen.sightings.size(); ++j)
    {
      double seenHere = 0;
      for (const std::uint32_t slot : slots)
      {
        const Linear c = linear(slot);
        seenHere += 0.9 * c.weight * gauss(z(j), c.expected, c.S);
      }
      expected += seenHere / (clutter() + seenHere);
      unexplained += seenHere <= clutter();
    }
    update();
    // Merging moves weight, but keeps it; what splits off may stand where a birth would have.
    EXPECT_NEAR(total(), expected, 0.01 * static_cast<double>(unexplained) + 2e-5)
        << "seed " << seed;
  }
}

TEST_F(IntensityMap, ASureSightingIsAKalmanUpdateAndAMissLeavesTheMean)
{
  map.detach(pool.newToken());
  const Matrix2 cov = 0.01 * Matrix2::Identity();
  const auto seenSlot = add({10, 0}, cov, 1), missed = add({-8, 3}, cov, 1);
  look({{10.1, 0.05}});
  const Linear before = linear(seenSlot);
  const Matrix2 K = before.cov * before.H.transpose() * before.S.inverse();
  const Vector2 mean = before.mean + K * (z(0) - before.expected);
  const double w = 0.9 * gauss(z(0), before.expected, before.S);
  update();
  EXPECT_EQ(matches, (std::vector<std::int32_t>{static_cast<std::int32_t>(seenSlot)}));
  const maps::Landmark& after = *map.find(seenSlot);
  EXPECT_NEAR(after.existence, 0.1 + w / (w + clutter()), 1e-5);
  EXPECT_NEAR(after.x, mean[0], 0.02 * std::abs(mean[0] - 10) + 0.01);  // a tenth is the missed one
  EXPECT_EQ(after.sightings, 2u);
  EXPECT_TRUE(after.confirmed);
  const maps::Landmark& other = *map.find(missed);
  EXPECT_EQ(other.x, -8);
  EXPECT_FLOAT_EQ(other.existence, 0.1f);
}

TEST_F(IntensityMap, WhatIsOutOfViewKeepsItsWeight)
{
  map.detach(pool.newToken());
  const auto far = add({80, 0}, 0.01 * Matrix2::Identity(), 0.7);
  const auto edge = add({60, 0}, 0.01 * Matrix2::Identity(), 0.7);
  for (int n = 0; n < 3; ++n)
  {
    look({});
    update();
  }
  EXPECT_FLOAT_EQ(map.find(far)->existence, 0.7f);
  EXPECT_NEAR(map.find(edge)->existence, 0.7 * std::pow(1 - 0.45, 3), 1e-3);  // half of it in view
}

TEST_F(IntensityMap, BehindAHalfPlaneNothingIsMissed)
{
  look({});
  seen.fov = {0, 20, -math::kPi / 2, math::kPi / 2};
  scan.begin(&seen, 0, {Pose2D{}}, {});
  const Eye eye(Pose2D{});
  const auto at = [&](double x, double y) {
    return intensity.detectionAt(eye, {x, y, 0.01, 0, 0.01, 1, 0});
  };
  EXPECT_EQ(at(-5, 1), 0);
  EXPECT_NEAR(at(5, 1), 0.9, 1e-12);
  EXPECT_NEAR(at(0, 5), 0.45, 1e-9);
  EXPECT_NEAR(at(20, 0), 0.45, 1e-9);
  EXPECT_EQ(at(25, 0), 0);
}

TEST_F(IntensityMap, AFeatureSurvivesAMissAndIsGoneAfterMany)
{
  map.detach(pool.newToken());
  const auto slot = add({10, 0}, 0.01 * Matrix2::Identity(), 0.3);
  EXPECT_FALSE(map.find(slot)->confirmed);
  for (int n = 0; n < 3; ++n)
  {
    look({{10, 0}});
    update();
  }
  EXPECT_TRUE(map.find(slot)->confirmed);
  look({});
  update();
  EXPECT_LT(map.find(slot)->existence, 0.5f);  // below what made it a feature
  EXPECT_TRUE(map.find(slot)->confirmed);
  look({});
  update();
  EXPECT_FALSE(map.find(slot)->confirmed);
  for (int n = 0; n < 6; ++n)
  {
    look({});
    update();
  }
  EXPECT_EQ(map.find(slot), nullptr);
}

TEST_F(IntensityMap, WhatNothingExplainsIsBornSmallAndGrowsWhenSeenAgain)
{
  map.detach(pool.newToken());
  look({{5, 5}});
  update();
  EXPECT_EQ(matches, (std::vector<std::int32_t>{kNew}));
  ASSERT_EQ(map.size(), 1u);
  EXPECT_NEAR(total(), 0.01, 1e-6);
  for (int n = 0; n < 4; ++n)
  {
    look({{5, 5}});
    update();
  }
  EXPECT_EQ(map.size(), 1u);
  EXPECT_GT(total(), 0.9);
}

TEST_F(IntensityMap, MergingKeepsWeightMeanAndSpread)
{
  map.detach(pool.newToken());
  for (const double x : {-0.1, 0.0, 0.15}) add({10 + x, x}, 0.04 * Matrix2::Identity(), 0.4 + x);
  look({});
  intensity.collect(map, Eye(Pose2D{}), scratch);
  intensity.pair(Eye(Pose2D{}), scratch);
  intensity.split(scratch);
  double w = 0;
  Vector2 mean = Vector2::Zero();
  Matrix2 second = Matrix2::Zero();
  for (const auto& p : scratch.pieces)
  {
    const Vector2 m(p.at.x, p.at.y);
    w += p.weight;
    mean += p.weight * m;
    second += p.weight * (p.at.cov() + m * m.transpose());
  }
  mean /= w;
  intensity.merge(scratch);
  ASSERT_EQ(scratch.merged.size(), 1u);
  const maps::Landmark& out = scratch.merged[0].at;
  EXPECT_NEAR(out.existence, w, 1e-6);
  EXPECT_NEAR(out.x, mean[0], 1e-9);
  EXPECT_NEAR(out.y, mean[1], 1e-9);
  EXPECT_LT((out.cov() - (second / w - mean * mean.transpose())).norm(), 1e-9);
}

TEST_F(IntensityMap, TheOrderOfSightingsDoesNotMatter)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    double weights[2], totals[2];
    for (int turn = 0; turn < 2; ++turn)
    {
      RandomStream random{seed};
      drawCase(random, 3, 3);
      if (turn == 1) std::reverse(seen.sightings.begin(), seen.sightings.end());
      scan.finish({});
      scan.begin(&seen, 0, {Pose2D{}}, {});
      weights[turn] = update();
      totals[turn] = total();
    }
    EXPECT_NEAR(weights[0], weights[1], 1e-9) << "seed " << seed;
    EXPECT_NEAR(totals[0], totals[1], 0.02) << "seed " << seed;  // births may differ
  }
}

TEST_F(IntensityMap, TheHeaviestStayWhereThereAreTooMany)
{
  map.detach(pool.newToken());
  set.intensity->mostComponents = 10;
  std::vector<std::uint32_t> added;
  for (int k = 0; k < 14; ++k)
    added.push_back(add({15 * std::cos(0.4 * k), 15 * std::sin(0.4 * k)},
                        0.01 * Matrix2::Identity(), 0.3 + 0.05 * k));
  look({});
  update();
  EXPECT_LE(map.size(), 10u);
  EXPECT_GE(map.size(), 9u);
  EXPECT_EQ(map.find(added[0]), nullptr);
  EXPECT_NE(map.find(added[13]), nullptr);
}

TEST_F(IntensityMap, CovariancesStayPositiveAndWeightsFinite)
{
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
  {
    RandomStream random{seed};
    drawCase(random, 3, 3);
    for (int n = 0; n < 5; ++n)
    {
      const double weight = update();
      ASSERT_TRUE(std::isfinite(weight));
      map.visit(
          [&](std::uint32_t, const maps::Landmark& m)
          {
            EXPECT_GT(m.cxx * m.cyy - m.cxy * m.cxy, 0) << "seed " << seed;
            EXPECT_GT(m.cxx, 0);
            EXPECT_GE(m.existence, 0);
          });
      scan.begin(&seen, 0, {Pose2D{}}, {});
    }
  }
}
}  // namespace slamot::filters::rbpf
