#pragma once

#include <slamot/math/random.h>
#include <slamot/perception/ColorDetector.h>

#include <opencv2/imgproc.hpp>

// Images whose objects are known because they were drawn.
namespace slamot::perception::test
{
/// BGR of a colour in HSV: hue [deg], saturation and value [0 to 1].
inline cv::Scalar color(double hue, double saturation, double value)
{
  cv::Mat hsv(1, 1, CV_32FC3, cv::Scalar(hue, saturation, value)), bgr;
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
  const auto p = bgr.at<cv::Vec3f>(0, 0);
  return 255 * cv::Scalar(p[0], p[1], p[2]);
}

inline cv::Mat background(int columns = 640, int rows = 480)
{
  cv::Mat out(rows, columns, CV_8UC3);
  for (int v = 0; v < rows; ++v)  // grey floor and a bluish wall, darker to one side
    for (int u = 0; u < columns; ++u)
    {
      const auto g = static_cast<std::uint8_t>(90 + 60 * u / columns);
      out.at<cv::Vec3b>(v, u) = v < rows / 2 ? cv::Vec3b(g, static_cast<std::uint8_t>(g - 15),
                                                         static_cast<std::uint8_t>(g - 30))
                                             : cv::Vec3b(g, g, g);
    }
  return out;
}

/// A disc with sub-pixel centre; pixels on the rim are mixed as they are covered.
inline void drawDisc(cv::Mat& image, const cv::Point2d& at, double radius, const cv::Scalar& color)
{
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u)
    {
      const double part = std::clamp(radius + 0.5 - std::hypot(u - at.x, v - at.y), 0.0, 1.0);
      if (part == 0) continue;
      auto& pixel = image.at<cv::Vec3b>(v, u);
      for (int c = 0; c < 3; ++c)
        pixel[c] = cv::saturate_cast<std::uint8_t>((1 - part) * pixel[c] + part * color[c]);
    }
}

inline void addNoise(cv::Mat& image, double std, std::uint64_t seed)
{
  cv::RNG random(seed);
  cv::Mat noise(image.size(), CV_16SC3), sum;
  random.fill(noise, cv::RNG::NORMAL, 0, std);
  image.convertTo(sum, CV_16SC3);
  cv::Mat(sum + noise).convertTo(image, CV_8UC3);
}

inline ColorClass orange()
{
  ColorClass out;
  out.label = "target";
  out.range = {10, 40, 0.5, 1, 0.3, 1};
  return out;
}
inline ColorClass red()
{
  ColorClass out;
  out.label = "robot";
  out.range = {345, 8, 0.5, 1, 0.3, 1};
  return out;
}
}  // namespace slamot::perception::test
