#include "readObservation.h"

#include "sensorFrame.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <slamot/mrpt/CObservationColorBlobs.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace slamot::mrpt
{
namespace
{
using ::mrpt::obs::CObservation2DRangeScan;
using ::mrpt::obs::CObservationBearingRange;
using obs::CObservationColorBlobs;

constexpr double kRounding = 1e-6;  // of the floats that MRPT stores [m, rad]

// Finite, and a rotation: MRPT reads any nine numbers as one.
bool isPose(const ::mrpt::poses::CPose3D& p)
{
  const Matrix3 r = p.getRotationMatrix().asEigen();
  return std::isfinite(p.x() + p.y() + p.z()) && r.allFinite() &&
         (r * r.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff() < 1e-3;
}

bool inView(const core::FieldOfView& fov, double range, double bearing)
{
  return range >= fov.rangeMin - kRounding && range <= fov.rangeMax + kRounding &&
         bearing >= fov.bearingMin - kRounding && bearing <= fov.bearingMax + kRounding;
}

// About the sensor's axis; MRPT's zero means no limit.
core::FieldOfView viewOf(const CObservationBearingRange& o, const Entry& entry)
{
  core::FieldOfView fov;
  if (!std::isfinite(o.minSensorDistance + o.maxSensorDistance + o.fieldOfView_yaw +
                     o.fieldOfView_pitch) ||
      !isPose(o.sensorLocationOnRobot))
    entry.fail("the landmark sensor's pose or field of view makes no sense", "mend the log");
  fov.rangeMin = o.minSensorDistance;
  if (o.maxSensorDistance > 0) fov.rangeMax = o.maxSensorDistance;
  if (o.fieldOfView_yaw > 0 && o.fieldOfView_yaw < math::kTwoPi)
    fov.bearingMin = -0.5 * o.fieldOfView_yaw, fov.bearingMax = 0.5 * o.fieldOfView_yaw;
  return fov;
}

Matrix3 covarianceOf(const CObservationBearingRange& o,
                     const CObservationBearingRange::TMeasurement& m, const Entry& entry,
                     const RawlogSource::SensorDeviations& otherwise)
{
  Matrix3 cov = Matrix3::Zero();
  if (o.validCovariances)
    cov = m.covariance.asEigen();
  else
  {
    const double range = o.sensor_std_range == 0 ? otherwise.range : o.sensor_std_range;
    const double yaw = o.sensor_std_yaw == 0 ? otherwise.bearing : o.sensor_std_yaw;
    // A negative deviation must stay visible in its square.
    cov.diagonal() << range * std::abs(range), yaw * std::abs(yaw),
        o.sensor_std_pitch * o.sensor_std_pitch;
  }
  if (!cov.allFinite() || cov(0, 0) < 0 || cov(1, 1) < 0 || cov(2, 2) < 0)
    entry.fail("a landmark sighting has a negative standard deviation, or none that is a number",
               "mend the log");
  if (cov(0, 0) == 0 || cov(1, 1) == 0)
    entry.fail("a landmark sighting has a standard deviation of zero",
               "set range_std_m and bearing_std_deg in [sensor], or with --set");
  return cov;
}

void addLandmarks(core::Step& step, const CObservationBearingRange& o, const Entry& entry,
                  const RawlogSource::SensorDeviations& otherwise)
{
  const core::FieldOfView fov = viewOf(o, entry);
  const SensorFrame frame(o.sensorLocationOnRobot);
  const core::FieldOfView view = frame.view(fov);
  if (step.landmarks)
    step.landmarks->fov = join(step.landmarks->fov, view);
  else
    step.landmarks.emplace().fov = view;

  for (const auto& m : o.sensedData)
  {
    if (!std::isfinite(m.range + m.yaw + m.pitch))
      entry.fail("a landmark sighting is not a number", "mend the log");
    const Matrix3 cov = covarianceOf(o, m, entry, otherwise);
    const auto seen = frame.point({m.range, m.yaw, m.pitch}, cov);
    if (m.range <= 0 || !inView(fov, m.range, math::wrapToPi(m.yaw)) || seen.range <= 0)
      ++step.dropped;
    else
      step.landmarks->sightings.push_back({seen.range, seen.bearing, seen.rangeStd, seen.bearingStd,
                                           m.landmarkID < 0 ? core::kNoId : m.landmarkID});
  }
}

// Positive and finite; a NaN fails every comparison.
bool good(double std)
{
  return std > 0 && std < 1e9;
}

void addBlob(core::Step& step, const CObservationColorBlobs::Blob& b, const SensorFrame& frame,
             const core::FieldOfView& fov, const Entry& entry)
{
  if (!std::isfinite(b.bearing + b.elevation) || !good(b.bearingStd) || b.elevationStd < 0 ||
      !std::isfinite(b.elevationStd) ||
      (b.range && (!std::isfinite(*b.range) || !good(b.rangeStd))))
    entry.fail("a blob has a value that is not a number, or a deviation that is not positive",
               "mend the log");
  core::Blob out;
  out.label = b.label;
  out.id = b.id < 0 ? core::kNoId : b.id;
  out.bearing = frame.bearing(b.bearing, -b.elevation);
  out.bearingStd = b.bearingStd;
  if (b.range)
  {
    const Vector3 stds(b.rangeStd, b.bearingStd, b.elevationStd);
    const auto seen = frame.point({*b.range, b.bearing, -b.elevation},
                                  stds.cwiseAbs2().asDiagonal().toDenseMatrix());
    out.range = seen.range, out.rangeStd = seen.rangeStd;
    out.bearing = seen.bearing, out.bearingStd = seen.bearingStd;
  }
  const bool inFront = !b.range || (*b.range > 0 && *out.range > 0);
  if (inFront && inView(fov, b.range.value_or(fov.rangeMin), math::wrapToPi(b.bearing)))
    step.blobs->blobs.push_back(out);
  else
    ++step.dropped;
}

void addBlobs(core::Step& step, const CObservationColorBlobs& o, const Entry& entry)
{
  const core::FieldOfView fov{o.rangeMin, o.rangeMax, o.bearingMin, o.bearingMax};
  if (!std::isfinite(fov.rangeMin + fov.rangeMax + fov.bearingMin + fov.bearingMax) ||
      !isPose(o.sensorPoseOnRobot))
    entry.fail("the blob sensor's pose or field of view makes no sense", "mend the log");
  const SensorFrame frame(o.sensorPoseOnRobot);
  const core::FieldOfView view = frame.view(fov);
  if (step.blobs)
    step.blobs->fov = join(step.blobs->fov, view);
  else
    step.blobs.emplace().fov = view;
  for (const auto& b : o.blobs) addBlob(step, b, frame, fov, entry);
}

}  // namespace

std::shared_ptr<const core::LaserScan> laserScanOf(const CObservation2DRangeScan& o,
                                                   const Entry& entry)
{
  if (!isPose(o.sensorPose) || !std::isfinite(o.aperture) || !(o.maxRange > 0))
    entry.fail("the laser's pose, aperture or largest range makes no sense", "mend the log");
  const std::size_t n = o.getScanSize();
  auto scan = std::make_shared<core::LaserScan>();
  const bool upsideDown = o.sensorPose.getRotationMatrix()(2, 2) < 0;
  scan->pose_robot_sensor = {o.sensorPose.x(), o.sensorPose.y(), o.sensorPose.yaw()};
  scan->angleMin = -0.5 * std::abs(o.aperture);
  scan->angleStep = n > 1 ? std::abs(o.aperture) / static_cast<double>(n - 1) : 0;
  scan->rangeMax = o.maxRange;
  scan->ranges.resize(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    const float range = o.getScanRange(i);
    const bool valid = o.getScanRangeValidity(i);
    if (valid && std::isnan(range)) entry.fail("a laser range is not a number", "mend the log");
    scan->ranges[i] = valid && range > 0 ? range : std::numeric_limits<float>::infinity();
  }
  const bool leftToRight = (o.aperture >= 0) != o.rightToLeft;
  if (leftToRight != upsideDown) std::reverse(scan->ranges.begin(), scan->ranges.end());
  return scan;
}

bool addObservation(core::Step& step, const ::mrpt::obs::CObservation& observation,
                    const Entry& entry, const RawlogSource::SensorDeviations& otherwise)
{
  if (const auto* o = dynamic_cast<const CObservationBearingRange*>(&observation))
    addLandmarks(step, *o, entry, otherwise);
  else if (const auto* b = dynamic_cast<const CObservationColorBlobs*>(&observation))
    addBlobs(step, *b, entry);
  else if (const auto* s = dynamic_cast<const CObservation2DRangeScan*>(&observation))
    step.lasers.push_back(laserScanOf(*s, entry));
  else
    return false;
  return true;
}
}  // namespace slamot::mrpt
