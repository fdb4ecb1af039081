#include "Surroundings.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace slamot::sim
{
namespace
{
using Color = std::array<double, 3>;  // blue, green, red, 0 to 1

constexpr int kOversampling = 2;   // columns for one: smooth upright edges
constexpr double kAmbient = 0.55;  // part of the light that comes from everywhere
constexpr double kNearest = 0.05;  // [m], along the camera's axis

/// Smith, "Color gamut transform pairs", 1978.
Color fromHsv(double hue, double saturation, double value)
{
  const auto channel = [&](double n)
  {
    const double k = std::fmod(n + hue / 60, 6);
    return value * (1 - saturation * std::max(0.0, std::min({k, 4 - k, 1.0})));
  };
  return {channel(1), channel(3), channel(5)};
}

/// One column of the image, from the top.
class Column
{
 public:
  Column(const CameraSetup& camera, double light)
      : camera_(camera), light_(light), pixels_(static_cast<std::size_t>(camera.height))
  {
  }

  /// Floor below the horizon, and what is far above it.
  void clear()
  {
    for (int v = 0; v < camera_.height; ++v)
    {
      const double below = v - middle();
      const double shade =
          below < 0 ? 0.62 : 0.35 + 0.15 * std::min(1.0, 2 * below / camera_.height);
      at(v) = {light_ * (below < 0 ? shade + 0.06 : shade), light_ * shade, light_ * shade};
    }
  }
  /// A thing that stands on the floor, `depth` ahead.
  void stand(double depth, const Surroundings::Hit& hit)
  {
    const auto row = [&](double z) { return middle() + camera_.focal * (camera_.z - z) / depth; };
    const double top = row(hit.height), foot = row(0);
    const double shade = light_ * (kAmbient + (1 - kAmbient) * hit.facing);
    const Color color = fromHsv(hit.look->hue, hit.look->saturation, hit.look->value * shade);
    const double lowest = camera_.height - 1;
    const int first = static_cast<int>(std::clamp(std::floor(top + 0.5), 0.0, lowest + 1));
    const int last = static_cast<int>(std::clamp(std::ceil(foot + 0.5), -1.0, lowest));
    for (int v = first; v <= last; ++v)
    {
      // A pixel reaches half a row up and down.
      const double part = std::min(v + 0.5, foot) - std::max(v - 0.5, top);
      if (part <= 0) continue;
      for (std::size_t c = 0; c < 3; ++c) at(v)[c] += std::min(1.0, part) * (color[c] - at(v)[c]);
    }
  }
  [[nodiscard]] const std::vector<Color>& pixels() const { return pixels_; }

 private:
  [[nodiscard]] double middle() const { return 0.5 * (camera_.height - 1); }
  Color& at(int v) { return pixels_[static_cast<std::size_t>(v)]; }

  const CameraSetup& camera_;
  double light_;
  std::vector<Color> pixels_;
};

/// Bytes of what is drawn, with noise: of a table, as a draw for each byte would take most of the
/// time.
class Film
{
 public:
  Film(double noise, math::RandomStream random) : random_(random)
  {
    for (double& n : table_) n = noise * random_.normal();
  }
  std::uint8_t expose(double part)
  {
    if (left_ == 0) bits_ = random_(), left_ = 5;
    const double n = table_[bits_ & (kSize - 1)];
    bits_ >>= 12, --left_;
    return static_cast<std::uint8_t>(std::lround(std::clamp(255 * part + n, 0.0, 255.0)));
  }

 private:
  static constexpr std::size_t kSize = 4096;
  math::RandomStream random_;
  std::array<double, kSize> table_{};
  std::uint64_t bits_ = 0;
  int left_ = 0;
};
}  // namespace

Picture drawPicture(const Surroundings& world, const Pose2D& robot, const CameraSetup& camera,
                    double time, math::RandomStream random)
{
  const Pose2D eye = math::compose(robot, {camera.x, camera.y, camera.yaw});
  const double light = 1 + camera.lightSwing * std::sin(math::kTwoPi * time / camera.lightPeriod);
  Picture out;
  out.width = camera.width;
  out.height = camera.height;
  out.bgr.resize(static_cast<std::size_t>(3) * static_cast<std::size_t>(out.width * out.height));
  Film film(camera.noise, random);
  Column column(camera, light);
  std::vector<Surroundings::Hit> hits;
  std::vector<Color> sum(static_cast<std::size_t>(camera.height));
  for (int u = 0; u < camera.width; ++u)
  {
    std::fill(sum.begin(), sum.end(), Color{0, 0, 0});
    for (int k = 0; k < kOversampling; ++k)
    {
      const double right = u - 0.5 * (camera.width - 1) + (k + 0.5) / kOversampling - 0.5;
      const double angle = -std::atan(right / camera.focal);
      world.hitsAlong({eye.x, eye.y}, eye.phi + angle, hits);
      column.clear();
      for (const auto& hit : hits)
        if (const double depth = hit.distance * std::cos(angle); depth > kNearest)
          column.stand(depth, hit);
      for (std::size_t v = 0; v < sum.size(); ++v)
        for (std::size_t c = 0; c < 3; ++c) sum[v][c] += column.pixels()[v][c] / kOversampling;
    }
    for (std::size_t v = 0; v < sum.size(); ++v)
      for (std::size_t c = 0; c < 3; ++c)
        out.bgr[3 * (v * static_cast<std::size_t>(out.width) + static_cast<std::size_t>(u)) + c] =
            film.expose(sum[v][c]);
  }
  return out;
}
}  // namespace slamot::sim
