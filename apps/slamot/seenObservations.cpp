#include "seenObservations.h"

#include <mrpt/obs/CObservationBearingRange.h>
#include <slamot/mrpt/CObservationColorBlobs.h>

#include <cmath>

namespace slamot::apps
{
namespace
{
using ::mrpt::obs::CObservationBearingRange;
using ::mrpt::poses::CPose3D;
using obs::CObservationColorBlobs;
using perception::Camera;

void include(CObservationColorBlobs& out, const Camera::Direction& d)
{
  out.bearingMin = std::min(out.bearingMin, d.bearing);
  out.bearingMax = std::max(out.bearingMax, d.bearing);
  out.elevationMin = std::min(out.elevationMin, d.elevation);
  out.elevationMax = std::max(out.elevationMax, d.elevation);
}

/// The hull of what the image's border sees, and of what was seen.
void setView(CObservationColorBlobs& out, const perception::Look& look, double rangeMax)
{
  const Camera& camera = look.camera;
  const double right = camera.width - 1, bottom = camera.height - 1;
  out.rangeMin = 0;
  out.rangeMax = rangeMax;
  out.bearingMin = out.elevationMin = math::kPi;
  out.bearingMax = out.elevationMax = -math::kPi;
  for (const double part : {0.0, 0.5, 1.0})
    for (const cv::Point2d& p : {cv::Point2d(0, part * bottom), cv::Point2d(right, part * bottom),
                                 cv::Point2d(part * right, 0), cv::Point2d(part * right, bottom)})
      include(out, camera.direction(p));
  for (const perception::SeenBlob& blob : look.blobs) include(out, blob.seen.at);
}

CPose3D poseOf(const perception::Mount& mount)
{
  CPose3D out;
  ::mrpt::math::CMatrixDouble33 r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r(i, j) = mount.rotation(i, j);
  out.setRotationMatrix(r);
  out.x(mount.place[0]);
  out.y(mount.place[1]);
  out.z(mount.place[2]);
  return out;
}

CObservationColorBlobs::Blob blobOf(const perception::SeenBlob& seen,
                                    const perception::ColorClass& color)
{
  CObservationColorBlobs::Blob out;
  out.label = color.label;
  out.id = color.id;
  out.centerX = seen.image.center.x, out.centerY = seen.image.center.y;
  out.boxLeft = seen.image.box.x, out.boxTop = seen.image.box.y;
  out.boxWidth = seen.image.box.width, out.boxHeight = seen.image.box.height;
  out.area = seen.image.area;
  out.bearing = seen.seen.at.bearing, out.bearingStd = seen.seen.bearingStd;
  out.elevation = seen.seen.at.elevation, out.elevationStd = seen.seen.elevationStd;
  out.range = seen.range, out.rangeStd = seen.rangeStd;
  out.cut = seen.image.cut;
  return out;
}

/// A point of the robot's frame as the laser measures it.
CObservationBearingRange::TMeasurement measurementOf(const Gaussian<Point2D>& at,
                                                     const Pose2D& laser)
{
  const Pose2D seen = math::between(laser, {at.mean.x, at.mean.y, 0});
  const double range = std::hypot(seen.x, seen.y), bearing = std::atan2(seen.y, seen.x);
  const double direction = laser.phi + bearing;
  Matrix2 J;  // of range and bearing, by the point
  J << std::cos(direction), std::sin(direction), -std::sin(direction) / range,
      std::cos(direction) / range;
  const Matrix2 cov = J * at.cov * J.transpose();
  CObservationBearingRange::TMeasurement out;
  out.range = static_cast<float>(range);
  out.yaw = static_cast<float>(bearing);
  out.pitch = 0;
  out.landmarkID = -1;
  out.covariance.setZero();
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) out.covariance(i, j) = cov(i, j);
  out.covariance(2, 2) = cov(1, 1);
  return out;
}
}  // namespace

std::shared_ptr<::mrpt::obs::CObservation> blobsObservation(const perception::Look& look,
                                                            const ::mrpt::obs::CObservation& image,
                                                            const perception::Pipeline& pipeline)
{
  auto out = std::make_shared<CObservationColorBlobs>();
  out->timestamp = image.timestamp;
  out->sensorLabel = image.sensorLabel + "_BLOBS";
  out->sensorPoseOnRobot = poseOf(look.mount);
  setView(*out, look, pipeline.blobRange());
  for (const perception::SeenBlob& blob : look.blobs)
    out->blobs.push_back(blobOf(blob, pipeline.colors()[blob.image.colorClass]));
  return out;
}

std::shared_ptr<::mrpt::obs::CObservation> landmarksObservation(
    const std::vector<perception::DetectedLandmark>& landmarks, const core::LaserScan& scan,
    const ::mrpt::obs::CObservation& source, const perception::Pipeline& pipeline)
{
  auto out = std::make_shared<CObservationBearingRange>();
  out->timestamp = source.timestamp;
  out->sensorLabel = source.sensorLabel + "_LANDMARKS";
  const Pose2D& laser = scan.pose_robot_sensor;
  out->sensorLocationOnRobot = CPose3D(laser.x, laser.y, 0, laser.phi, 0, 0);
  out->minSensorDistance = 0;
  out->maxSensorDistance = static_cast<float>(pipeline.landmarkRange());
  out->fieldOfView_yaw =
      static_cast<float>(std::abs(scan.angleStep) * static_cast<double>(scan.ranges.size()));
  out->validCovariances = true;
  for (const perception::DetectedLandmark& l : landmarks)
    out->sensedData.push_back(measurementOf(l.at, laser));
  return out;
}
}  // namespace slamot::apps
