#include "poseErrors.h"

#include <slamot/math/statistics.h>

#include <cmath>

namespace slamot::eval
{
namespace
{
// Below this an eigenvalue of the correlation matrix is rounding: an error along it has no measure.
constexpr double kSingular = 1e-9;
// A variance this small [m2, rad2] is that of one particle which has all the weight, but for what
// rounds to nothing: none, and squared errors by it would have no finite mean.
constexpr double kNoVariance = 1e-100;

struct Mean
{
  double sum = 0;
  int count = 0;

  void add(double v) { sum += v, ++count; }
  [[nodiscard]] std::optional<double> value() const
  {
    if (count == 0) return std::nullopt;
    return sum / count;
  }
  [[nodiscard]] std::optional<double> root() const
  {
    if (count == 0) return std::nullopt;
    return std::sqrt(sum / count);
  }
};
}  // namespace

std::optional<double> nees(const Eigen::Ref<const Eigen::VectorXd>& e,
                           const Eigen::Ref<const Eigen::MatrixXd>& P)
{
  if (!P.allFinite() || !e.allFinite() || P.diagonal().minCoeff() <= kNoVariance)
    return std::nullopt;
  const Eigen::VectorXd scale = P.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd correlation = scale.asDiagonal() * P * scale.asDiagonal();
  if (math::smallestEigenvalue(correlation) < kSingular) return std::nullopt;
  return math::mahalanobisSquared(scale.cwiseProduct(e), correlation);
}

StepError poseError(std::size_t row, const Gaussian<Pose2D>& estimate, const TimedPose& truth,
                    const Pose2D& truthFromMap)
{
  const Pose2D pose = math::compose(truthFromMap, estimate.mean);
  const Matrix3 R = math::poseRotation(truthFromMap.phi);
  const Matrix3 P = R * estimate.cov * R.transpose();
  StepError out;
  out.row = row;
  out.headingKnown = truth.headingKnown;
  out.error = {pose.x - truth.pose.x, pose.y - truth.pose.y,
               truth.headingKnown ? math::wrapToPi(pose.phi - truth.pose.phi) : 0.0};
  if (truth.headingKnown) out.nees = nees(out.error, P);
  out.neesPosition = nees(out.error.head<2>(), P.topLeftCorner<2, 2>());
  return out;
}

StepError relativeError(std::size_t row, const Pose2D& robot, const Pose2D& target,
                        const Pose2D& trueRobot, const TimedPose& trueTarget)
{
  const Pose2D seen = math::between(robot, target);
  const Pose2D truly = math::between(trueRobot, trueTarget.pose);
  StepError out;
  out.row = row;
  out.headingKnown = trueTarget.headingKnown;
  out.error = {seen.x - truly.x, seen.y - truly.y,
               out.headingKnown ? math::wrapToPi(seen.phi - truly.phi) : 0.0};
  return out;
}

ErrorSummary summarise(const std::vector<StepError>& steps,
                       const std::function<bool(const StepError&)>& use)
{
  const double bound = math::chiSquareQuantile(0.95, 2);
  ErrorSummary out;
  std::vector<double> distances;
  Mean distance, squared, heading, nees3, nees2, inside;
  for (const StepError& s : steps)
  {
    if (!use(s)) continue;
    ++out.count;
    const double d2 = s.error.head<2>().squaredNorm();
    distances.push_back(std::sqrt(d2));
    distance.add(distances.back());
    squared.add(d2);
    if (s.headingKnown) heading.add(s.error[2] * s.error[2]);
    if (s.nees) nees3.add(*s.nees);
    if (!s.neesPosition)
    {
      ++out.neesSkipped;
      continue;
    }
    nees2.add(*s.neesPosition);
    inside.add(*s.neesPosition <= bound ? 1.0 : 0.0);
  }
  out.positionMean = distance.value();
  if (!distances.empty()) out.positionMedian = math::quantile(std::move(distances), 0.5);
  out.positionRmse = squared.root();
  out.headingRmse = heading.root();
  out.neesMean = nees3.value();
  out.neesPositionMean = nees2.value();
  out.coverage95 = inside.value();
  return out;
}

ErrorSummary summarise(const std::vector<StepError>& steps)
{
  return summarise(steps, [](const StepError&) { return true; });
}
}  // namespace slamot::eval
