#include <slamot/core/Team.h>
#include <slamot/math/intersection.h>

#include <Eigen/Eigenvalues>
#include <limits>

#include "drives.h"
#include "filterRig.h"

namespace slamot::filters
{
namespace
{
using core::RobotAndTarget;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::Way;

struct Member
{
  std::unique_ptr<core::Filter> filter;
  core::TeamFilter* team;

  Member(const Way& way, const core::Starts& starts, int particles = 40, int threads = 1)
  {
    core::FilterContext context;
    context.starts = starts;
    context.threads = threads;
    filter = test::makeFilter("rbpf-slamot", test::keysOf(way, particles), context);
    team = dynamic_cast<core::TeamFilter*>(filter.get());
  }
};

const Way kInformed{true, true, false}, kMotion{false, true, true};

/// A drive whose start is as uncertain as after a long way.
laws::Drive uncertainDrive(const Way& way, std::uint64_t seed)
{
  laws::Drive d = test::drive(way, seed);
  auto& start = d.starts.robot.value();
  for (std::size_t i = 0; i < 3; ++i) start.std[i] = i < 2 ? 0.5 : 0.05;
  return d;
}

/// Another's view of the target, and of this robot's place where asked for.
core::Evidence toldOf(const RobotAndTarget& own, bool withPlace, double var, double off)
{
  const Eigen::Index k = own.targetSize(), first = withPlace ? 2 : 0;
  core::Evidence e;
  e.target = own.target;
  e.H = MatrixXd::Zero(first + k, own.mean.size());
  e.H.topLeftCorner(first, first).setIdentity();
  e.H.bottomRightCorner(k, k).setIdentity();
  e.cov = var * MatrixXd::Identity(first + k, first + k);
  e.independent = 0.2 * e.cov;
  e.innovation = VectorXd::Constant(first + k, off);
  return e;
}

const core::FusionOptions kCi{core::FusionRule::kCi, {}, 5};
}  // namespace

TEST(RbpfTeam, TellsOfRobotAndTargetWhatItsEstimateDoes)
{
  int resampled = 0;
  for (const Way& way : {kInformed, kMotion})
  {
    const laws::Drive drive = uncertainDrive(way, 3);
    Member m(way, drive.starts);
    for (std::size_t n = 0; n < drive.steps.size(); ++n)
    {
      resampled += m.filter->process(drive.steps[n]).diagnostics.resampled;
      if (n == 30)
      {
        ASSERT_TRUE(m.team
                        ->fuse(toldOf(m.team->robotAndTarget(0), true, 0.1, 0.1),
                               {core::FusionRule::kCi, 0.5, 5})
                        .fused);
      }
      const core::Estimate e = m.filter->estimate();
      const RobotAndTarget both = m.team->robotAndTarget(0), alone = m.team->robotAndTarget(7);
      EXPECT_EQ(alone.target, core::kNoId);
      EXPECT_EQ(alone.cov, MatrixXd(e.robot.cov));
      EXPECT_EQ(both.time, e.time);
      ASSERT_EQ(both.mean.size(), 7);
      ASSERT_EQ(e.targets.size(), 1u);
      const auto& t = e.targets[0];
      EXPECT_EQ(both.cov.topLeftCorner(3, 3), MatrixXd(e.robot.cov));
      EXPECT_EQ(both.mean[0], e.robot.mean.x);
      EXPECT_NEAR(both.mean[3], t.pose.mean.x, 1e-9);
      EXPECT_NEAR(both.mean[4], t.pose.mean.y, 1e-9);
      EXPECT_LT((both.mean.tail(2) - t.velocity).norm(), 1e-9);
      EXPECT_LT((both.cov.block(3, 3, 2, 2) - t.pose.cov.topLeftCorner(2, 2)).norm(), 1e-9);
      EXPECT_LT((both.cov.block(5, 5, 2, 2) - t.velocityCov).norm(), 1e-9);
      EXPECT_LT(math::asymmetry(both.cov), 1e-15);
      EXPECT_GT(math::smallestEigenvalue(both.cov), -1e-9) << "step " << n;
    }
  }
  EXPECT_GT(resampled, 4);
}

// What both don't know of the start they have in common: of the target as seen from the robot,
// little is left.
TEST(RbpfTeam, KnowsWhatRobotAndTargetHaveInCommon)
{
  for (const Way& way : {kInformed, kMotion})
  {
    laws::Drive drive = uncertainDrive(way, 5);
    drive.starts.targets.clear();  // else its start is told in the map, apart from the robot's
    Member m(way, drive.starts, 400);
    for (const core::Step& step : drive.steps) m.filter->process(step);
    const RobotAndTarget both = m.team->robotAndTarget(0);
    ASSERT_EQ(both.targetSize(), 4);
    MatrixXd relative = MatrixXd::Zero(2, 7);
    relative.rightCols(4).leftCols(2).setIdentity();
    relative.leftCols(2) = -Matrix2::Identity();
    relative(0, 2) = both.mean[4] - both.mean[1];
    relative(1, 2) = -(both.mean[3] - both.mean[0]);
    const double apart = (relative * both.cov * relative.transpose()).trace();
    EXPECT_GT(both.cov.block(3, 3, 2, 2).trace(), 0.3);
    EXPECT_LT(apart, 0.15) << "informed " << way.informed;
  }
}

TEST(RbpfTeam, FusesAsCovarianceIntersectionOfTheMoments)
{
  for (const Way& way : {kInformed, kMotion})
    for (const bool withPlace : {false, true})
    {
      const laws::Drive drive = uncertainDrive(way, 4);
      Member m(way, drive.starts, 1000);
      for (const core::Step& step : drive.steps) m.filter->process(step);
      const RobotAndTarget own = m.team->robotAndTarget(0);
      const core::Evidence e = toldOf(own, withPlace, 0.1, 0.2);
      const double w = 0.6;
      const core::Fusion fusion = m.team->fuse(e, {core::FusionRule::kCi, w, 5});
      ASSERT_TRUE(fusion.fused);
      EXPECT_EQ(fusion.omega, w);
      const MatrixXd A = e.H * own.cov * e.H.transpose() / w + e.cov / (1 - w);
      const MatrixXd K = own.cov * e.H.transpose() / w * A.inverse();
      const VectorXd mean = own.mean + K * e.innovation;
      const MatrixXd cov = own.cov / w - K * A * K.transpose();
      const RobotAndTarget after = m.team->robotAndTarget(0);
      const VectorXd std = cov.diagonal().cwiseSqrt();
      // The other model knows the target's speed, and has no place for a doubt of it.
      for (Eigen::Index i = 0; i < (way.differentialDrive ? 5 : 7); ++i)
      {
        EXPECT_NEAR(after.mean[i], mean[i], 0.15 * std[i]) << i << " informed " << way.informed;
        EXPECT_GT(after.cov(i, i), 0.85 * cov(i, i)) << i << " informed " << way.informed;
      }
      EXPECT_LT(after.cov.diagonal().head(5).sum(), 1.6 * cov.diagonal().head(5).sum());
    }
}

// One particle, so that nothing is drawn that could differ.
TEST(RbpfTeam, MovesRobotAndMapAsOneBody)
{
  const laws::Drive drive = uncertainDrive(kInformed, 6);
  Member m(kInformed, drive.starts, 1);
  for (const core::Step& step : drive.steps) m.filter->process(step);
  const Pose2D before = m.filter->particles()[0].pose;
  const auto mapBefore = test::landmarks(m.filter->estimate());
  ASSERT_TRUE(m.team->fuse(toldOf(m.team->robotAndTarget(0), true, 0.05, 0.5), kCi).fused);
  const Pose2D after = m.filter->particles()[0].pose;
  const auto mapAfter = test::landmarks(m.filter->estimate());
  EXPECT_GT(std::hypot(after.x - before.x, after.y - before.y), 0.2);
  ASSERT_EQ(mapAfter.size(), mapBefore.size());
  ASSERT_FALSE(mapBefore.empty());
  const auto seenFrom = [](const Pose2D& pose, const core::LandmarkEstimate& l) {
    return math::between(pose, {l.position.mean.x, l.position.mean.y, 0});
  };
  for (const auto& [id, l] : mapBefore)
  {
    const Pose2D was = seenFrom(before, l), is = seenFrom(after, mapAfter.at(id));
    EXPECT_NEAR(was.x, is.x, 1e-9);
    EXPECT_NEAR(was.y, is.y, 1e-9);
  }
}

TEST(RbpfTeam, ChangesNoBitWhereFusingDoesNotPayOrIsRefused)
{
  for (const Way& way : {kInformed, kMotion})
  {
    const laws::Drive drive = uncertainDrive(way, 2);
    Member heard(way, drive.starts), alone(way, drive.starts);
    for (const core::Step& step : drive.steps)
    {
      const bool first = test::landmarks(heard.filter->estimate()).empty();
      heard.filter->process(step);
      alone.filter->process(step);
      if (first) continue;
      const RobotAndTarget own = heard.team->robotAndTarget(0);
      EXPECT_FALSE(heard.team->fuse(toldOf(own, true, 1e14, 0), kCi).fused);
      EXPECT_FALSE(
          heard.team->fuse(toldOf(own, true, 0.01, 0), {core::FusionRule::kNone, {}, 5}).fused);
      core::Evidence wrong = toldOf(own, true, 0.01, 0);
      wrong.innovation[2] = std::numeric_limits<double>::infinity();
      EXPECT_THROW(heard.team->fuse(wrong, kCi), core::Error);
      wrong = toldOf(own, false, -1, 0);
      EXPECT_THROW(heard.team->fuse(wrong, kCi), core::Error);
      wrong = toldOf(own, false, 0.01, 0);
      wrong.target = 5;  // unknown here: then the robot's columns only
      EXPECT_THROW(heard.team->fuse(wrong, kCi), core::Error);
      ASSERT_EQ(test::bytes(*heard.filter), test::bytes(*alone.filter));
    }
  }
}

TEST(RbpfTeam, RefusesEvidenceBeforeItHasAMap)
{
  const laws::Drive drive = uncertainDrive(kInformed, 2);
  Member m(kInformed, drive.starts);
  const auto before = test::bytes(*m.filter);
  EXPECT_THROW(m.team->fuse(toldOf(m.team->robotAndTarget(0), true, 0.01, 0), kCi), core::Error);
  EXPECT_EQ(test::bytes(*m.filter), before);
}

TEST(RbpfTeam, GivesTheSameWhateverTheThreads)
{
  for (const Way& way : {kInformed, kMotion})
  {
    const laws::Drive drive = uncertainDrive(way, 8);
    std::string results[2];
    for (const int threads : {1, 2})
    {
      Member m(way, drive.starts, 60, threads);
      for (std::size_t n = 0; n < drive.steps.size(); ++n)
      {
        m.filter->process(drive.steps[n]);
        if (n % 5 == 4)  // between scans too, with motion since the last
          m.team->fuse(toldOf(m.team->robotAndTarget(0), n % 2 == 0, 0.02, 0.05), kCi);
        results[threads - 1] += test::bytes(*m.filter);
      }
    }
    EXPECT_EQ(results[0], results[1]);
  }
}

// The target's model is the one filter's as the other's.
TEST(RbpfTeam, PredictsATargetAsTheEkfDoes)
{
  const std::string keys =
      "target_motion = constant-acceleration\ntarget_velocity_std_mps = 2\n"
      "target_acceleration_std_mps2 = 0.5\ntarget_jerk_noise_mps3_per_sqrt_hz = 0.05\n"
      "association = known\n";
  const auto rbpf = test::makeFilter("rbpf-slamot", keys + "particles = 2\nproposal = informed\n");
  const auto ekf = test::makeFilter("ekf-slamot", keys);
  for (const int size : {0, 4, 6})
  {
    RobotAndTarget a;
    a.time = 3;
    a.mean = VectorXd::LinSpaced(3 + size, 1, 2);
    a.cov = MatrixXd::Identity(3 + size, 3 + size);
    const RobotAndTarget start = a;
    RobotAndTarget b = a;
    dynamic_cast<core::TeamFilter&>(*rbpf).predictTarget(a, 0.7);
    dynamic_cast<core::TeamFilter&>(*ekf).predictTarget(b, 0.7);
    EXPECT_EQ(a.mean, b.mean);
    EXPECT_EQ(a.cov, b.cov);
    EXPECT_EQ(a.time, b.time);
    if (size == 4)
    {
      EXPECT_NEAR(a.mean[3], start.mean[3] + 0.7 * start.mean[5], 1e-12);
    }
  }
}
}  // namespace slamot::filters
