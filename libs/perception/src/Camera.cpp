#include <slamot/math/geometry.h>
#include <slamot/perception/Camera.h>

#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <cmath>

namespace slamot::perception
{
namespace
{
cv::Matx33d matrixOf(const Camera& c)
{
  return {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1};
}
std::vector<double> distortionOf(const Camera& c)
{
  const auto n = c.lens == Camera::Lens::kFisheye ? 4 : 8;
  return {c.distortion.begin(), c.distortion.begin() + n};
}
bool isFlat(const Camera& c)
{
  return c.lens == Camera::Lens::kRadialTangential &&
         std::all_of(c.distortion.begin(), c.distortion.end(), [](double k) { return k == 0; });
}
}  // namespace

Camera Camera::scaledTo(int columns, int rows) const
{
  Camera out = *this;
  out.width = columns, out.height = rows;
  if (width <= 0 || height <= 0) return out;
  const double sx = static_cast<double>(columns) / width, sy = static_cast<double>(rows) / height;
  // Pixel (0, 0) has its centre at (0, 0).
  out.fx *= sx, out.cx = (out.cx + 0.5) * sx - 0.5;
  out.fy *= sy, out.cy = (out.cy + 0.5) * sy - 0.5;
  return out;
}

bool Camera::makesSense() const
{
  return fx > 0 && fy > 0 && std::isfinite(fx + fy + cx + cy) &&
         std::all_of(distortion.begin(), distortion.end(),
                     [](double k) { return std::isfinite(k) && std::abs(k) < 1e6; });
}

Camera::Direction Camera::direction(const cv::Point2d& pixel) const
{
  cv::Point2d flat((pixel.x - cx) / fx, (pixel.y - cy) / fy);
  if (!isFlat(*this))
  {
    const std::vector<cv::Point2d> in{pixel};
    std::vector<cv::Point2d> out;
    if (lens == Lens::kFisheye)
      cv::fisheye::undistortPoints(in, out, matrixOf(*this), distortionOf(*this));
    else
      cv::undistortPoints(
          in, out, matrixOf(*this), distortionOf(*this), cv::noArray(), cv::noArray(),
          cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 50, 1e-9));
    flat = out.front();
  }
  return {std::atan2(-flat.x, 1), std::atan2(-flat.y, std::hypot(1, flat.x))};
}

cv::Point2d Camera::pixel(const Direction& d) const
{
  const cv::Point3d ray(-std::sin(d.bearing) * std::cos(d.elevation), -std::sin(d.elevation),
                        std::cos(d.bearing) * std::cos(d.elevation));
  if (isFlat(*this)) return {cx + fx * ray.x / ray.z, cy + fy * ray.y / ray.z};
  const std::vector<cv::Point3d> in{ray};
  std::vector<cv::Point2d> out;
  const cv::Vec3d none(0, 0, 0);
  if (lens == Lens::kFisheye)
    cv::fisheye::projectPoints(in, out, none, none, matrixOf(*this), distortionOf(*this));
  else
    cv::projectPoints(in, none, none, matrixOf(*this), distortionOf(*this), out);
  return out.front();
}

BlobNoise BlobNoise::from(core::Params& p)
{
  BlobNoise out;
  out.edge = p.positive("edge_px", out.edge);
  out.calibration = p.nonNegative("calibration_px", out.calibration);
  out.shape = p.nonNegative("shape_part", out.shape);
  out.cut = p.nonNegative("cut_part", out.cut);
  return out;
}

double BlobNoise::std(double area, double extent, bool isCut) const
{
  const double rim = edge / std::pow(math::kPi * std::max(area, 1.0), 0.25);
  const double whole = isCut ? cut * extent : 0;
  return std::sqrt(rim * rim + calibration * calibration + shape * shape * extent * extent +
                   whole * whole);
}

SeenDirection directionOf(const ImageBlob& blob, const Camera& camera, const BlobNoise& noise)
{
  constexpr double kStep = 0.5;  // [pixel]
  SeenDirection out;
  out.at = camera.direction(blob.center);
  const auto slope = [&](double du, double dv)
  {
    const auto a = camera.direction(blob.center - cv::Point2d(du, dv));
    const auto b = camera.direction(blob.center + cv::Point2d(du, dv));
    return Camera::Direction{(b.bearing - a.bearing) / (2 * kStep),
                             (b.elevation - a.elevation) / (2 * kStep)};
  };
  const auto byU = slope(kStep, 0), byV = slope(0, kStep);
  const double u = noise.std(blob.area, blob.box.width, blob.cut);
  const double v = noise.std(blob.area, blob.box.height, blob.cut);
  out.bearingStd = std::hypot(byU.bearing * u, byV.bearing * v);
  out.elevationStd = std::hypot(byU.elevation * u, byV.elevation * v);
  return out;
}
}  // namespace slamot::perception
