#include "ekf/Hypotheses.h"

#include "dense.h"
#include "denseKalman.h"
#include "ekf/relate.h"
#include "filterRig.h"

#include <slamot/core/Error.h>
#include <slamot/laws/Drive.h>
#include <slamot/laws/checkFilter.h>
#include <slamot/models/RangeBearing.h>

#include <functional>
#include <numeric>
#include <set>
#include <tuple>

namespace slamot::filters::ekf
{
namespace
{
constexpr double kSure = 1 - 1e-5;  // the most that a landmark's existence comes to

core::Sighting seen(const Pose2D& from, const Point2D& what, double rangeStd = 0.1,
                    double bearingStd = 0.01)
{
  const auto z = models::RangeBearing::predict(from, what);
  return {z[0], z[1], rangeStd, bearingStd, core::kNoId};
}

core::Step scan(double time, const std::vector<core::Sighting>& sightings)
{
  core::Step out;
  out.time = time;
  out.landmarks.emplace().sightings = sightings;
  out.landmarks->fov = {0, 50, -math::kPi, math::kPi};
  return out;
}

core::Step motion(double time, const Pose2D& increment, const Vector3& std)
{
  core::Step out;
  out.time = time;
  out.odometry = {increment, std.cwiseAbs2().asDiagonal()};
  return out;
}

class Several : public ::testing::Test
{
 protected:
  void make(const std::string& keys)
  {
    core::Config config = core::Config::parse(
        "[slamot]\ntarget_motion = constant-velocity\n"
        "target_velocity_std_mps = 1\n"
        "target_acceleration_noise_mps2_per_sqrt_hz = 1\n" +
            keys,
        "test");
    core::Params params(config, "slamot");
    settings = Settings::from(params, {"mht", true});
    auto one = std::make_unique<EngineOf<models::ConstantVelocityTarget>>(
        settings, std::get<models::ConstantVelocityTarget>(models::targetMotionFrom(params)),
        contexts, Mates{});
    filter = std::make_unique<Hypotheses>(settings, std::move(one));
  }
  core::Update see(const std::vector<Point2D>& what, const Pose2D& from = {}, double std = 0.1)
  {
    std::vector<core::Sighting> sightings;
    for (const Point2D& p : what) sightings.push_back(seen(from, p, std, 0.1 * std));
    return filter->process(0, scan(++time, sightings));
  }
  [[nodiscard]] std::size_t mapped() const { return filter->estimate(0).landmarks->size(); }

  std::vector<core::FilterContext> contexts{1};  // a robot each
  Settings settings;
  std::unique_ptr<Hypotheses> filter;
  double time = 0;
};

/// What each way to explain the sightings is worth, by the whole Gaussian: seen landmarks by P_D
/// and the density of all their innovations at once, others by the chance to miss them, sightings
/// of nothing known by theirs.
std::vector<double> byEnumeration(const Belief& belief, const std::vector<Ray>& rays, int landmarks,
                                  double detection, double fresh)
{
  std::vector<double> out;
  std::vector<int> as(rays.size());
  const std::function<void(std::size_t)> next = [&](std::size_t k)
  {
    if (k < rays.size())
    {
      for (as[k] = -1; as[k] < landmarks; ++as[k])
        if (as[k] < 0 || std::find(as.begin(), as.begin() + std::ptrdiff_t(k), as[k]) ==
                             as.begin() + std::ptrdiff_t(k))
          next(k + 1);
      return;
    }
    std::vector<SightingRows> rows;
    double weight = 1;
    for (std::size_t i = 0; i < as.size(); ++i)
    {
      Innovation o;
      const int j = as[i] < 0 ? 0 : belief.landmark(as[i]);
      if (as[i] >= 0 && relate(belief, 0, j, eyeOf(belief, 0), rays[i], o))
        rows.push_back(rowsOf(0, j, o, rays[i]));
    }
    weight *= std::pow(fresh, double(rays.size() - rows.size())) *
              std::pow(kSure * detection, double(rows.size())) *
              std::pow(1 - kSure * detection, landmarks - double(rows.size()));
    if (!rows.empty())
    {
      const Eigen::MatrixXd H = denseRows(rows, belief.P().size());
      Eigen::MatrixXd R = Eigen::MatrixXd::Zero(H.rows(), H.rows());
      Eigen::VectorXd nu(H.rows());
      for (std::size_t i = 0; i < rows.size(); ++i)
      {
        R.diagonal().segment<2>(Eigen::Index(2 * i)) = rows[i].variance;
        nu.segment<2>(Eigen::Index(2 * i)) = rows[i].innovation;
      }
      weight *= std::exp(test::logNormal(nu, test::transformed(H, dense(belief.P())) + R));
    }
    out.push_back(weight);
  };
  next(0);
  std::sort(out.begin(), out.end(), std::greater<>());
  const double sum = std::accumulate(out.begin(), out.end(), 0.0);
  for (double& w : out) w /= sum;
  return out;
}
}  // namespace

TEST_F(Several, AreWeighedAsEnumerationDoes)
{
  // Far away, so that the sightings are all but linear in what is in doubt.
  const std::vector<Point2D> posts{{40, -0.4}, {40, 0.4}, {40.5, 1.2}};
  for (const auto& [truths, off] : std::vector<std::pair<std::vector<Point2D>, double>>{
           {{{40, 0.05}}, 0}, {{{40, 0.1}, {40, 0.85}}, 0.15}, {{{40.15, 0}, {40.3, 0.85}}, -0.1}})
  {
    make(
        "hypotheses = 1000\nleast_hypothesis = 1e-5\nmerge_distance2 = 0\nnew_gate_probability = "
        "0.999999999999\n"
        "detection_probability = 0.9\nclutter_per_scan = 2000\nnew_per_scan = 5\n");
    for (int i = 0; i < 6; ++i) see(posts, {}, 0.002);
    ASSERT_EQ(filter->weights().size(), 1u);
    ASSERT_EQ(mapped(), posts.size());
    filter->process(0, motion(time += 0.5, {0, off, 0}, {0.25, 0.4, 1e-4}));
    std::vector<Ray> rays;
    std::vector<core::Sighting> sightings;
    for (const Point2D& p : truths)
    {
      sightings.push_back(seen({}, p));
      rays.push_back(settings.ray(sightings.back()));
    }
    const double fresh = 2005 / (50 * math::kTwoPi);
    const auto expected = byEnumeration(filter->best().belief(), rays, 3, 0.9, fresh);
    filter->process(0, scan(++time, sightings));
    const auto weights = filter->weights();
    ASSERT_LE(weights.size(), expected.size());
    ASSERT_GE(weights.size(), truths.size() + 1);
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(i < weights.size() ? weights[i] : 0, expected[i], 0.01) << i;
  }
}

TEST_F(Several, WithoutDoubtAreNearestNeighbour)
{
  make("detection_probability = 0.999\n");
  const auto nearest =
      test::makeFilter("ekf-slamot",
                       "association = nn\nfirst_estimates = true\nconfirm_sightings = 2\n"
                       "target_velocity_std_mps = 1\ntarget_motion = constant-velocity\n"
                       "target_acceleration_noise_mps2_per_sqrt_hz = 1\n");
  const std::vector<Point2D> posts{{10, 0}, {0, 12}, {-9, 5}, {3, -14}};
  math::RandomStream random{4};
  Pose2D truth;
  for (int i = 0; i < 40; ++i)
  {
    const Pose2D increment(0.2, 0.01, 0.05);
    truth = math::compose(truth, increment);
    const core::Step moved = motion(time += 0.5, increment, {0.02, 0.02, 0.01});
    std::vector<core::Sighting> sightings;
    for (const Point2D& p : posts)
    {
      sightings.push_back(seen(truth, p));
      sightings.back().range += 0.1 * random.normal();
      sightings.back().bearing += 0.01 * random.normal();
    }
    const core::Step sighted = scan(time += 0.5, sightings);
    nearest->process(moved);
    const core::Estimate a = nearest->process(sighted).estimate;
    filter->process(0, moved);
    const core::Estimate b = filter->process(0, sighted).estimate;
    ASSERT_EQ(filter->weights().size(), 1u) << i;
    EXPECT_NEAR(a.robot.mean.x, b.robot.mean.x, 1e-12);
    EXPECT_NEAR(a.robot.mean.phi, b.robot.mean.phi, 1e-12);
    EXPECT_LT((a.robot.cov - b.robot.cov).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_EQ(a.landmarks->size(), b.landmarks->size());
  }
  EXPECT_EQ(mapped(), posts.size());
}

// The first sighting after a poor dead reckoning is nearest to a wrong post; what is seen next
// tells.
TEST_F(Several, ComeBackFromAWrongFirstGuess)
{
  const std::vector<Point2D> posts{{20, 0}, {20, 4}, {20, 11}};
  for (const int most : {1, 10})
  {
    make("hypotheses = " + std::to_string(most) + "\n");
    for (int i = 0; i < 5; ++i) see(posts);
    filter->process(0, motion(time += 0.5, {0, 0, 0}, {0.1, 2, 1e-3}));
    const Pose2D truth(0, 2.5, 0);  // slipped sideways
    see({{20, 4}}, truth);          // 1.5 m off its place, by dead reckoning, and 2.5 m off (20, 0)
    for (int i = 0; i < 3; ++i) see({{20, 0}, {20, 4}, {20, 11}}, truth);
    const Pose2D at = filter->estimate(0).robot.mean;
    if (most == 10)
    {
      EXPECT_NEAR(at.y, truth.y, 0.3);
      EXPECT_EQ(mapped(), posts.size());
    }
    else
      EXPECT_GT(std::abs(at.y - truth.y), 1);  // the case is as hard as it is meant to be
  }
}

TEST_F(Several, AreForgottenByTheirExistence)
{
  constexpr double kDetection = 0.8;
  make("detection_probability = 0.8\nclutter_per_scan = 1\nnew_per_scan = 1\n");
  const std::vector<Point2D> stays{{10, 0}}, both{{10, 0}, {0, 10}};
  for (int i = 0; i < 6; ++i) see(both);
  EXPECT_EQ(mapped(), 2u);
  // Each miss in plain view leaves 0.2 of its odds.
  int misses = 0;
  for (double odds = kSure / (1 - kSure); odds >= 1; odds *= 1 - kDetection) ++misses;
  for (int i = 0; i < misses - 1; ++i) see(stays);
  EXPECT_EQ(mapped(), 2u);
  see(stays);
  EXPECT_EQ(mapped(), 1u);
}

TEST_F(Several, MapNoFalseAlarms)
{
  make("clutter_per_scan = 5\nnew_per_scan = 0.05\n");
  math::RandomStream random{8};
  for (int i = 0; i < 200; ++i)
  {
    std::vector<Point2D> what{{10, 0}, {-8, 6}};
    for (int c = 0; c < 5; ++c)
    {
      const double r = 50 * random.uniform(), b = math::kTwoPi * random.uniform();
      what.emplace_back(r * std::cos(b), r * std::sin(b));
    }
    see(what);
  }
  EXPECT_GE(mapped(), 2u);
  EXPECT_LE(mapped(), 3u);  // one may be there just now: in one seed of 300
  EXPECT_LE(filter->weights().size(), 10u);
}

// The first sightings of a landmark are each likelier to be one of 20 false alarms.
TEST_F(Several, StartLandmarksAmongManyFalseAlarms)
{
  make("clutter_per_scan = 20\nnew_per_scan = 0.1\n");
  math::RandomStream random{9};
  const std::vector<Point2D> posts{{10, 0}, {-8, 6}, {2, -12}};
  for (int i = 0; i < 60; ++i)
  {
    std::vector<core::Sighting> sightings;
    for (const Point2D& p : posts)
    {
      sightings.push_back(seen({}, p, 0.3, 0.06));
      sightings.back().range += 0.3 * random.normal();
      sightings.back().bearing += 0.06 * random.normal();
    }
    for (int c = 0; c < 20; ++c)
      sightings.push_back({0.1 + 49 * random.uniform(), math::kTwoPi * (random.uniform() - 0.5),
                           0.3, 0.06, core::kNoId});
    filter->process(0, scan(++time, sightings));
  }
  for (const Point2D& p : posts)
  {
    double nearest = 1e9;
    for (const auto& [id, l] : test::landmarks(filter->estimate(0)))
      nearest = std::min(nearest, std::hypot(l.position.mean.x - p.x, l.position.mean.y - p.y));
    EXPECT_LT(nearest, 0.5) << p.x;
  }
  EXPECT_LE(mapped(), posts.size() + 1);
}

// Where nobody tells how far the sensor sees, landmarks beyond its reach are not missed.
TEST_F(Several, KeepAMapWithoutAFieldOfView)
{
  make("");
  const auto seeUntold = [&](const Pose2D& from, const Point2D& p)
  {
    core::Step step = scan(++time, {seen(from, p)});
    step.landmarks->fov = {};
    filter->process(0, step);
  };
  for (int i = 0; i < 5; ++i) seeUntold({}, {10, 0});
  filter->process(0, motion(time += 0.5, {500, 0, 0}, {0.1, 0.1, 0.01}));
  for (int i = 0; i < 30; ++i) seeUntold({500, 0, 0}, {510, 0});
  EXPECT_EQ(mapped(), 2u);
}

TEST_F(Several, AreAllToldOfEvidence)
{
  make("clutter_per_scan = 20\n");
  const std::vector<Point2D> posts{{20, -0.8}, {20, 0.8}};
  for (int i = 0; i < 6; ++i) see(posts, {}, 0.002);
  filter->process(0, motion(time += 0.5, {0, 0, 0}, {0.1, 1, 1e-3}));
  see({{20, 0.1}});
  ASSERT_GT(filter->weights().size(), 1u);
  core::Evidence told;  // that the robot slipped up: the sighting was of the lower post
  told.H = Eigen::MatrixXd::Identity(2, 3);
  told.innovation = Vector2(0, 0.9 - filter->estimate(0).robot.mean.y);
  told.cov = 1e-4 * Matrix2::Identity();
  told.independent = told.cov;
  const auto weights = filter->weights();
  EXPECT_TRUE(filter->fuse(told, {}).fused);
  EXPECT_EQ(filter->weights(), weights);  // none was lost
  told.H = Eigen::MatrixXd::Identity(2, 5);
  EXPECT_THROW(filter->fuse(told, {}), core::Error);
  EXPECT_EQ(filter->weights(), weights);
}

TEST_F(Several, RobotsHaveOneMap)
{
  contexts.resize(2);
  const Pose2D other{12, 1, math::kPi};
  core::ObjectStart& start = contexts[1].starts.robot.emplace();
  for (const auto& [field, value, std] : {std::tuple(core::ObjectStart::kX, other.x + 0.4, 0.5),
                                          std::tuple(core::ObjectStart::kY, other.y - 0.4, 0.5),
                                          std::tuple(core::ObjectStart::kTheta, other.phi, 0.05)})
    start.value[field] = value, start.std[field] = std;
  make("clutter_per_scan = 1\n");
  const std::vector<Point2D> posts{{5, -3}, {5, 3}, {8, 0}};
  for (int i = 0; i < 6; ++i) see(posts, {}, 0.02);
  ASSERT_EQ(mapped(), posts.size());
  const double before = filter->estimate(1).robot.cov(0, 0);
  std::vector<core::Sighting> sightings;
  for (const Point2D& p : posts) sightings.push_back(seen(other, p, 0.02, 0.002));
  for (int i = 0; i < 3; ++i) filter->process(1, scan(++time, sightings));
  EXPECT_EQ(filter->estimate(1).landmarks->size(), posts.size());
  const auto placed = filter->estimate(1).robot;
  EXPECT_NEAR(placed.mean.x, other.x, 0.05);
  EXPECT_NEAR(placed.mean.y, other.y, 0.05);
  EXPECT_LT(placed.cov(0, 0), 0.01 * before);
  EXPECT_EQ(filter->estimate(0).robot.mean.x, 0);  // where it started, exactly
}

TEST_F(Several, AnOverflowAmidAScanIsTheLastEstimate)
{
  make("clutter_per_scan = 1\n");
  see({{5, 1}, {6, -1}});
  core::Step absurd = scan(++time, {seen({}, {5, 1})});
  absurd.odometry = {Pose2D(0, 0, 0), 1e308 * Matrix3::Identity()};
  EXPECT_THROW(filter->process(0, absurd), core::Error);
  EXPECT_THROW((void)filter->estimate(0), core::Error);
  EXPECT_THROW(filter->process(0, scan(++time, {})), core::Error);
}

TEST(Slamot, ObeysTheFilterLaws)
{
  registerAll();
  laws::LawOptions options;
  options.world.identities = false;
  laws::checkFilter("slamot",
                    core::Config::parse("[slamot]\ntarget_velocity_std_mps = 1\n"
                                        "target_acceleration_std_mps2 = 0.5\n"
                                        "target_jerk_noise_mps3_per_sqrt_hz = 0.2\n",
                                        "t"),
                    options);
}

TEST(Slamot, TakesPartInATeam)
{
  laws::World world;
  world.identities = false;
  const laws::Drive drive = laws::drive(world, 3);
  core::FilterContext context;
  context.starts = drive.starts;
  const auto filter = test::makeFilter("slamot",
                                       "target_velocity_std_mps = 1\n"
                                       "target_acceleration_std_mps2 = 0.5\n"
                                       "target_jerk_noise_mps3_per_sqrt_hz = 0.2\n",
                                       context);
  for (const core::Step& step : drive.steps) filter->process(step);
  auto& member = dynamic_cast<core::TeamFilter&>(*filter);
  const auto before = member.robotAndTarget(core::kNoId);
  core::Evidence told;
  told.H = Eigen::MatrixXd::Identity(2, 3);
  told.innovation = Vector2(0.01, -0.02);
  told.cov = 0.1 * before.cov.topLeftCorner<2, 2>();
  told.independent = told.cov;
  core::Evidence wrong = told;
  wrong.innovation[0] = std::nan("");
  EXPECT_THROW(member.fuse(wrong, {}), core::Error);
  EXPECT_EQ(member.robotAndTarget(core::kNoId).mean, before.mean);
  EXPECT_EQ(member.robotAndTarget(core::kNoId).cov, before.cov);
  EXPECT_TRUE(member.fuse(told, {}).fused);
  const auto after = member.robotAndTarget(core::kNoId);
  EXPECT_LT(after.cov(0, 0) + after.cov(1, 1), 0.5 * (before.cov(0, 0) + before.cov(1, 1)));
}
}  // namespace slamot::filters::ekf
