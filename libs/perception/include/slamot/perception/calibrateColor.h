#pragma once

#include <slamot/perception/ColorClass.h>

#include <opencv2/core.hpp>

#include <vector>

namespace slamot::perception
{
/// A range proposed for an object, and how well it tells it from the rest of the image.
struct ColorProposal
{
  HsvRange range;    ///< that tells it best
  double found = 0;  ///< part of the object's pixels that lie in the range [0 to 1]
  double stray = 0;  ///< part of the range's pixels that lie outside the box [0 to 1]
};

/// The range of one interval of hues, and least saturation and value, that best tells what is
/// inside the box (its inscribed ellipse: corners are seldom the object's) from what is outside:
/// the largest ratio of object's pixels found to those found anywhere or missed. \throws
/// std::invalid_argument: an empty image, or a box that is not wholly inside with a rest of the
/// image around it.
[[nodiscard]] ColorProposal proposeColor(const cv::Mat& image, const cv::Rect& box);
}  // namespace slamot::perception
