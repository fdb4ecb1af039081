#include "readMotion.h"

#include <mrpt/poses/CPosePDFGaussianInf.h>
#include <mrpt/poses/CPosePDFParticles.h>

#include <Eigen/LU>
#include <algorithm>

#include <cmath>
#include <exception>
#include <limits>

namespace slamot::mrpt
{
namespace
{
using ::mrpt::obs::CActionRobotMovement2D;
using ::mrpt::poses::CPosePDFParticles;

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
// MRPT takes the absolute difference of headings, which loses their correlation with the position.
Gaussian<Pose2D> particleMoments(const CPosePDFParticles& pdf)
{
  double heaviest = -std::numeric_limits<double>::infinity();
  for (const auto& p : pdf.m_particles) heaviest = std::max(heaviest, p.log_w);
  double sum = 0, c = 0, s = 0;
  Gaussian<Pose2D> out;
  for (const auto& p : pdf.m_particles)
  {
    const double w = std::exp(p.log_w - heaviest);
    sum += w, c += w * std::cos(p.d.phi), s += w * std::sin(p.d.phi);
    out.mean.x += w * p.d.x, out.mean.y += w * p.d.y;
  }
  out.mean = {out.mean.x / sum, out.mean.y / sum, std::atan2(s, c)};
  for (const auto& p : pdf.m_particles)
  {
    const Vector3 e(p.d.x - out.mean.x, p.d.y - out.mean.y, math::wrapToPi(p.d.phi - out.mean.phi));
    out.cov += std::exp(p.log_w - heaviest) / sum * e * e.transpose();
  }
  return out;
}

Gaussian<Pose2D> momentsOf(const ::mrpt::poses::CPosePDF& pdf)
{
  if (const auto* particles = dynamic_cast<const CPosePDFParticles*>(&pdf))
    return particleMoments(*particles);
  Gaussian<Pose2D> out;
  if (const auto* inf = dynamic_cast<const ::mrpt::poses::CPosePDFGaussianInf*>(&pdf))
  {
    // Loading, MRPT fills in the upper half only.
    const Matrix3 information = inf->cov_inv.asEigen().selfadjointView<Eigen::Upper>();
    out.mean = inf->mean.asTPose();
    out.cov = information.inverse();
    return out;
  }
  const auto [cov, mean] = pdf.getCovarianceAndMean();
  out.mean = mean.asTPose();
  out.cov = cov.asEigen();
  return out;
}
}  // namespace

Gaussian<Pose2D> incrementOf(const CActionRobotMovement2D& action, const Entry& entry)
{
  const bool isThrun =
      action.estimationMethod == CActionRobotMovement2D::emOdometry &&
      action.motionModelConfiguration.modelSelection == CActionRobotMovement2D::mmThrun;
  Gaussian<Pose2D> out;
  try
  {
    out = isThrun ? thrunMoments(action.rawOdometryIncrementReading.asTPose(),
                                 action.motionModelConfiguration.thrunModel)
                  : momentsOf(*action.poseChange);
  }
  catch (const std::exception&)
  {
    entry.fail("the odometry's covariance can't be had from its PDF", "mend the log");
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
