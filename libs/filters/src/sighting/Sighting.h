#pragma once

#include <slamot/core/Step.h>
#include <slamot/maps/LandmarkMap.h>
#include <slamot/models/NoiseLaw.h>
#include <slamot/models/RangeBearing.h>

#include <cmath>

// The inner loop of the particle filter: one pose, one sighting, one point with covariance. Written
// out by hand, since here every nanosecond counts N particles times; tests hold it together with
// RangeBearing and with the same by matrices.
namespace slamot::filters
{
/// A sighting, prepared once for all particles.
struct Ray
{
  double range = 0, cosB = 1, sinB = 0, bearing = 0;
  double varRange = 1, varBearing = 1;
  bool hasRange = true;
  const models::NoiseLaw* law = nullptr;  ///< of its errors, by these variances; null: normal
  double reach = 1;  ///< by how much farther off than a normal one, squared, it may be of a thing

  static Ray of(double range, double bearing, double rangeStd, double bearingStd)
  {
    return {range,   std::cos(bearing),   std::sin(bearing),
            bearing, rangeStd * rangeStd, bearingStd * bearingStd,
            true};
  }
  static Ray ofBearing(double bearing, double bearingStd)
  {
    return {0, std::cos(bearing), std::sin(bearing), bearing, 1.0, bearingStd * bearingStd, false};
  }
};

/// A pose with the sine and cosine of its heading.
struct Eye
{
  double x, y, phi, c, s;
  explicit Eye(const Pose2D& p) : x(p.x), y(p.y), phi(p.phi), c(std::cos(p.phi)), s(std::sin(p.phi))
  {
  }
};

/// Innovation of one sighting of one point: nu (range [m], bearing [rad]), S = H P Hᵀ + R, where H
/// is the derivative by the point of what is expected; by the pose it is (-H, turn).
struct Innovation
{
  double nuR, nuB;
  double s11, s12, s22, det;
  double h11, h12, h21, h22;
  double turnR, turnB;
  double d2;  ///< nuᵀ S⁻¹ nu + excess
  // Of a sighting that may glint, see soften():
  double excess = 0;
  double factor = 1;                 ///< that stands for the law: of the sighting's variances
  double e11 = 0, e12 = 0, e22 = 0;  ///< covariance of S⁻¹ nu over the law's Gaussians

  /// nuᵀ S⁻¹ nu.
  [[nodiscard]] double form() const
  {
    return (s22 * nuR * nuR - 2 * s12 * nuR * nuB + s11 * nuB * nuB) / det;
  }
};

/// atan2 for a point near the positive x axis, where a sighting's own point lies.
inline double smallAngle(double y, double x)
{
  if (x > 0 && std::abs(y) < 0.1 * x)
  {
    const double t = y / x, q = t * t;  // the series' next term is below 1e-13
    return t * (1 - q * (1.0 / 3 - q * (0.2 - q * (1.0 / 7 - q * (1.0 / 9 - q / 11)))));
  }
  return std::atan2(y, x);
}

/// Whether a sighting is so far from a point, in metres, that no frame's bend can bring it within
/// `gate` (of d2): most candidates are, and this takes no root, division or angle.  Chords are
/// shorter than arcs, variances add up to more than the largest eigenvalue, and where ranges differ
/// by half the answer is no.
inline bool isBeyond(double gate, const Eye& eye, const Ray& z, double mx, double my, double pxx,
                     double pyy, const Matrix3* poseCov)
{
  const double dx = mx - eye.x, dy = my - eye.y, q = dx * dx + dy * dy, r2 = z.range * z.range;
  if (!z.hasRange || 4 * q < r2) return false;
  const double c = eye.c * z.cosB - eye.s * z.sinB, s = eye.s * z.cosB + eye.c * z.sinB;
  const double ex = dx - z.range * c, ey = dy - z.range * s;
  double place = pxx + pyy, turn = z.varBearing;
  if (poseCov)
  {
    place += (*poseCov)(0, 0) + (*poseCov)(1, 1);
    turn += (*poseCov)(2, 2);
  }
  return ex * ex + ey * ey > 2 * gate * z.reach * (z.varRange + 2 * place + (q + r2) * turn);
}

// Within eight deviations (squared here) of the point and the range, polar coordinates bend too
// much: a filter linearised in them turns over-confident.  A frame on the sighting's ray is linear
// in the point there; farther away it would not do, since it bends where a heading is uncertain.
constexpr double kNear = 64;

/// In polar coordinates, or near by in a frame on the sighting's ray.  False where the bearing has
/// no derivative: below 1 cm, and not near in the sense above (so always for a bearing alone).
/// `noise` multiplies the sighting's variances.
inline bool innovate(const Eye& eye, const Ray& z, double mx, double my, double pxx, double pxy,
                     double pyy, Innovation& o, double noise = 1)
{
  const double dx = mx - eye.x, dy = my - eye.y, q = dx * dx + dy * dy;
  const double c = eye.c * z.cosB - eye.s * z.sinB, s = eye.s * z.cosB + eye.c * z.sinB;
  // The point in that frame: its direction there is minus the bearing's innovation, wrapped.
  const double along = c * dx + s * dy, across = c * dy - s * dx;
  if (z.hasRange && q < kNear * (pxx + pyy + z.varRange))
  {
    // The true range's second moment is range^2 + varRange.  Metres across divided by its root have
    // the bearing's variance, also where the range is mostly noise.
    const double ir = 1 / std::sqrt(z.range * z.range + z.varRange);
    o.nuR = z.range - along;
    o.nuB = -across * ir;
    o.h11 = c;
    o.h12 = s;
    o.h21 = -s * ir;
    o.h22 = c * ir;
    o.turnR = across;
    o.turnB = -along * ir;
  }
  else
  {
    constexpr double kMin = models::RangeBearing::kSmallestRange;
    if (!(q >= kMin * kMin)) return false;
    const double r = std::sqrt(q), ir = 1 / r, iq = ir * ir;
    const double ranged = z.hasRange ? ir : 0;  // without, the first row is inert
    o.nuR = z.hasRange ? z.range - r : 0;
    o.nuB = -smallAngle(across, along);
    o.h11 = dx * ranged;
    o.h12 = dy * ranged;
    o.h21 = -dy * iq;
    o.h22 = dx * iq;
    o.turnR = 0;
    o.turnB = -1;
  }
  const double a1 = pxx * o.h11 + pxy * o.h12, a2 = pxy * o.h11 + pyy * o.h12;
  const double b1 = pxx * o.h21 + pxy * o.h22, b2 = pxy * o.h21 + pyy * o.h22;
  // A row without a range keeps its variance of 1, so that S's determinant is that of the bearing.
  o.s11 = o.h11 * a1 + o.h12 * a2 + (z.hasRange ? noise : 1) * z.varRange;
  o.s12 = o.h21 * a1 + o.h22 * a2;
  o.s22 = o.h21 * b1 + o.h22 * b2 + noise * z.varBearing;
  o.det = o.s11 * o.s22 - o.s12 * o.s12;
  o.d2 = o.form();
  o.excess = o.e11 = o.e12 = o.e22 = 0;
  o.factor = 1;
  return true;
}

/// The innovation, but for d2, at a pose off the one it was taken at by a small (x, y, heading).
inline Innovation shifted(const Innovation& o, const Vector3& d)
{
  Innovation out = o;
  out.nuR += o.h11 * d[0] + o.h12 * d[1] - o.turnR * d[2];
  out.nuB += o.h21 * d[0] + o.h22 * d[1] - o.turnB * d[2];
  return out;
}

/// The innovation with the pose's own covariance added to S.
inline Innovation withPose(const Innovation& o, const Matrix3& poseCov)
{
  Eigen::Matrix<double, 2, 3> J;  // of what is expected, by the pose
  J << -o.h11, -o.h12, o.turnR, -o.h21, -o.h22, o.turnB;
  const Matrix2 add = J * poseCov * J.transpose();
  Innovation out = o;
  out.s11 += add(0, 0);
  out.s12 += add(0, 1);
  out.s22 += add(1, 1);
  out.det = out.s11 * out.s22 - out.s12 * out.s12;
  out.d2 = out.form() + out.excess;
  return out;
}

/// Kalman update of a landmark by an innovation computed from it.
inline void correct(maps::Landmark& m, const Innovation& o)
{
  const double a1 = m.cxx * o.h11 + m.cxy * o.h12, a2 = m.cxy * o.h11 + m.cyy * o.h12;
  const double b1 = m.cxx * o.h21 + m.cxy * o.h22, b2 = m.cxy * o.h21 + m.cyy * o.h22;
  const double id = 1 / o.det, i11 = o.s22 * id, i12 = -o.s12 * id, i22 = o.s11 * id;
  const double k11 = a1 * i11 + b1 * i12, k12 = a1 * i12 + b1 * i22;
  const double k21 = a2 * i11 + b2 * i12, k22 = a2 * i12 + b2 * i22;
  m.x += k11 * o.nuR + k12 * o.nuB;
  m.y += k21 * o.nuR + k22 * o.nuB;
  // K S Kᵀ = K (P Hᵀ)ᵀ: the difference stays symmetric by construction, and positive since S > R.
  m.cxx -= k11 * a1 + k12 * b1;
  m.cxy -= k11 * a2 + k12 * b2;
  m.cyy -= k21 * a2 + k22 * b2;
  if (o.e11 + o.e22 > 0)  // that the law's Gaussians disagree is doubt too
  {
    const double c1 = a1 * o.e11 + b1 * o.e12, d1 = a1 * o.e12 + b1 * o.e22;
    const double c2 = a2 * o.e11 + b2 * o.e12, d2 = a2 * o.e12 + b2 * o.e22;
    m.cxx += c1 * a1 + d1 * b1;
    m.cxy += c1 * a2 + d1 * b2;
    m.cyy += c2 * a2 + d2 * b2;
  }
  ++m.sightings;
}

/// Whether a sighting glints, nothing tells where it is all there is.
inline double noiseAlone(const Ray& z)
{
  return z.law ? z.law->meanFactor() : 1;
}

/// The place that a sighting alone gives, with covariance from its noise.
inline Gaussian<Point2D> invert(const Eye& eye, const Ray& z)
{
  const double c = eye.c * z.cosB - eye.s * z.sinB, s = eye.s * z.cosB + eye.c * z.sinB;
  Gaussian<Point2D> out;
  out.mean = {eye.x + z.range * c, eye.y + z.range * s};
  const double across = z.range * z.range * z.varBearing;
  out.cov(0, 0) = c * c * z.varRange + s * s * across;
  out.cov(1, 1) = s * s * z.varRange + c * c * across;
  out.cov(0, 1) = out.cov(1, 0) = c * s * (z.varRange - across);
  if (z.law) out.cov *= noiseAlone(z);
  return out;
}

/// Largest eigenvalue of a symmetric 2x2 matrix.
inline double largestEigenvalue(double xx, double xy, double yy)
{
  const double mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy);
  return mean + std::sqrt(half * half + xy * xy);
}

/// log of a product of many factors with one logarithm at the end: mantissa and exponent apart.
class LogProduct
{
 public:
  void times(double factor)
  {
    mantissa_ *= factor;
    if (mantissa_ < 1e-200 || mantissa_ > 1e200)
    {
      int e = 0;
      mantissa_ = std::frexp(mantissa_, &e);
      exponent_ += e;
    }
  }
  [[nodiscard]] double log() const
  {
    return std::log(mantissa_) + exponent_ * 0.69314718055994530942;
  }

 private:
  double mantissa_ = 1;
  long exponent_ = 0;
};
}  // namespace slamot::filters
