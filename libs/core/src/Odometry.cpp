#include <slamot/core/Odometry.h>

#include <cmath>

namespace slamot::core
{
OdometryModel OdometryModel::from(Params& p)
{
  OdometryModel out;
  out.fromLog = p.choice("noise", {"log", "model"}, "log") == "log";
  if (out.fromLog)
  {
    p.allowUnused({"v_std_mps", "omega_std_deg_per_s", "v_scale_std", "omega_scale_std"});
    return out;
  }
  out.vStd = p.nonNegative("v_std_mps");
  out.omegaStd = p.nonNegative("omega_std_deg_per_s");
  out.vScaleStd = p.nonNegative("v_scale_std", 0.0);
  out.omegaScaleStd = p.nonNegative("omega_scale_std", 0.0);
  return out;
}

Gaussian<Pose2D> OdometryModel::apply(const Gaussian<Pose2D>& increment, double dt) const
{
  if (fromLog || dt <= 0) return increment;
  const double v =
      std::copysign(std::hypot(increment.mean.x, increment.mean.y), increment.mean.x) / dt;
  const double omega = increment.mean.phi / dt;
  Gaussian<Pose2D> out = math::turnThenMove(v, omega, dt, std::hypot(vStd, vScaleStd * v),
                                            std::hypot(omegaStd, omegaScaleStd * omega));
  out.mean = increment.mean;
  return out;
}
}  // namespace slamot::core
