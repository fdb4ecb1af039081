#include "readMotion.h"

#include <mrpt/poses/CPosePDF.h>

#include <cmath>
#include <exception>

namespace slamot::mrpt
{
namespace
{
using ::mrpt::obs::CActionRobotMovement2D;

double square(double v)
{
  return v * v;
}

// Thrun, Burgard, Fox 2005, table 5.6, with independent normal errors of the first turn a (std sa),
// the way d (sd) and the second turn (sb): moments of (d cos a, d sin a, a + b), in closed form
// from E[exp(i a)] = exp(i a - sa² / 2).
Gaussian<Pose2D> thrunMoments(
    const Pose2D& u, const CActionRobotMovement2D::TMotionModelOptions::TOptions_ThrunModel& o)
{
  const double a = u.x != 0 || u.y != 0 ? std::atan2(u.y, u.x) : 0;
  const double d = std::hypot(u.x, u.y), b = math::wrapToPi(u.phi - a);
  const double sa = o.alfa1_rot_rot * std::abs(a) + o.alfa2_rot_trans * d;
  const double sb = o.alfa1_rot_rot * std::abs(b) + o.alfa2_rot_trans * d;
  const double sd = o.alfa3_trans_trans * d + o.alfa4_trans_rot * (std::abs(a) + std::abs(b));
  const double first = std::exp(-0.5 * sa * sa), second = std::exp(-2 * sa * sa);
  const double way2 = d * d + sd * sd;  // E[d²]
  const double x = d * first * std::cos(a), y = d * first * std::sin(a);

  Gaussian<Pose2D> out;
  out.mean = {x, y, math::wrapToPi(u.phi)};
  out.cov(0, 0) = 0.5 * way2 * (1 + second * std::cos(2 * a)) - x * x + square(o.additional_std_XY);
  out.cov(1, 1) = 0.5 * way2 * (1 - second * std::cos(2 * a)) - y * y + square(o.additional_std_XY);
  out.cov(0, 1) = out.cov(1, 0) = 0.5 * way2 * second * std::sin(2 * a) - x * y;
  out.cov(0, 2) = out.cov(2, 0) = -y * sa * sa;
  out.cov(1, 2) = out.cov(2, 1) = x * sa * sa;
  out.cov(2, 2) = sa * sa + sb * sb + square(o.additional_std_phi);
  return out;
}
}  // namespace

Gaussian<Pose2D> incrementOf(const CActionRobotMovement2D& action, const Entry& entry)
{
  Gaussian<Pose2D> out;
  if (action.estimationMethod == CActionRobotMovement2D::emOdometry &&
      action.motionModelConfiguration.modelSelection == CActionRobotMovement2D::mmThrun)
    out = thrunMoments(action.rawOdometryIncrementReading.asTPose(),
                       action.motionModelConfiguration.thrunModel);
  else
  {
    try
    {
      const auto [cov, mean] = action.poseChange->getCovarianceAndMean();
      out.mean = mean.asTPose();
      out.cov = cov.asEigen();
    }
    catch (const std::exception&)
    {
      entry.fail("the odometry's covariance can't be had from its PDF", "mend the log");
    }
  }
  if (!std::isfinite(out.mean.x + out.mean.y + out.mean.phi) || !out.cov.allFinite())
    entry.fail("the odometry is not a number", "mend the log");
  return out;
}

std::shared_ptr<const CActionRobotMovement2D> movementAmong(const Entry& actions)
{
  std::shared_ptr<const CActionRobotMovement2D> found;
  for (const Entry::Part& part : actions.parts)
  {
    if (part.className == "mrpt::obs::CActionRobotMovement3D")
      actions.fail("holds a movement in 3D (CActionRobotMovement3D)",
                   "give a log of planar odometry", core::ExitStatus::kUnreadable);
    const auto movement = std::dynamic_pointer_cast<const CActionRobotMovement2D>(part.object);
    if (movement &&
        (!found || movement->estimationMethod == CActionRobotMovement2D::emScan2DMatching))
      found = movement;
  }
  return found;
}
}  // namespace slamot::mrpt
