#include "toObservations.h"

#include <slamot/mrpt/timestamp.h>

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <slamot/mrpt/CObservationColorBlobs.h>

#include <algorithm>
#include <set>

namespace slamot::mrpt
{
namespace
{
using ::mrpt::obs::CObservation2DRangeScan;
using ::mrpt::obs::CObservationBearingRange;
using ::mrpt::poses::CPose3D;

constexpr double kNoRangeLimit = core::FieldOfView{}.rangeMax;

// Limits are floats in MRPT's class: rounded outwards, so that what was in view stays in view.
float roundUp(double v)
{
  const auto f = static_cast<float>(v);
  return f < v ? std::nextafter(f, 1e30f) : f;
}
float roundDown(double v)
{
  return -roundUp(-v);
}

// The class has a symmetric field of view only: the sensor is turned to its middle.
std::shared_ptr<CObservationBearingRange> emptyScan(const core::FieldOfView& fov, double time)
{
  auto out = std::make_shared<CObservationBearingRange>();
  out->timestamp = toTimestamp(time);
  out->sensorLabel = "LANDMARKS";
  out->minSensorDistance = roundDown(fov.rangeMin);
  out->maxSensorDistance = fov.rangeMax >= kNoRangeLimit ? 0 : roundUp(fov.rangeMax);
  out->fieldOfView_pitch = 0;
  const double width = fov.bearingMax - fov.bearingMin;
  out->fieldOfView_yaw = roundUp(std::min(width, math::kTwoPi));
  if (width < math::kTwoPi)
    out->sensorLocationOnRobot = CPose3D(0, 0, 0, 0.5 * (fov.bearingMin + fov.bearingMax), 0, 0);
  return out;
}

bool sameDeviations(const std::vector<core::Sighting>& sightings)
{
  return std::all_of(
      sightings.begin(), sightings.end(),
      [&](const core::Sighting& s)
      { return s.rangeStd == sightings[0].rangeStd && s.bearingStd == sightings[0].bearingStd; });
}

CObservationBearingRange::TMeasurement toMeasurement(const core::Sighting& s, double sensorYaw)
{
  CObservationBearingRange::TMeasurement m;
  m.range = static_cast<float>(s.range);
  m.yaw = static_cast<float>(math::wrapToPi(s.bearing - sensorYaw));
  m.pitch = 0;
  m.landmarkID = s.id;
  m.covariance.setZero();
  m.covariance(0, 0) = s.rangeStd * s.rangeStd;
  m.covariance(1, 1) = m.covariance(2, 2) = s.bearingStd * s.bearingStd;
  return m;
}

// MRPT refuses an identity that comes twice in one observation: the second opens another.
void addLandmarks(std::vector<::mrpt::obs::CObservation::Ptr>& out, const core::LandmarkScan& scan,
                  double time)
{
  const bool uniform = sameDeviations(scan.sightings);
  std::set<int> ids;
  auto current = emptyScan(scan.fov, time);
  const auto fresh = [&]
  {
    current->validCovariances = !uniform;
    if (!uniform || scan.sightings.empty()) return;
    current->sensor_std_range = static_cast<float>(scan.sightings[0].rangeStd);
    current->sensor_std_yaw = static_cast<float>(scan.sightings[0].bearingStd);
    current->sensor_std_pitch = current->sensor_std_yaw;
  };
  fresh();
  for (const core::Sighting& s : scan.sightings)
  {
    if (s.id != core::kNoId && !ids.insert(s.id).second)
    {
      out.push_back(current);
      current = emptyScan(scan.fov, time);
      fresh();
      ids = {s.id};
    }
    current->sensedData.push_back(toMeasurement(s, current->sensorLocationOnRobot.yaw()));
  }
  out.push_back(current);
}

::mrpt::obs::CObservation::Ptr toBlobs(const core::BlobScan& scan, double time)
{
  auto out = std::make_shared<obs::CObservationColorBlobs>();
  out->timestamp = toTimestamp(time);
  out->sensorLabel = "BLOBS";
  out->rangeMin = scan.fov.rangeMin, out->rangeMax = scan.fov.rangeMax;
  out->bearingMin = scan.fov.bearingMin, out->bearingMax = scan.fov.bearingMax;
  for (const core::Blob& b : scan.blobs)
  {
    auto& blob = out->blobs.emplace_back();
    blob.label = b.label, blob.id = b.id;
    blob.bearing = b.bearing, blob.bearingStd = b.bearingStd;
    blob.elevationStd = b.bearingStd;
    blob.range = b.range;
    if (b.range) blob.rangeStd = b.rangeStd;
  }
  return out;
}

// The class's scans are symmetric about the sensor's axis: the sensor is turned to their middle.
::mrpt::obs::CObservation::Ptr toScan(const core::LaserScan& scan, double time, std::size_t number)
{
  auto out = std::make_shared<CObservation2DRangeScan>();
  out->timestamp = toTimestamp(time);
  out->sensorLabel = "LASER" + std::to_string(number);
  const std::size_t n = scan.ranges.size();
  const double aperture = n > 1 ? scan.angleStep * static_cast<double>(n - 1) : 0;
  out->aperture = static_cast<float>(std::abs(aperture));
  out->rightToLeft = aperture >= 0;
  out->maxRange = static_cast<float>(scan.rangeMax);
  const Pose2D& p = scan.pose_robot_sensor;
  out->sensorPose =
      CPose3D(p.x, p.y, 0, math::wrapToPi(p.phi + scan.angleMin + 0.5 * aperture), 0, 0);
  out->resizeScan(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const float range = scan.ranges[i];
    const bool valid = std::isfinite(range) && range > 0 && range <= scan.rangeMax;
    out->setScanRange(i, valid ? range : static_cast<float>(scan.rangeMax));
    out->setScanRangeValidity(i, valid);
  }
  return out;
}
}  // namespace

std::vector<::mrpt::obs::CObservation::Ptr> toObservations(const core::Step& step)
{
  std::vector<::mrpt::obs::CObservation::Ptr> out;
  if (step.landmarks) addLandmarks(out, *step.landmarks, step.time);
  if (step.blobs) out.push_back(toBlobs(*step.blobs, step.time));
  for (std::size_t i = 0; i < step.lasers.size(); ++i)
    out.push_back(toScan(*step.lasers[i], step.time, i));
  return out;
}

::mrpt::math::TTwist2D meanVelocity(const Pose2D& increment, double dt)
{
  return {increment.x / dt, increment.y / dt, increment.phi / dt};
}

::mrpt::obs::CActionRobotMovement2D toAction(const Gaussian<Pose2D>& increment, double time,
                                             std::optional<double> dt)
{
  ::mrpt::obs::CActionRobotMovement2D out;
  auto pdf = ::mrpt::poses::CPosePDFGaussian::Create();
  pdf->mean = ::mrpt::poses::CPose2D(increment.mean);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) pdf->cov(r, c) = increment.cov(r, c);
  out.poseChange = ::mrpt::poses::CPosePDF::Ptr(pdf);
  out.estimationMethod = ::mrpt::obs::CActionRobotMovement2D::emScan2DMatching;
  out.rawOdometryIncrementReading = pdf->mean;
  out.timestamp = toTimestamp(time);
  out.hasVelocities = dt && *dt > 0;
  if (out.hasVelocities) out.velocityLocal = meanVelocity(increment.mean, *dt);
  return out;
}
}  // namespace slamot::mrpt
