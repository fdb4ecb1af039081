#pragma once

#include <slamot/perception/ColorClass.h>

#include <opencv2/core.hpp>

#include <vector>

namespace slamot::perception
{
/// A patch of a class's colour.  Pixel (0, 0) is at the top left, its centre at (0, 0).
struct ImageBlob
{
  std::size_t colorClass = 0;  ///< index into the detector's classes
  cv::Point2d center;          ///< mean of its pixels [pixel]
  cv::Rect box;                ///< [pixel]
  double area = 0;             ///< pixels of the colour
  bool cut = false;            ///< touches the image's edge: part of the thing may be outside
};

/// Finds blobs of known colours.  With LightTracking it remembers how they last looked, so images
/// are to be given in the order of their times, and each camera has a detector of its own.
class ColorDetector
{
 public:
  /// One detector looks for all classes of a camera.
  explicit ColorDetector(std::vector<ColorClass> classes);

  /// As they were given; ImageBlob::colorClass counts them.
  [[nodiscard]] const std::vector<ColorClass>& classes() const { return classes_; }

  /// Largest first within each class.  Grey images hold no colour, an empty one nothing at all.
  /// \param image 8 or 16 bits a channel; BGR, BGRA or grey.
  std::vector<ImageBlob> detect(const cv::Mat& image);

  /// The range in which a class is looked for at present.
  [[nodiscard]] HsvRange rangeNow(std::size_t colorClass) const;

 private:
  struct Look  // mean of a blob: direction of its hue, saturation, value
  {
    double hue = 0, saturation = 0, value = 0;
  };
  struct Light
  {
    bool known = false;
    Look first;
    double hueShift = 0, saturationFactor = 1, valueFactor = 1;
  };
  void follow(std::size_t colorClass, const cv::Mat& hsv, const cv::Mat& mask,
              const ImageBlob& largest);

  std::vector<ColorClass> classes_;
  std::vector<Light> lights_;
};

/// An image as BGR with 8 bits a channel; empty if there is nothing of it.
[[nodiscard]] cv::Mat asBgr(const cv::Mat& image);
/// Hue, saturation and value of a BGR image, all of 0 to 255, hue 255 being 358.6 degrees.
[[nodiscard]] cv::Mat asHsv(const cv::Mat& bgr);
/// 255 where a pixel of asHsv() lies in the range.
[[nodiscard]] cv::Mat maskOf(const cv::Mat& hsv, const HsvRange& range);
}  // namespace slamot::perception
