// What a landmark map does with sightings: it learns from them, or weighs a pose by them.
#include "sensorFrame.h"

#include <mrpt/obs/CObservationBearingRange.h>
#include <slamot/math/statistics.h>
#include <slamot/models/RangeBearing.h>
#include <slamot/mrpt/CLandmarkGaussianMap.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>

namespace slamot::maps
{
namespace
{
using core::Sighting;
using models::RangeBearing;
using ::mrpt::obs::CObservationBearingRange;
using Landmark = CLandmarkGaussianMap::Landmark;
using Options = CLandmarkGaussianMap::TInsertionOptions;

Pose2D inPlane(const ::mrpt::poses::CPose3D& pose)
{
  const Pose2D p{pose.x(), pose.y(), pose.yaw()};
  if (!std::isfinite(p.x + p.y + p.phi))
    throw std::invalid_argument("CLandmarkGaussianMap: the robot's pose is not finite");
  return p;
}

Matrix3 covarianceOf(const CObservationBearingRange& o,
                     const CObservationBearingRange::TMeasurement& m, const Options& options)
{
  if (o.validCovariances) return m.covariance.asEigen();
  const double range = o.sensor_std_range == 0 ? options.rangeStd : o.sensor_std_range;
  const double yaw = o.sensor_std_yaw == 0 ? options.bearingStd : o.sensor_std_yaw;
  const Vector3 stds(range, yaw, o.sensor_std_pitch);
  if (!(stds.minCoeff() >= 0))
    throw std::invalid_argument("CLandmarkGaussianMap: a negative standard deviation");
  return stds.cwiseAbs2().asDiagonal();
}

/// In the robot's plane; noise may put a range at or below zero, which tells nothing.
std::vector<Sighting> sightingsOf(const CObservationBearingRange& o, const Options& options)
{
  const slamot::mrpt::SensorFrame frame(o.sensorLocationOnRobot);
  std::vector<Sighting> out;
  for (const auto& m : o.sensedData)
  {
    const auto s = frame.point({m.range, m.yaw, m.pitch}, covarianceOf(o, m, options));
    if (m.range <= 0 || s.range < RangeBearing::kSmallestRange) continue;
    if (!std::isfinite(s.range + s.bearing + s.rangeStd + s.bearingStd) || !(s.rangeStd > 0) ||
        !(s.bearingStd > 0))
      throw std::invalid_argument(
          "CLandmarkGaussianMap: a sighting that is not finite, or whose deviation is not "
          "positive");
    out.push_back({s.range, s.bearing, s.rangeStd, s.bearingStd,
                   m.landmarkID < 0 ? core::kNoId : m.landmarkID});
  }
  return out;
}

/// A sighting against a landmark that might have caused it.
struct Pairing
{
  const Landmark* landmark = nullptr;
  Vector2 innovation;
  Matrix2 H, R, S;
  double distance = 0;  ///< Mahalanobis, squared

  [[nodiscard]] double logDensity(double farthest) const
  {
    return logDensity(S, std::min(distance, farthest));
  }
  [[nodiscard]] static double logDensity(const Matrix2& cov, double squared)
  {
    return -0.5 * squared - std::log(math::kTwoPi) - 0.5 * std::log(cov.determinant());
  }
  [[nodiscard]] Landmark updated() const
  {
    Landmark m = *landmark;
    const Matrix2 P = m.position.cov;
    const Matrix2 K = P * H.transpose() * S.inverse();
    const Vector2 shift = K * innovation;
    const Matrix2 rest = Matrix2::Identity() - K * H;
    m.position.mean.x += shift[0], m.position.mean.y += shift[1];
    // Joseph's form: it can't lose its positive eigenvalues to rounding.
    m.position.cov = rest * P * rest.transpose() + K * R * K.transpose();
    if (m.sightings < std::numeric_limits<std::int32_t>::max()) ++m.sightings;
    return m;
  }
};

/// None where the landmark is too near to the robot for a bearing.
std::optional<Pairing> pair(const Landmark& m, const Pose2D& pose, const Sighting& s)
{
  const RangeBearing::Z expected = RangeBearing::predict(pose, m.position.mean);
  if (expected[0] < RangeBearing::kSmallestRange) return std::nullopt;
  Pairing p;
  p.landmark = &m;
  p.innovation = RangeBearing::residual({s.range, s.bearing}, expected);
  p.H = RangeBearing::jacobians(pose, m.position.mean).point;
  p.R = RangeBearing(s.rangeStd, s.bearingStd).noise();
  p.S = p.H * m.position.cov * p.H.transpose() + p.R;
  p.distance = p.innovation.dot(p.S.inverse() * p.innovation);
  return p;
}

std::optional<Pairing> nearest(const std::vector<Landmark>& map, const Pose2D& pose,
                               const Sighting& s)
{
  std::optional<Pairing> best;
  for (const Landmark& m : map)
  {
    const auto p = pair(m, pose, s);
    if (p && (!best || p->distance < best->distance)) best = p;
  }
  return best;
}

Landmark founded(std::int32_t id, const Pose2D& pose, const Sighting& s)
{
  Landmark m;
  const RangeBearing::Z z{s.range, s.bearing};
  const Matrix2 J = RangeBearing::invertJacobian(pose, z);
  m.id = id;
  m.position.mean = RangeBearing::invert(pose, z);
  m.position.cov = J * RangeBearing(s.rangeStd, s.bearingStd).noise() * J.transpose();
  m.sightings = 1;
  return m;
}
constexpr std::int32_t kDropped = -2;

/// For each sighting the id of the landmark to update or to found, or kDropped.
std::vector<std::int32_t> idsOf(const std::vector<Sighting>& sightings,
                                const std::vector<Landmark>& map, const Pose2D& pose, double gate)
{
  std::int32_t last = map.empty() ? -1 : map.back().id;
  for (const Sighting& s : sightings) last = std::max(last, s.id);
  std::set<std::int32_t> taken;
  std::vector<std::int32_t> ids;
  for (const Sighting& s : sightings)
  {
    const auto p = s.id == core::kNoId ? nearest(map, pose, s) : std::nullopt;
    if (s.id != core::kNoId)
      ids.push_back(s.id);
    else if (p && p->distance <= gate)
      ids.push_back(taken.insert(p->landmark->id).second ? p->landmark->id : kDropped);
    else if (last < std::numeric_limits<std::int32_t>::max())
      ids.push_back(++last);
    else
      throw std::invalid_argument("CLandmarkGaussianMap: no number is left for a new landmark");
  }
  return ids;
}
}  // namespace

bool CLandmarkGaussianMap::internal_insertObservation(
    const ::mrpt::obs::CObservation& obs,
    const std::optional<const ::mrpt::poses::CPose3D>& robotPose)
{
  const auto* o = dynamic_cast<const CObservationBearingRange*>(&obs);
  if (!o) return false;
  const Pose2D pose = inPlane(robotPose.value_or(::mrpt::poses::CPose3D()));
  const double gate = math::chiSquareQuantile(insertionOptions.gateProbability, 2);
  const std::vector<Sighting> sightings = sightingsOf(*o, insertionOptions);
  const std::vector<std::int32_t> ids = idsOf(sightings, landmarks_, pose, gate);
  bool changed = false;
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    if (ids[i] == kDropped) continue;
    const Landmark* known = find(ids[i]);
    const auto p = known ? pair(*known, pose, sightings[i]) : std::nullopt;
    if (known && !p) continue;
    set(p ? p->updated() : founded(ids[i], pose, sightings[i]));
    changed = true;
  }
  return changed;
}

double CLandmarkGaussianMap::internal_computeObservationLikelihood(
    const ::mrpt::obs::CObservation& obs, const ::mrpt::poses::CPose3D& takenFrom) const
{
  const auto* o = dynamic_cast<const CObservationBearingRange*>(&obs);
  if (!o) return 0;
  const Pose2D pose = inPlane(takenFrom);
  const double gate = math::chiSquareQuantile(insertionOptions.gateProbability, 2);
  double sum = 0;
  for (const Sighting& s : sightingsOf(*o, insertionOptions))
  {
    const bool identified = s.id != core::kNoId;
    const Landmark* known = identified ? find(s.id) : nullptr;
    if (identified ? !known : isEmpty()) continue;
    const auto p = identified ? pair(*known, pose, s) : nearest(landmarks_, pose, s);
    if (p)
      sum += p->logDensity(identified ? std::numeric_limits<double>::infinity() : gate);
    else  // on top of the landmark: no better than at the gate
      sum += Pairing::logDensity(RangeBearing(s.rangeStd, s.bearingStd).noise(), gate);
  }
  return sum;
}

bool CLandmarkGaussianMap::internal_canComputeObservationLikelihood(
    const ::mrpt::obs::CObservation& obs) const
{
  return dynamic_cast<const CObservationBearingRange*>(&obs) != nullptr;
}
}  // namespace slamot::maps
