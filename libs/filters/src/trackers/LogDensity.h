#pragma once

#include "Cloud.h"
#include "Seen.h"

#include <limits>

namespace slamot::filters::trackers
{
/// Of an observation's error by its law, for many samples.
class LogDensity
{
 public:
  explicit LogDensity(const Seen& z) : z_(z.ray), size_(z.ray.hasRange ? 2 : 1)
  {
    if (!z_.law) return;
    for (const auto& c : z_.law->components())
      parts_.push_back({std::log(c.weight) - 0.5 * size_ * std::log(c.factor), 1 / c.factor});
  }
  /// But for what is the same for all samples.
  [[nodiscard]] double operator()(double nuR, double nuB) const
  {
    const double q = (z_.hasRange ? nuR * nuR / z_.varRange : 0.0) + nuB * nuB / z_.varBearing;
    if (parts_.empty()) return -0.5 * q;
    double most = -std::numeric_limits<double>::infinity(), sum = 0;
    for (const Part& p : parts_) most = std::max(most, p.log - 0.5 * q * p.inverse);
    for (const Part& p : parts_) sum += std::exp(p.log - 0.5 * q * p.inverse - most);
    return most + std::log(sum);
  }

 private:
  struct Part
  {
    double log, inverse;
  };
  Ray z_;
  int size_;
  std::vector<Part> parts_;
};

/// What an observation is off a sample: exact, whatever the range.
[[nodiscard]] inline Vector2 residual(const Eye& eye, const Seen& z, const Sample& s)
{
  const double dx = s.x - eye.x, dy = s.y - eye.y;
  const double c = eye.c * z.ray.cosB - eye.s * z.ray.sinB;
  const double n = eye.s * z.ray.cosB + eye.c * z.ray.sinB;
  const double along = c * dx + n * dy, across = c * dy - n * dx;
  if (z.isPlace) return {z.ray.range - along, -across};
  return {z.ray.range - std::hypot(dx, dy), -std::atan2(across, along)};
}
}  // namespace slamot::filters::trackers
