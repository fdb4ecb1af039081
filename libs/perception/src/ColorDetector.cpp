#include <slamot/math/geometry.h>
#include <slamot/perception/ColorDetector.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace slamot::perception
{
namespace
{
constexpr double kHueUnit = 360.0 / 256;  // [deg]
std::uint8_t byteOf(double part)
{
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(part, 0.0, 1.0)));
}
double wrapDegrees(double d)
{
  return math::radToDeg(math::wrapToPi(math::degToRad(d)));
}

/// What pixels of one label add up to.
struct Extent
{
  double area = 0, u = 0, v = 0;
  int left = 1 << 30, top = 1 << 30, right = -1, bottom = -1;

  void add(int column, int row)
  {
    area += 1;
    u += column;
    v += row;
    left = std::min(left, column);
    right = std::max(right, column);
    top = std::min(top, row);
    bottom = std::max(bottom, row);
  }
  [[nodiscard]] ImageBlob toBlob(std::size_t colorClass, const cv::Size& image) const
  {
    ImageBlob out;
    out.colorClass = colorClass;
    out.center = {u / area, v / area};
    out.box = {left, top, right - left + 1, bottom - top + 1};
    out.area = area;
    out.cut = left == 0 || top == 0 || right == image.width - 1 || bottom == image.height - 1;
    return out;
  }
};

/// The pieces of a mask, those nearer than `gap` to each other as one, largest first.
std::vector<ImageBlob> blobsOf(const cv::Mat& mask, std::size_t colorClass, int gap)
{
  cv::Mat grown, labels;
  cv::dilate(mask, grown, cv::Mat::ones(gap + 1, gap + 1, CV_8U));
  const int n = cv::connectedComponents(grown, labels, 8, CV_32S);
  std::vector<Extent> extents(static_cast<std::size_t>(n));
  for (int v = 0; v < mask.rows; ++v)
  {
    const auto* in = mask.ptr<std::uint8_t>(v);
    const auto* label = labels.ptr<int>(v);
    for (int u = 0; u < mask.cols; ++u)
      if (in[u] != 0) extents[static_cast<std::size_t>(label[u])].add(u, v);
  }
  std::vector<ImageBlob> out;
  for (const Extent& e : extents)
    if (e.area > 0) out.push_back(e.toBlob(colorClass, mask.size()));
  std::stable_sort(out.begin(), out.end(),
                   [](const ImageBlob& a, const ImageBlob& b) { return a.area > b.area; });
  return out;
}
}  // namespace

cv::Mat asBgr(const cv::Mat& image)
{
  if (image.empty()) return {};
  cv::Mat bytes = image, out;
  if (image.depth() == CV_16U)
    image.convertTo(bytes, CV_8U, 1.0 / 257);
  else if (image.depth() != CV_8U)
    return {};
  if (bytes.channels() == 3) return bytes;
  if (bytes.channels() != 1 && bytes.channels() != 4) return {};
  cv::cvtColor(bytes, out, bytes.channels() == 1 ? cv::COLOR_GRAY2BGR : cv::COLOR_BGRA2BGR);
  return out;
}

cv::Mat asHsv(const cv::Mat& bgr)
{
  cv::Mat hsv;
  cv::cvtColor(bgr, hsv, cv::COLOR_BGR2HSV_FULL);
  return hsv;
}

cv::Mat maskOf(const cv::Mat& hsv, const HsvRange& range)
{
  const double low = std::fmod(range.hueMin, 360) / kHueUnit, high = range.hueMax / kHueUnit;
  const auto between = [&](double from, double to)
  {
    cv::Mat mask;
    cv::inRange(
        hsv, cv::Scalar(std::ceil(from), byteOf(range.saturationMin), byteOf(range.valueMin)),
        cv::Scalar(std::floor(to), byteOf(range.saturationMax), byteOf(range.valueMax)), mask);
    return mask;
  };
  if (range.hueMin <= range.hueMax) return between(range.hueMin / kHueUnit, high);
  return between(low, 255) | between(0, high);
}

ColorDetector::ColorDetector(std::vector<ColorClass> classes)
    : classes_(std::move(classes)), lights_(classes_.size())
{
}

HsvRange ColorDetector::rangeNow(std::size_t colorClass) const
{
  const Light& light = lights_[colorClass];
  HsvRange out = classes_[colorClass].range;
  if (out.hueMax - out.hueMin < 360 && light.hueShift != 0)
  {
    const auto shifted = [&](double h) { return std::fmod(h + light.hueShift + 360, 360); };
    out.hueMin = shifted(out.hueMin);
    out.hueMax = shifted(out.hueMax);
  }
  // What has no bound gets none by dimmer light.
  const auto scaled = [](double bound, double factor)
  { return bound >= 1 ? 1 : std::min(1.0, bound * factor); };
  out.saturationMin = scaled(out.saturationMin, light.saturationFactor);
  out.saturationMax = scaled(out.saturationMax, light.saturationFactor);
  out.valueMin = scaled(out.valueMin, light.valueFactor);
  out.valueMax = scaled(out.valueMax, light.valueFactor);
  return out;
}

std::vector<ImageBlob> ColorDetector::detect(const cv::Mat& image)
{
  std::vector<ImageBlob> out;
  const cv::Mat bgr = asBgr(image);
  if (bgr.empty()) return out;
  const cv::Mat hsv = asHsv(bgr);
  for (std::size_t c = 0; c < classes_.size(); ++c)
  {
    const ColorClass& wanted = classes_[c];
    const cv::Mat mask = maskOf(hsv, rangeNow(c));
    const auto blobs = blobsOf(mask, c, wanted.joinGap);
    const double most = wanted.mostOfImage * static_cast<double>(mask.total());
    const std::size_t before = out.size();
    std::copy_if(blobs.begin(), blobs.end(), std::back_inserter(out),
                 [&](const ImageBlob& b)
                 {
                   return b.area >= wanted.leastArea && b.area <= most &&
                          b.area >= wanted.leastFill * b.box.area();
                 });
    if (wanted.light.rate > 0 && out.size() > before) follow(c, hsv, mask, out[before]);
  }
  return out;
}

// A patch's first look is what it is compared with: the range says which colours may be it, not
// which is its own.
void ColorDetector::follow(std::size_t colorClass, const cv::Mat& hsv, const cv::Mat& mask,
                           const ImageBlob& largest)
{
  double sine = 0, cosine = 0, saturation = 0, value = 0;
  for (int v = largest.box.y; v < largest.box.br().y; ++v)
  {
    const auto* pixel = hsv.ptr<cv::Vec3b>(v);
    const auto* in = mask.ptr<std::uint8_t>(v);
    for (int u = largest.box.x; u < largest.box.br().x; ++u)
    {
      if (in[u] == 0) continue;
      const double h = math::degToRad(pixel[u][0] * kHueUnit);
      sine += std::sin(h);
      cosine += std::cos(h);
      saturation += pixel[u][1];
      value += pixel[u][2];
    }
  }
  const double n = std::max(1.0, largest.area);
  const Look now{math::radToDeg(std::atan2(sine, cosine)), std::max(1.0, saturation / n),
                 std::max(1.0, value / n)};
  Light& light = lights_[colorClass];
  if (!light.known)
  {
    light.known = true;
    light.first = now;
    return;
  }
  const LightTracking& to = classes_[colorClass].light;
  const auto step = [&](double& state, double seen, double least, double most)
  { state = std::clamp(state + to.rate * (seen - state), least, most); };
  step(light.hueShift, wrapDegrees(now.hue - light.first.hue), -to.mostHueShift, to.mostHueShift);
  step(light.saturationFactor, now.saturation / light.first.saturation, 1 / to.mostFactor,
       to.mostFactor);
  step(light.valueFactor, now.value / light.first.value, 1 / to.mostFactor, to.mostFactor);
}
}  // namespace slamot::perception
