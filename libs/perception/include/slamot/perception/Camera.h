#pragma once

#include <slamot/core/Params.h>
#include <slamot/perception/ColorDetector.h>

#include <array>

namespace slamot::perception
{
/// A pinhole camera with lens distortion, in OpenCV's terms; its axes: z ahead, x right, y down.
struct Camera
{
  /// How the lens distorts, and what the numbers of `distortion` are.
  enum class Lens
  {
    kRadialTangential,  ///< k1 k2 p1 p2 k3 k4 k5 k6 ("plumb bob", rational)
    kFisheye            ///< k1 k2 k3 k4 (Kannala and Brandt)
  };
  int width = 0;                        ///< of images that the numbers below are of [pixel]
  int height = 0;                       ///< [pixel]
  double fx = 0;                        ///< focal length [pixel]
  double fy = 0;                        ///< focal length [pixel]
  double cx = 0;                        ///< principal point, from the first pixel's middle [pixel]
  double cy = 0;                        ///< [pixel]
  Lens lens = Lens::kRadialTangential;  ///< which of these
  std::array<double, 8> distortion{};   ///< in the order of Lens; zeros: none

  /// The same camera for images of another size.
  [[nodiscard]] Camera scaledTo(int columns, int rows) const;
  /// Whether it can be a camera: finite, focal lengths positive.
  [[nodiscard]] bool makesSense() const;

  /// Where a pixel's ray goes: bearing positive to the left, elevation positive upwards [rad].
  struct Direction
  {
    double bearing = 0;    ///< [rad], positive to the left
    double elevation = 0;  ///< [rad], positive upwards
  };
  /// The direction of a pixel, its distortion undone.
  [[nodiscard]] Direction direction(const cv::Point2d& pixel) const;
  /// The pixel of a direction less than a right angle off the axis.
  [[nodiscard]] cv::Point2d pixel(const Direction& d) const;
};

/// Where the middle of a thing is, seen as a blob; what its deviation comes from.
struct BlobNoise
{
  double edge = 0.5;         ///< of each pixel of the blob's rim [pixel]
  double calibration = 0.5;  ///< of the camera's numbers, everywhere [pixel]
  double shape = 0.05;       ///< colour against thing, as light falls: part of the blob's width
  double cut = 0.25;         ///< of what the image's edge cuts: part of its width

  /// Keys edge_px, calibration_px, shape_part, cut_part.
  static BlobNoise from(core::Params& p);

  /// Standard deviation of a blob's centre along one axis [pixel].  A disc of area A has a rim of
  /// 2 sqrt(pi A) pixels; the mean of their errors moves the centroid by edge / (pi A)^(1/4).
  [[nodiscard]] double std(double area, double extent, bool isCut) const;
};

/// A direction with its standard deviations [rad], from the blob's centre and the camera.
struct SeenDirection
{
  Camera::Direction at;     ///< from the camera's axis
  double bearingStd = 0;    ///< [rad]
  double elevationStd = 0;  ///< [rad]
};
/// Where a blob's centre is seen, and how surely.
[[nodiscard]] SeenDirection directionOf(const ImageBlob& blob, const Camera& camera,
                                        const BlobNoise& noise);
}  // namespace slamot::perception
