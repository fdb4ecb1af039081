#include "soften.h"

#include <algorithm>
#include <array>
#include <limits>

namespace slamot::filters
{
namespace
{
constexpr std::size_t kMost = 16;  // Gaussians of a law

/// nuᵀ S⁻¹ nu + ln |S| of an innovation with S grown by (f - 1) R.
struct Grown
{
  double s11, s12, s22, det;
  Grown(const Innovation& o, double growR, double growB)
      : s11(o.s11 + growR), s12(o.s12), s22(o.s22 + growB), det(s11 * s22 - s12 * s12)
  {
  }
  [[nodiscard]] double logDensity(double nuR, double nuB) const
  {
    const double d2 = (s22 * nuR * nuR - 2 * s12 * nuR * nuB + s11 * nuB * nuB) / det;
    return -0.5 * (d2 + std::log(det));
  }
};

/// Turns logarithms into shares.  \return the logarithm of their sum.
double share(std::array<double, kMost>& logs, std::size_t n)
{
  const double most = *std::max_element(logs.begin(), logs.begin() + n);
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) sum += logs[k] = std::exp(logs[k] - most);
  for (std::size_t k = 0; k < n; ++k) logs[k] /= sum;
  return most + std::log(sum);
}
}  // namespace

void softenByLaw(const Ray& z, double noise, const Matrix3* poseCov, Innovation& o)
{
  const auto& law = z.law->components();
  const std::size_t n = std::min(law.size(), kMost);
  const double varR = z.hasRange ? noise * z.varRange : 0, varB = noise * z.varBearing;
  const Innovation whole = poseCov ? withPose(o, *poseCov) : o;
  std::array<double, kMost> at{}, shares{};
  for (std::size_t k = 0; k < n; ++k)
  {
    const double more = law[k].factor - 1, w = std::log(law[k].weight);
    at[k] = w + Grown(o, more * varR, more * varB).logDensity(o.nuR, o.nuB);
    shares[k] =
        poseCov ? w + Grown(whole, more * varR, more * varB).logDensity(o.nuR, o.nuB) : at[k];
  }
  const double logDensity = share(at, n);
  share(shares, n);
  double m11 = 0, m12 = 0, m22 = 0, inverse = 0;  // sums of S⁻¹ and 1 / f
  double a = 0, b = 0, aa = 0, ab = 0, bb = 0;    // moments of S⁻¹ nu
  for (std::size_t k = 0; k < n; ++k)
  {
    const double more = law[k].factor - 1;
    const Grown s(o, more * varR, more * varB);
    const double w = shares[k] / s.det, i11 = w * s.s22, i12 = -w * s.s12, i22 = w * s.s11;
    const double x = i11 * o.nuR + i12 * o.nuB, y = i12 * o.nuR + i22 * o.nuB;
    m11 += i11;
    m12 += i12;
    m22 += i22;
    inverse += shares[k] / law[k].factor;
    a += x;
    b += y;
    if (!(shares[k] > 0)) continue;
    aa += x * x / shares[k];
    ab += x * y / shares[k];
    bb += y * y / shares[k];
  }
  const double id = 1 / (m11 * m22 - m12 * m12);
  o.s11 = m22 * id;
  o.s12 = -m12 * id;
  o.s22 = m11 * id;
  o.det = id;
  o.factor = 1 / inverse;
  o.e11 = std::max(0.0, aa - a * a);
  o.e22 = std::max(0.0, bb - b * b);
  o.e12 = ab - a * b;
  o.d2 = -2 * logDensity - std::log(o.det);
  o.excess = o.d2 - o.form();
}

double reachOf(const models::NoiseLaw& law, double gate)
{
  Ray z;
  z.law = &law;
  // Of a thing whose place has `prior` times the sighting's variance, in deviations of both.
  const auto passes = [&](double distance, double prior)
  {
    const double s = 1 + prior, nu = distance * std::sqrt(s);
    Innovation o{nu, 0, s, 0, s, s * s, 1, 0, 0, 1, 0, -1, distance * distance};
    softenByLaw(z, 1, nullptr, o);
    return o.d2 <= gate;
  };
  constexpr double kStep = 1.02;
  double reach = std::sqrt(gate);
  // d2 need not rise everywhere: the last distance that passes counts.
  for (const double prior : {0.0, 0.1, 0.3, 1.0, 2.0, 4.0, 8.0, 16.0})
    for (double d = reach; d < 10 * std::sqrt(gate * law.widest()); d *= kStep)
      if (passes(d, prior)) reach = kStep * d;
  return reach * reach / gate;
}
}  // namespace slamot::filters
