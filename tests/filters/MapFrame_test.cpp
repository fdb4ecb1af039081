#include "rbpf/MapFrame.h"

#include <gtest/gtest.h>
#include <slamot/math/random.h>
#include <slamot/models/RangeBearing.h>
#include <slamot/models/TargetMotion.h>

#include "filterRig.h"

namespace slamot::filters
{
namespace
{
using test::landmarks;
using test::makeFilter;

core::Step moved(double time, double std)
{
  core::Step step;
  step.time = time;
  step.odometry = math::turnThenMove(1, 0.2, 0.1, std, std);
  return step;
}

core::Step seeing(double time, const Pose2D& robot)
{
  core::Step step;
  step.time = time;
  step.landmarks.emplace();
  int id = 0;
  for (const Point2D& p : {Point2D{3, 1}, Point2D{2, -2}, Point2D{5, 0.5}})
  {
    const auto z = models::RangeBearing::predict(robot, p);
    step.landmarks->sightings.push_back({z[0], z[1], 0.05, 0.01, id++});
  }
  return step;
}

const std::string kKeys =
    "proposal = informed\nassociation = known\nparticles = 20\ntarget_velocity_std_mps = "
    "1\ntarget_velocity_time_s = 1\n";
}  // namespace

TEST(MapFrame, MovesCovariancesAsARigidMotionDoes)
{
  const Gaussian<Pose2D> first{{1, 2, 0.5}, Vector3(0.01, 0.02, 0.004).asDiagonal()};
  const rbpf::MapFrame frame(first);
  math::RandomStream random{3};
  Gaussian<Pose2D> pose{{4, -1, 2}, 0.001 * Matrix3::Identity()};
  Matrix3 sum = Matrix3::Zero();
  constexpr int kDraws = 20000;
  for (int i = 0; i < kDraws; ++i)
  {
    const Vector3 n = random.normal3();
    const double small = 0.01;  // of the deviations: where a turn is linear
    Pose2D to = first.mean;
    to.x += small * 0.1 * n[0];
    to.y += small * std::sqrt(0.02) * n[1];
    to.phi += small * std::sqrt(0.004) * n[2];
    const Pose2D q = math::compose(to, math::between(first.mean, pose.mean));
    const Vector3 d(q.x - pose.mean.x, q.y - pose.mean.y, q.phi - pose.mean.phi);
    sum += d * d.transpose() / (small * small * kDraws);
  }
  frame.addTo(pose);
  const Matrix3 added = pose.cov - 0.001 * Matrix3::Identity();
  // Four deviations of a variance's estimate.
  EXPECT_LT((added - sum).norm(), 4 * std::sqrt(2.0 / kDraws) * 3 * added.norm());
  Gaussian<Point2D> point{{4, -1}, Matrix2::Zero()};
  frame.addTo(point);
  EXPECT_LT((point.cov - (added.topLeftCorner<2, 2>())).norm(), 1e-12);
}

TEST(MapFrame, ATargetSharesItsDoubtWithHeadingAndVelocity)
{
  const Matrix3 cov = Vector3(0.01, 0.02, 0.04).asDiagonal();
  models::DampedVelocityTarget::State damped;
  damped.x << 1, 2, 0.5, -2;
  damped.P.setZero();
  models::DampedVelocityTarget::widen(damped, cov);
  // Turned by d, a velocity (vx, vy) becomes (vx - d vy, vy + d vx).
  Eigen::Matrix4d expected = Eigen::Vector4d(0.01, 0.02, 0, 0).asDiagonal();
  const Vector2 turned(2, 0.5);
  expected.bottomRightCorner<2, 2>() = 0.04 * turned * turned.transpose();
  EXPECT_LT((damped.P - expected).norm(), 1e-12);

  models::DifferentialDriveTarget::State driving;
  driving.x << 1, 2, 0.3, 1, 0.1;
  driving.P.setZero();
  models::DifferentialDriveTarget::widen(driving, cov);
  EXPECT_LT((driving.P.topLeftCorner<3, 3>() - cov).norm(), 1e-12);
  EXPECT_EQ((driving.P.bottomRightCorner<2, 2>().norm()), 0.0);
}

TEST(MapFrame, AKnownTargetDoesNotPullTheFirstPose)
{
  core::FilterContext context;
  auto& start = context.starts.targets[7];
  start.value[core::ObjectStart::kX] = 3;
  start.value[core::ObjectStart::kY] = 0;
  context.starts.time = 0;
  const auto filter = makeFilter("rbpf-slamot", kKeys, context);
  filter->process(moved(0.1, 0.5));
  const Gaussian<Pose2D> before = filter->estimate().robot;
  core::Step step = seeing(0.2, before.mean);
  step.blobs.emplace().blobs = {{"target", 2.5, 0.2, 0.1, 0.02, 7}};
  filter->process(step);
  const auto& e = filter->estimate();
  EXPECT_LT((e.robot.cov - before.cov).norm(), 1e-9);
  ASSERT_EQ(e.targets.size(), 1u);
  EXPECT_GT((e.targets[0].pose.cov.topLeftCorner<2, 2>().trace()), before.cov(0, 0));
}

TEST(MapFrame, TheFirstPosesDoubtStaysHoweverOftenParticlesAreResampled)
{
  const auto filter = makeFilter("rbpf-slamot", kKeys + "resample_below_ess = 1\n");
  const core::Step start = moved(0.1, 0.5);
  filter->process(start);
  const Matrix3 first = filter->estimate().robot.cov;
  const Pose2D robot = filter->estimate().robot.mean;
  for (int k = 0; k < 50; ++k) filter->process(seeing(0.2 + 0.1 * k, robot));
  const auto& now = filter->estimate().robot;
  // Standing still, it knows its place no better than before it saw anything, and no worse.
  EXPECT_LT((now.cov - first).norm(), 0.1 * first.norm());
  EXPECT_NEAR(now.mean.x, robot.x, 0.02);
  EXPECT_NEAR(now.mean.phi, robot.phi, 0.01);
  for (const auto& [id, l] : landmarks(filter->estimate()))
    EXPECT_GT(l.position.cov.trace(), first(0, 0) + first(1, 1)) << id;
}

TEST(MapFrame, AnExactStartLeavesNoDoubt)
{
  const auto filter = makeFilter("rbpf-slamot", kKeys);
  for (int k = 0; k < 50; ++k) filter->process(seeing(0.1 * k, {}));
  EXPECT_LT(filter->estimate().robot.cov.norm(), 1e-12);
  for (const auto& [id, l] : landmarks(filter->estimate()))
    EXPECT_LT(l.position.cov.trace(), (0.05 * 0.05 + 0.01 * 0.01 * 5.1 * 5.1) / 50) << id;
}
}  // namespace slamot::filters
