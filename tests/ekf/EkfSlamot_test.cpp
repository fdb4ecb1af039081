#include <slamot/filters/EkfSlamot.h>

#include "dense.h"
#include "denseKalman.h"
#include "filterRig.h"

#include <slamot/core/Error.h>
#include <slamot/laws/Drive.h>
#include <slamot/laws/checkFilter.h>
#include <slamot/math/random.h>
#include <slamot/models/RangeBearing.h>
#include <slamot/sim/World.h>

#include <algorithm>

namespace slamot::filters
{
namespace
{
const char* const kDriven =
    "target_motion = differential-drive\ntarget_speed_mps = 0.8\n"
    "target_turn_rate_deg_per_s = 11.459155902616464\ntarget_speed_noise_mps = 0.1\n"
    "target_turn_rate_noise_deg_per_s = 5.729577951308232\n";
const char* const kAccelerated =
    "target_velocity_std_mps = 1\ntarget_acceleration_std_mps2 = 0.5\n"
    "target_jerk_noise_mps3_per_sqrt_hz = 0.2\n";

core::Sighting sighting(const Pose2D& from, const Point2D& of, int id, double rangeStd = 0.1,
                        double bearingStd = 0.01)
{
  const auto z = models::RangeBearing::predict(from, of);
  return {z[0], z[1], rangeStd, bearingStd, id};
}

core::Step scan(double time, const std::vector<core::Sighting>& sightings)
{
  core::Step out;
  out.time = time;
  out.landmarks.emplace().sightings = sightings;
  return out;
}

core::Step motion(double time, const Pose2D& increment, double std)
{
  core::Step out;
  out.time = time;
  out.odometry = {increment, std * std * Matrix3::Identity()};
  return out;
}

core::Blob blob(const Pose2D& from, const Point2D& of, int id)
{
  const auto z = models::RangeBearing::predict(from, of);
  core::Blob out;
  out.label = "target";
  out.range = z[0];
  out.bearing = z[1];
  out.rangeStd = 0.1;
  out.bearingStd = 0.01;
  out.id = id;
  return out;
}
}  // namespace

// How the map as a whole lies can't be seen from within it: whatever is sighted, the heading stays
// at least as uncertain as it was at the start.  With derivatives at ever new estimates, it does
// not: nᵀ P⁻¹ n, n a turn of robot and map about the origin, then grows with every update.
TEST(EkfSlamot, ByFirstEstimatesLearnsNothingOfHowTheMapLies)
{
  constexpr double kStd = 0.1;
  const auto variance = [&](bool first, std::uint64_t seed)
  {
    core::FilterContext context;
    context.starts.robot.emplace();
    for (const auto f : {core::ObjectStart::kX, core::ObjectStart::kY, core::ObjectStart::kTheta})
      context.starts.robot->value[f] = 0;
    context.starts.robot->std[core::ObjectStart::kTheta] = kStd;
    const auto filter =
        test::makeFilter("ekf-slamot",
                         std::string("association = known\ntarget_motion = damped-velocity\n") +
                             "first_estimates = " + (first ? "true\n" : "false\n"),
                         context);
    math::RandomStream random{seed};
    Pose2D truth(0, 0, kStd * random.normal());
    double least = 1;
    for (int i = 1; i <= 200; ++i)
    {
      const Pose2D increment(0.3, 0, 0.05);
      truth = math::compose(truth, {0.3 + 0.02 * random.normal(), 0.02 * random.normal(),
                                    0.05 + 0.02 * random.normal()});
      core::Step step = motion(0.1 * i, increment, 0.02);
      step.landmarks.emplace();
      for (int k = 0; k < 6; ++k)
      {
        const Point2D at(6 + 14 * std::cos(k), 4 + 14 * std::sin(k));
        core::Sighting z = sighting(truth, at, k, 0.2, 0.02);
        z.range += 0.2 * random.normal();
        z.bearing += 0.02 * random.normal();
        step.landmarks->sightings.push_back(z);
      }
      least = std::min(least, filter->process(step).estimate.robot.cov(2, 2));
    }
    return least;
  };
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    EXPECT_GE(variance(true, seed), kStd * kStd * (1 - 1e-6)) << "seed " << seed;
    EXPECT_LT(variance(false, seed), 0.98 * kStd * kStd) << "seed " << seed;
  }
}

TEST(EkfSlamot, ObeysTheFilterLawsWithIdentities)
{
  registerAll();
  laws::checkFilter("ekf-slamot",
                    core::Config::parse(std::string("[ekf-slamot]\n") + kDriven, "t"));
}

TEST(EkfSlamot, ObeysTheFilterLawsInTheCompressedForm)
{
  registerAll();
  laws::checkFilter(
      "ekf-slamot",
      core::Config::parse(std::string("[ekf-slamot]\nlocal_radius_m=9\n") + kDriven, "t"));
}

TEST(EkfSlamot, ObeysTheFilterLawsByJointCompatibility)
{
  registerAll();
  laws::LawOptions options;
  options.world.identities = false;
  laws::checkFilter(
      "ekf-slamot",
      core::Config::parse(
          std::string("[ekf-slamot]\nassociation=jcbb\ngate_probability=0.9999\n") + kDriven, "t"),
      options);
}

// A whole drive against an EKF written with full matrices, from the textbook: Thrun, Burgard, Fox
// 2005, table 10.1.
TEST(EkfSlamot, EqualsATextbookEkf)
{
  laws::World world;
  world.targets = 0;
  const laws::Drive drive = laws::drive(world, 4, {1, 2, 0.3});
  core::FilterContext context;
  context.starts = drive.starts;
  const auto filter = test::makeFilter("ekf-slamot", kAccelerated, context);
  const Gaussian<Pose2D> start = drive.starts.robotPose();
  Eigen::VectorXd x = Vector3(start.mean.x, start.mean.y, start.mean.phi);
  Eigen::MatrixXd P = start.cov;
  std::map<int, int> at;
  for (const core::Step& step : drive.steps)
  {
    if (step.odometry)
    {
      const auto next =
          math::compose({{x[0], x[1], x[2]}, P.topLeftCorner<3, 3>()}, *step.odometry);
      Eigen::MatrixXd F = Eigen::MatrixXd::Identity(x.size(), x.size());
      F(0, 2) = x[1] - next.mean.y;
      F(1, 2) = next.mean.x - x[0];
      const Matrix3 own =
          F.topLeftCorner<3, 3>() * P.topLeftCorner<3, 3>() * F.topLeftCorner<3, 3>().transpose();
      const Matrix3 Q = next.cov - own;
      x.head<3>() << next.mean.x, next.mean.y, next.mean.phi;
      P = test::transformed(F, P);
      P.topLeftCorner<3, 3>() += Q;
    }
    if (step.landmarks)
    {
      std::vector<core::Sighting> known, fresh;
      for (const auto& s : step.landmarks->sightings) (at.count(s.id) ? known : fresh).push_back(s);
      const auto n = x.size(), m = static_cast<Eigen::Index>(2 * known.size());
      Eigen::MatrixXd H = Eigen::MatrixXd::Zero(m, n), R = Eigen::MatrixXd::Zero(m, m);
      Eigen::VectorXd nu(m);
      const Pose2D pose(x[0], x[1], x[2]);
      for (std::size_t k = 0; k < known.size(); ++k)
      {
        const auto i = static_cast<Eigen::Index>(2 * k);
        const int j = at.at(known[k].id);
        const Point2D point(x[j], x[j + 1]);
        const auto J = models::RangeBearing::jacobians(pose, point);
        H.block<2, 3>(i, 0) = J.pose;
        H.block<2, 2>(i, j) = J.point;
        nu.segment<2>(i) = models::RangeBearing::residual(
            {known[k].range, known[k].bearing}, models::RangeBearing::predict(pose, point));
        R.block<2, 2>(i, i) = models::RangeBearing(known[k].rangeStd, known[k].bearingStd).noise();
      }
      if (m > 0)
      {
        const test::DenseUpdate update(P, H, R, nu);
        x += test::times(update.gain, nu);
        P = update.cov;
      }
      for (const auto& s : fresh)
      {
        const Pose2D now(x[0], x[1], x[2]);
        const auto old = x.size();
        const Point2D p = models::RangeBearing::invert(now, {s.range, s.bearing});
        const Matrix2 Z = models::RangeBearing::invertJacobian(now, {s.range, s.bearing});
        Eigen::MatrixXd G = Eigen::MatrixXd::Zero(old + 2, old);
        G.topRows(old).setIdentity();
        G.bottomLeftCorner<2, 3>() << 1, 0, now.y - p.y, 0, 1, p.x - now.x;
        P = test::transformed(G, P);
        P.bottomRightCorner<2, 2>() +=
            Z * models::RangeBearing(s.rangeStd, s.bearingStd).noise() * Z.transpose();
        x.conservativeResize(old + 2);
        x.tail<2>() << p.x, p.y;
        at[s.id] = static_cast<int>(old);
      }
    }
    const core::Estimate e = filter->process(step).estimate;
    ASSERT_NEAR(e.robot.mean.x, x[0], 1e-9) << step.time;
    ASSERT_NEAR(math::wrapToPi(e.robot.mean.phi - x[2]), 0, 1e-10);
    ASSERT_LT((e.robot.cov - P.topLeftCorner<3, 3>()).cwiseAbs().maxCoeff(), 1e-10);
  }
  const auto map = test::landmarks(filter->estimate());
  ASSERT_EQ(map.size(), at.size());
  for (const auto& [id, l] : map)
  {
    EXPECT_NEAR(l.position.mean.x, x[at.at(id)], 1e-9);
    EXPECT_LT((l.position.cov - P.block<2, 2>(at.at(id), at.at(id))).cwiseAbs().maxCoeff(), 1e-10);
  }
}

// What the filter is for: a target's sighting also corrects the robot, and the other way round.
TEST(EkfSlamot, ATargetWhoseStartIsKnownPlacesTheRobot)
{
  core::FilterContext context;
  context.starts.robot.emplace();
  for (const auto f : {core::ObjectStart::kX, core::ObjectStart::kY, core::ObjectStart::kTheta})
    context.starts.robot->value[f] = 0,
    context.starts.robot->std[f] = f == core::ObjectStart::kTheta ? 0.001 : 1.0;
  core::ObjectStart& target = context.starts.targets[3];
  for (const auto f : {core::ObjectStart::kX, core::ObjectStart::kY, core::ObjectStart::kVx,
                       core::ObjectStart::kVy})
    target.value[f] = f == core::ObjectStart::kX ? 5.0 : 0.0, target.std[f] = 0.01;
  const auto filter = test::makeFilter("ekf-slamot", kAccelerated, context);
  core::Step step;
  step.time = 0;
  step.blobs.emplace().blobs = {blob({-0.8, 0.4, 0}, {5, 0}, 3)};
  const auto update = filter->process(step);
  EXPECT_NEAR(update.estimate.robot.mean.x, -0.8, 0.02);
  EXPECT_NEAR(update.estimate.robot.mean.y, 0.4, 0.02);
  EXPECT_LT(update.estimate.robot.cov(0, 0), 0.02);
  ASSERT_EQ(update.estimate.targets.size(), 1u);
  EXPECT_EQ(update.estimate.targets[0].id, 3);
}

TEST(EkfSlamot, TakesOneSightingOfALandmarkAScanAndNoneWithoutIdentity)
{
  const auto filter = test::makeFilter("ekf-slamot", kAccelerated);
  const Pose2D here(0, 0, 0);
  filter->process(scan(0, {sighting(here, {3, 1}, 7)}));
  const auto update = filter->process(scan(1, {sighting(here, {3, 1}, 7), sighting(here, {3, 1}, 7),
                                               sighting(here, {4, 4}, core::kNoId)}));
  using Outcome = core::Pairing::Outcome;
  ASSERT_EQ(update.pairings.size(), 3u);
  EXPECT_EQ(update.pairings[0].outcome, Outcome::kKnown);
  EXPECT_EQ(update.pairings[1].outcome, Outcome::kRejected);
  EXPECT_EQ(update.pairings[2].outcome, Outcome::kRejected);
  EXPECT_EQ(test::landmarks(update.estimate).at(7).sightings, 2);
}

// A post was once read as 7, which is elsewhere: what 7 itself shows must win in the end.
TEST(EkfSlamot, RecoversFromAMisreadIdentity)
{
  const auto filter = test::makeFilter("ekf-slamot", kAccelerated);
  const Pose2D here(0, 0, 0);
  filter->process(scan(0, {sighting(here, {9, 1}, 7), sighting(here, {3, 3}, 1)}));
  using Outcome = core::Pairing::Outcome;
  for (int k = 1; k <= 4; ++k)
  {
    const auto update =
        filter->process(scan(k, {sighting(here, {3, -4}, 7), sighting(here, {3, 3}, 1)}));
    EXPECT_EQ(update.pairings[0].outcome, k < 3    ? Outcome::kRejected
                                          : k == 3 ? Outcome::kNew
                                                   : Outcome::kKnown)
        << k;
    EXPECT_EQ(update.pairings[1].outcome, Outcome::kKnown);
  }
  EXPECT_NEAR(test::landmarks(filter->estimate()).at(7).position.mean.y, -4, 0.2);
}

TEST(EkfSlamot, ForgetsALandmarkThatNothingConfirms)
{
  const auto filter = test::makeFilter(
      "ekf-slamot",
      std::string(kAccelerated) + "association=nn\nlandmark_tentative_s=5\nconfirm_sightings=2\n");
  const Pose2D here(0, 0, 0);
  filter->process(scan(0, {sighting(here, {3, 1}, -1), sighting(here, {8, 8}, -1)}));
  filter->process(scan(1, {sighting(here, {3, 1}, -1)}));
  EXPECT_EQ(filter->process(scan(7, {sighting(here, {3, 1}, -1)})).estimate.landmarks->size(), 1u);
  const auto update = filter->process(scan(8, {sighting(here, {8, 8}, -1)}));
  EXPECT_EQ(update.pairings[0].outcome, core::Pairing::Outcome::kNew);
}

TEST(EkfSlamot, FollowsTargetsFromBirthToLoss)
{
  const auto filter =
      test::makeFilter("ekf-slamot", std::string(kAccelerated) +
                                         "target_confirm_sightings=3\n"
                                         "target_lost_s=4\ntarget_lost_std_m=100\n");
  const auto at = [](double t) { return Point2D(5 + 0.5 * t, 2); };
  core::Estimate last;
  for (int k = 0; k < 20; ++k)
  {
    core::Step step;
    step.time = 0.2 * k;
    step.blobs.emplace().blobs = {blob({0, 0, 0}, at(step.time), core::kNoId)};
    last = filter->process(step).estimate;
    EXPECT_EQ(last.targets.size(), k < 2 ? 0u : 1u) << k;
  }
  EXPECT_NEAR(last.targets[0].pose.mean.x, at(last.time).x, 1e-2);
  EXPECT_NEAR(last.targets[0].velocity[0], 0.5, 0.05);
  core::Step empty;
  empty.time = last.time + 3;
  empty.blobs.emplace();
  EXPECT_EQ(filter->process(empty).estimate.targets.size(), 1u);
  empty.time = last.time + 5;
  EXPECT_EQ(filter->process(empty).estimate.targets.size(), 0u);
}

// The robot drives over a landmark: polar coordinates have no derivative there.
TEST(EkfSlamot, PassesOverALandmark)
{
  const auto filter = test::makeFilter("ekf-slamot", kAccelerated);
  const Point2D close(1.003, 0.002), far(3, 4);
  double x = 0;
  int closest = 0;  // sightings in one scan that were told to be close
  for (int k = 0; k <= 20; ++k)
  {
    const Pose2D here(x, 0, 0);
    const auto update =
        filter->process(scan(k, {sighting(here, close, 1), sighting(here, far, 2)}));
    const core::Estimate& e = update.estimate;
    EXPECT_NEAR(e.robot.mean.x, x, 0.05) << k;
    EXPECT_NEAR(e.robot.mean.phi, 0, 0.05) << k;
    EXPECT_GT(math::smallestEigenvalue(e.robot.cov), -1e-12);
    closest = std::max(closest, update.diagnostics.close);
    filter->process(motion(k + 0.5, {0.1, 0, 0}, 0.01));
    x += 0.1;
  }
  EXPECT_EQ(closest, 1);
}

TEST(EkfSlamot, SaysSoWhereValuesAreAbsurd)
{
  const auto filter = test::makeFilter("ekf-slamot", kAccelerated);
  const Pose2D here(0, 0, 0);
  filter->process(scan(0, {sighting(here, {3, 1}, 1)}));
  EXPECT_THROW(
      {
        for (int k = 1; k < 9; ++k)
        {
          filter->process(motion(k, {1e200, 1e200, 1}, 1e200));
          filter->process(scan(k, {sighting(here, {3, 1}, 1)}));
        }
      },
      core::Error);
}

// Table 1's world, among 100 landmarks that it passes at any range.
TEST(EkfSlamot, NeverDivergesAmongManyLandmarks)
{
  core::Config config = core::Config::load(std::string(SLAMOT_CONFIGS) + "/sim.experiment1.ini");
  config.set("world.landmarks=100");
  const sim::Scenario scenario = sim::Scenario::from(config);
  double nees = 0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    sim::World world(scenario, seed);
    core::FilterContext context;
    context.starts = world.starts();
    core::Config own =
        core::Config::load(std::string(SLAMOT_CONFIGS) + "/ekf-slamot.experiment1.ini");
    registerAll();
    const auto filter = core::FilterRegistry::instance().make("ekf-slamot", own, context);
    while (const auto step = world.next())
    {
      const auto e = filter->process(*step).estimate;
      const Pose2D truth = world.truth().robot.poses.back().pose;
      ASSERT_LT(std::hypot(e.robot.mean.x - truth.x, e.robot.mean.y - truth.y), 0.5) << seed;
      const Vector3 error(e.robot.mean.x - truth.x, e.robot.mean.y - truth.y,
                          math::wrapToPi(e.robot.mean.phi - truth.phi));
      if (!step->landmarks || step->time < 4) continue;
      nees += math::mahalanobisSquared(error, e.robot.cov);
      ++count;
    }
  }
  // Of 20 drives, each about one independent error of three degrees: 60 +- 11, with room for five
  // deviations.
  EXPECT_LT(nees / count, 3 * (1 + 5 * std::sqrt(2.0 / 60)));
  EXPECT_GT(nees / count, 3 * (1 - 4 * std::sqrt(2.0 / 60)));
}
}  // namespace slamot::filters
