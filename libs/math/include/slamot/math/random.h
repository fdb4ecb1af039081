#pragma once

#include <slamot/math/geometry.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>

namespace slamot::math
{
/// A stream of random numbers fixed by a list of keys, such as (seed, run, step, particle).
/// Streams of different keys are independent, so the order in which threads draw cannot change a
/// result.  SplitMix64: Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014.
/// Meets UniformRandomBitGenerator.
class RandomStream
{
 public:
  using result_type = std::uint64_t;  ///< of UniformRandomBitGenerator: 64 random bits

  /// The stream of these keys; their order counts.
  RandomStream(std::initializer_list<std::uint64_t> keys)
  {
    for (const std::uint64_t key : keys) state_ = mix(state_ ^ mix(key + kStep));
  }

  static constexpr result_type min() { return 0; }                ///< of UniformRandomBitGenerator
  static constexpr result_type max() { return ~result_type{0}; }  ///< of UniformRandomBitGenerator
  result_type operator()() { return mix(state_ += kStep); }       ///< the next 64 bits

  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>((*this)() >> 11) * 0x1.0p-53; }
  /// Uniform in [lo, hi).
  double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }

  /// Standard normal deviate, by Marsaglia's polar method.
  double normal()
  {
    if (hasSpare_)
    {
      hasSpare_ = false;
      return spare_;
    }
    double u, v, s;
    do
    {
      u = 2.0 * uniform() - 1.0;
      v = 2.0 * uniform() - 1.0;
      s = u * u + v * v;
    } while (s >= 1.0 || s == 0.0);
    const double f = std::sqrt(-2.0 * std::log(s) / s);
    spare_ = v * f;
    hasSpare_ = true;
    return u * f;
  }
  /// Three independent standard normal deviates.
  Vector3 normal3()
  {
    const double a = normal(), b = normal();
    return {a, b, normal()};
  }

  /// Poisson count of the given mean (at most some hundreds).
  int poisson(double mean)
  {
    const double limit = std::exp(-mean);
    int n = 0;
    for (double p = uniform(); p > limit; p *= uniform()) ++n;
    return n;
  }

 private:
  static constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15ull;
  static constexpr std::uint64_t mix(std::uint64_t z)
  {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }

  std::uint64_t state_ = 0;
  double spare_ = 0;
  bool hasSpare_ = false;
};
}  // namespace slamot::math
