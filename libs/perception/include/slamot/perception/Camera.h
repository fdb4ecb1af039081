#pragma once

#include <slamot/core/Params.h>
#include <slamot/perception/ColorDetector.h>

#include <array>

namespace slamot::perception
{
/// A pinhole camera with lens distortion, in OpenCV's terms; its axes: z ahead, x right, y down.
struct Camera
{
  enum class Lens
  {
    kRadialTangential,  ///< k1 k2 p1 p2 k3 k4 k5 k6 ("plumb bob", rational)
    kFisheye            ///< k1 k2 k3 k4 (Kannala and Brandt)
  };
  int width = 0, height = 0;              ///< that the numbers below are of [pixel]
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< [pixel]
  Lens lens = Lens::kRadialTangential;
  std::array<double, 8> distortion{};

  /// The same camera for images of another size.
  [[nodiscard]] Camera scaledTo(int columns, int rows) const;
  /// Whether it can be a camera: finite, focal lengths positive.
  [[nodiscard]] bool makesSense() const;

  /// Where a pixel's ray goes: bearing positive to the left, elevation positive upwards [rad].
  struct Direction
  {
    double bearing = 0, elevation = 0;
  };
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
  Camera::Direction at;
  double bearingStd = 0, elevationStd = 0;
};
[[nodiscard]] SeenDirection directionOf(const ImageBlob& blob, const Camera& camera,
                                        const BlobNoise& noise);
}  // namespace slamot::perception
