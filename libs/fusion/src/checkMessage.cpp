#include <slamot/fusion/checkMessage.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace slamot::fusion
{
namespace
{
using core::RobotAndTarget;

bool finite(const Candidate& c)
{
  return std::isfinite(c.range) && std::isfinite(c.bearing) && std::isfinite(c.rangeStd) &&
         std::isfinite(c.bearingStd);
}

bool finite(const Message& m)
{
  const RobotAndTarget& e = m.estimate;
  return std::isfinite(e.time) && e.mean.allFinite() && e.cov.allFinite() &&
         std::all_of(m.candidates.begin(), m.candidates.end(),
                     [](const Candidate& c) { return finite(c); });
}

bool absurd(const Candidate& c, const MessageLimits& l)
{
  return !(c.range > 0 && c.range <= l.range && std::abs(c.bearing) <= math::kTwoPi &&
           c.rangeStd >= l.smallestStd && c.rangeStd <= l.rangeStd &&
           c.bearingStd >= l.smallestStd && c.bearingStd <= l.bearingStd);
}

// A negative variance is none of these: it is not positive definite.
bool absurd(const RobotAndTarget& e, const MessageLimits& l)
{
  for (Eigen::Index i = 0; i < e.mean.size(); ++i)
  {
    const bool place = i < 2 || i == 3 || i == 4, heading = i == 2, target = i >= 3;
    const double most = place ? l.placeStd : heading ? l.headingStd : l.motionStd;
    const double mean = place ? l.place : heading ? 1e3 : l.motionStd, variance = e.cov(i, i);
    if (std::abs(e.mean[i]) > mean || variance > most * most) return true;
    if (target && variance > 0 && variance < l.smallestStd * l.smallestStd) return true;
  }
  return false;
}

// The correlations; a coordinate without variance has none.
Eigen::MatrixXd correlation(const Eigen::Ref<const Eigen::MatrixXd>& cov)
{
  const Eigen::VectorXd scale =
      cov.diagonal().unaryExpr([](double v) { return v > 0 ? 1 / std::sqrt(v) : 0.0; });
  return scale.asDiagonal() * cov * scale.asDiagonal();
}

bool positiveSemidefinite(const Eigen::MatrixXd& cov)
{
  for (Eigen::Index i = 0; i < cov.rows(); ++i)
    if (cov(i, i) < 0 || (cov(i, i) == 0 && !cov.row(i).isZero(0))) return false;
  return math::smallestEigenvalue(correlation(cov)) >= -1e-9;  // false for NaN, of overflow
}
}  // namespace

bool positiveDefinite(const Eigen::Ref<const Eigen::MatrixXd>& cov)
{
  if (cov.size() == 0) return true;
  if (!(cov.diagonal().minCoeff() > 0)) return false;
  const Eigen::MatrixXd r = correlation(cov);
  return r.allFinite() && r.llt().info() == Eigen::Success;
}

std::optional<Outcome> checkValues(const Message& m, const MessageLimits& limits)
{
  if (!finite(m)) return Outcome::kNotFinite;
  const RobotAndTarget& e = m.estimate;
  if (absurd(e, limits) || std::any_of(m.candidates.begin(), m.candidates.end(),
                                       [&limits](const Candidate& c) { return absurd(c, limits); }))
    return Outcome::kAbsurd;
  const int n = e.targetSize();
  if (!positiveSemidefinite(e.cov) || !positiveDefinite(e.cov.bottomRightCorner(n, n)))
    return Outcome::kNotPositiveDefinite;
  return {};
}
}  // namespace slamot::fusion
