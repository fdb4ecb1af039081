#include <slamot/perception/ColorDetector.h>
#include <slamot/perception/calibrateColor.h>

#include <opencv2/imgproc.hpp>

#include <stdexcept>

namespace slamot::perception
{
namespace
{
constexpr int kHues = 64, kShades = 32;   // bins: of 5.6 degrees, and of 1/32
constexpr int kMostHues = kHues * 2 / 5;  // wider than 144 degrees is no one colour

/// Counts of pixels of at least a saturation and a value, by hues up to a bin (twice around).
class Histogram
{
 public:
  Histogram(const cv::Mat& hsv, const cv::Mat& mask, std::uint8_t wanted)
      : counts_((2 * kHues + 1) * kShades * kShades)
  {
    for (int v = 0; v < hsv.rows; ++v)
    {
      const auto* pixel = hsv.ptr<cv::Vec3b>(v);
      const auto* in = mask.ptr<std::uint8_t>(v);
      for (int u = 0; u < hsv.cols; ++u)
        if (in[u] == wanted)
          for (const int turn : {0, kHues})
            at(1 + turn + pixel[u][0] * kHues / 256, pixel[u][1] * kShades / 256,
               pixel[u][2] * kShades / 256) += 1;
    }
    for (int h = 0; h <= 2 * kHues; ++h)
      for (int s = kShades; s-- > 0;)
        for (int v = kShades; v-- > 0;)
        {
          double& c = at(h, s, v);
          if (s + 1 < kShades) c += at(h, s + 1, v);
          if (v + 1 < kShades) c += at(h, s, v + 1);
          if (s + 1 < kShades && v + 1 < kShades) c -= at(h, s + 1, v + 1);
        }
    for (int h = 1; h <= 2 * kHues; ++h)
      for (int s = 0; s < kShades; ++s)
        for (int v = 0; v < kShades; ++v) at(h, s, v) += at(h - 1, s, v);
  }
  /// Pixels with a hue in [first, first + n), and at least these shades.
  [[nodiscard]] double count(int first, int n, int s, int v) const
  {
    return at(first + n, s, v) - at(first, s, v);
  }

 private:
  [[nodiscard]] static std::size_t index(int h, int s, int v)
  {
    return static_cast<std::size_t>((h * kShades + s) * kShades + v);
  }
  double& at(int h, int s, int v) { return counts_[index(h, s, v)]; }
  [[nodiscard]] double at(int h, int s, int v) const { return counts_[index(h, s, v)]; }

  std::vector<double> counts_;
};

struct Bounds
{
  int first = 0, hues = 1, saturation = 0, value = 0;  // bins
};

struct Search
{
  const Histogram& object;
  const Histogram& outside;
  double objectSize;

  [[nodiscard]] double ratio(const Bounds& b) const
  {
    return object.count(b.first, b.hues, b.saturation, b.value) /
           (objectSize + outside.count(b.first, b.hues, b.saturation, b.value));
  }
  template <class F>
  static void forAll(F&& f)
  {
    for (int first = 0; first < kHues; ++first)
      for (int n = 1; n <= kMostHues; ++n)
        for (int s = 0; s < kShades; ++s)
          for (int v = 0; v < kShades; ++v) f(Bounds{first, n, s, v});
  }
  [[nodiscard]] Bounds best() const
  {
    Bounds out;
    double most = -1;
    forAll(
        [&](const Bounds& b)
        {
          if (const double r = ratio(b); r > most) most = r, out = b;
        });
    return out;
  }
  /// Of all that are nearly as good, the one that takes least of the colour space: other images
  /// have other things around.  Then a little wider, as light changes, where that finds nothing
  /// else.
  [[nodiscard]] Bounds tightened(const Bounds& best) const
  {
    constexpr double kNearly = 0.97, kStillGood = 0.95;
    const double most = ratio(best);
    const auto volume = [](const Bounds& b)
    { return b.hues * (kShades - b.saturation) * (kShades - b.value); };
    Bounds tight = best;
    forAll(
        [&](const Bounds& b)
        {
          if (volume(b) < volume(tight) && ratio(b) >= kNearly * most) tight = b;
        });
    const Bounds wider{(tight.first + kHues - 1) % kHues, std::min(tight.hues + 2, kMostHues),
                       tight.saturation * 17 / 20, tight.value * 14 / 20};
    return ratio(wider) >= kStillGood * most ? wider : tight;
  }
};

constexpr std::uint8_t kOutside = 0, kCorner = 1, kObject = 2;

cv::Mat partsOf(const cv::Size& size, const cv::Rect& box)
{
  cv::Mat parts(size, CV_8U, cv::Scalar(kOutside));
  parts(box).setTo(kCorner);
  cv::ellipse(
      parts,
      cv::RotatedRect(
          cv::Point2f(static_cast<float>(box.x) + 0.5f * static_cast<float>(box.width - 1),
                      static_cast<float>(box.y) + 0.5f * static_cast<float>(box.height - 1)),
          cv::Size2f(static_cast<float>(box.width), static_cast<float>(box.height)), 0),
      cv::Scalar(kObject), cv::FILLED);
  // The filled ellipse may stick out by a pixel.
  cv::Mat inside(size, CV_8U, cv::Scalar(0));
  inside(box).setTo(255);
  parts.setTo(kOutside, inside == 0);
  return parts;
}
}  // namespace

ColorProposal proposeColor(const cv::Mat& image, const cv::Rect& box)
{
  const cv::Mat bgr = asBgr(image);
  if (bgr.empty()) throw std::invalid_argument("the image is empty");
  const cv::Rect whole(cv::Point(0, 0), bgr.size());
  if (box.width < 1 || box.height < 1 || (box & whole) != box || box == whole)
    throw std::invalid_argument("the box is not inside the image of " + std::to_string(bgr.cols) +
                                " x " + std::to_string(bgr.rows) +
                                " pixels, with a rest around it");
  const cv::Mat hsv = asHsv(bgr), parts = partsOf(bgr.size(), box);
  const Histogram object(hsv, parts, kObject), outside(hsv, parts, kOutside);
  const Search search{object, outside, object.count(0, kHues, 0, 0)};
  const Bounds bounds = search.tightened(search.best());

  constexpr double kUnit = 360.0 / kHues;
  const double found = object.count(bounds.first, bounds.hues, bounds.saturation, bounds.value);
  const double stray = outside.count(bounds.first, bounds.hues, bounds.saturation, bounds.value);
  ColorProposal out;
  out.range = {bounds.first * kUnit,
               std::fmod((bounds.first + bounds.hues) * kUnit, 360),
               static_cast<double>(bounds.saturation) / kShades,
               1,
               static_cast<double>(bounds.value) / kShades,
               1};
  out.found = found / search.objectSize;
  out.stray = found + stray > 0 ? stray / (found + stray) : 0;
  return out;
}
}  // namespace slamot::perception
