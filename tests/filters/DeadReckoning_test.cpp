#include "filterRig.h"

#include <slamot/math/random.h>
#include <slamot/math/statistics.h>

namespace slamot::filters
{
namespace
{
using test::makeFilter;
}

TEST(DeadReckoning, SumsOdometryFromTheStart)
{
  core::FilterContext context;
  context.starts.time = 5.0;
  context.starts.robot.emplace().value = {1.0, 2.0, math::kPi / 2};
  const auto filter = makeFilter("dead-reckoning", "", context);
  EXPECT_EQ(filter->estimate().robot.mean, Pose2D(1, 2, math::kPi / 2));
  core::Step step;
  step.time = 6;
  step.odometry = Gaussian<Pose2D>{{2, 0, -math::kPi / 2}, Matrix3::Zero()};
  const core::Estimate e = filter->process(step).estimate;
  EXPECT_NEAR(e.robot.mean.x, 1, 1e-15);
  EXPECT_NEAR(e.robot.mean.y, 4, 1e-15);
  EXPECT_NEAR(e.robot.mean.phi, 0, 1e-15);
  EXPECT_EQ(e.time, 6);
  EXPECT_EQ(e.landmarks, nullptr);
  step.odometry.reset();
  EXPECT_EQ(filter->process(step).estimate.robot.mean, e.robot.mean);
}

// The noise is small enough for first order.
TEST(DeadReckoning, CovarianceIsThatOfSampledDrives)
{
  constexpr int kDrives = 3000, kSteps = 40;
  constexpr double v = 1, w = 0.5, dt = 0.1, stdV = 0.2, stdW = 0.1;
  const auto filter = makeFilter("dead-reckoning", "");
  core::Estimate e;
  for (int i = 1; i <= kSteps; ++i)
  {
    core::Step step;
    step.time = i * dt;
    step.odometry = math::turnThenMove(v, w, dt, stdV, stdW);
    e = filter->process(step).estimate;
  }
  double sum = 0;
  for (std::uint64_t drive = 0; drive < kDrives; ++drive)
  {
    math::RandomStream random{1, drive};
    Pose2D pose;
    for (int i = 0; i < kSteps; ++i)
      pose = math::compose(
          pose, math::turnThenMove(v + stdV * random.normal(), w + stdW * random.normal(), dt, 0, 0)
                    .mean);
    const Pose2D& m = e.robot.mean;
    sum += math::mahalanobisSquared(
        Vector3(pose.x - m.x, pose.y - m.y, math::wrapToPi(pose.phi - m.phi)), e.robot.cov);
  }
  EXPECT_LT(sum, math::chiSquareQuantile(0.9998, 3 * kDrives));
  EXPECT_GT(sum, math::chiSquareQuantile(0.0002, 3 * kDrives));
}
}  // namespace slamot::filters
