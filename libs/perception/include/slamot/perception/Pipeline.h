#pragma once

#include <slamot/perception/Camera.h>
#include <slamot/perception/LandmarkDetector.h>
#include <slamot/perception/OdometryTrack.h>
#include <slamot/perception/ranging.h>

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace slamot::perception
{
/// Where a camera is on the robot, in axes x ahead, y left, z up: point_robot = rotation point +
/// place.
struct Mount
{
  Matrix3 rotation = Matrix3::Identity();  ///< from the camera's axes to the robot's
  Vector3 place = Vector3::Zero();         ///< [m]
};

/// A blob as a sighting of the camera's.
struct SeenBlob
{
  ImageBlob image;              ///< the patch
  SeenDirection seen;           ///< from the camera's axis
  std::optional<double> range;  ///< along the line of sight [m]; none: not ranged
  double rangeStd = 0;          ///< [m]
};

/// What one image showed.
struct Look
{
  double time = 0;              ///< [s]
  Mount mount;                  ///< where the camera was on the robot
  Camera camera;                ///< scaled to the image's size
  std::vector<SeenBlob> blobs;  ///< largest first within each colour
};

/// From images and scans to sightings, in the order of their times.  Images are looked through at
/// once and ranged once the scans before and after them are known; landmarks come last, when it is
/// known what the cameras saw move.
class Pipeline
{
 public:
  /// What it met so far.
  struct Counts
  {
    std::size_t images = 0;     ///< looked through
    std::size_t blobs = 0;      ///< in these images
    std::size_t cut = 0;        ///< blobs that touch an image's edge
    std::size_t ranged = 0;     ///< blobs that got a range; one kept twice counts twice
    std::size_t ambiguous = 0;  ///< that could be of several things in a scan
    std::size_t unreached = 0;  ///< that no thing in a scan is in the direction of
    std::size_t scans = 0;      ///< looked through for landmarks
    std::size_t landmarks = 0;  ///< found in these
    std::size_t moving = 0;     ///< clusters left out, since blobs were of them
  };

  /// Sections [detect], [laser], [blobs], [ranging], [color.LABEL] and those of landmark
  /// detectors. \throws core::Error (kConfig).
  explicit Pipeline(core::Config& config);

  /// Whether images, or scans, are of any use.
  [[nodiscard]] bool wantsImages() const { return !colors_.empty(); }
  /// Whether landmarks are looked for in scans at all.
  [[nodiscard]] bool wantsLandmarks() const { return !detectors_.empty(); }
  /// Those that `colors` of [detect] names.
  [[nodiscard]] const std::vector<ColorClass>& colors() const { return colors_; }
  /// Of images without a calibration of their own; of width 0 if the config has none.
  [[nodiscard]] const Camera& defaultCamera() const { return camera_; }
  /// Scans and images farther apart than this have nothing to do with each other [s].
  [[nodiscard]] double mostApart() const { return mostApart_; }
  /// Blobs farther away are not ranged [m].
  [[nodiscard]] double blobRange() const { return blobRange_; }
  /// The farthest that any of the landmark detectors looks [m].
  [[nodiscard]] double landmarkRange() const;

  /// To be told where the wheels say the robot was, ahead of scans and images of that time.
  OdometryTrack& odometry() { return odometry_; }
  /// A scan to range blobs by, at a time [s]; to be looked through by landmarks() later.
  void addScan(double time, std::shared_ptr<const core::LaserScan> scan);
  /// \param sensor which camera: each has a memory of the light.
  Look look(double time, const std::string& sensor, const cv::Mat& image, const Camera& camera,
            const Mount& mount);
  /// Ranges a look's blobs; an ambiguous one may become several.
  void range(Look& look);
  /// In the robot's frame, of a scan that was added.
  std::vector<DetectedLandmark> landmarks(double time, const core::LaserScan& scan);
  /// Drops what nothing from this time [s] on needs.
  void forgetBefore(double time);

  /// Since the beginning.
  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  struct TimedScan
  {
    double time;
    std::shared_ptr<const core::LaserScan> scan;
    std::vector<Cluster> clusters;
  };
  struct Mover
  {
    double time;
    Point2D at;  // in odometry's axes
    double radius;
  };
  [[nodiscard]] std::vector<RangedObject> objectsOf(const Look& look, const SeenBlob& blob) const;
  void rangeOne(const Look& look, const SeenBlob& blob, std::vector<SeenBlob>& out);
  [[nodiscard]] bool isMoving(double time, const Cluster& cluster) const;

  double mostApart_, blobRange_, hold_;
  LaserOptions laser_;
  BlobNoise noise_;
  RangingOptions ranging_;
  Camera camera_;
  std::vector<ColorClass> colors_;
  std::vector<std::unique_ptr<LandmarkDetector>> detectors_;
  std::map<std::string, ColorDetector> eyes_;
  OdometryTrack odometry_;
  std::deque<TimedScan> scans_;
  std::deque<Mover> movers_;
  Counts counts_;
};
}  // namespace slamot::perception
