#pragma once

#include "Sighting.h"

// Range and bearing through an unscented transform, in place of their derivatives.
//
// The papers augment the state: pose, control noise and sighting's noise, seven coordinates.  What
// is expected depends on them only through the point's place less the robot's, d, and, exactly
// linearly, through heading and the sighting's noise.  A transform over the two coordinates of d
// gives the same moments to the same order, for five points instead of fifteen.
namespace slamot::filters
{
/// Range and bearing of d, less those of its mean, by the unscented transform: d lies `r0` away,
/// with covariance (along, both; both, across) along the line of sight and across it.  Whatever the
/// map's axes, the sigma points are thus the same.  Julier and Uhlmann 2004, with kurtosis matched
/// (n + kappa = 3).
struct UnscentedPolar
{
  double meanR, meanB;
  double rAlong, bAlong, bAcross;  ///< slopes of the regression on d; the range has none across
  double varR, varB, covRB;        ///< what the regression leaves over

  UnscentedPolar(double r0, double along, double both, double across)
  {
    constexpr double kSpread = 1.7320508075688772, w = 1.0 / 6, half = 0.5 / kSpread;
    const double l11 = std::sqrt(along), l21 = both / l11, l22 = std::sqrt(across - l21 * l21);
    // Bearings are taken relative to the mean of d, so that none of them wraps.
    const auto expected = [&](double ex, double ey, double& r, double& b)
    {
      r = std::sqrt((r0 + ex) * (r0 + ex) + ey * ey) - r0;
      b = smallAngle(ey, r0 + ex);
    };
    double ra, ba, rb, bb, rc, bc;
    expected(kSpread * l11, kSpread * l21, ra, ba);
    expected(-kSpread * l11, -kSpread * l21, rb, bb);
    expected(0, kSpread * l22, rc, bc);  // and its mirror image (rc, -bc)
    meanR = w * (ra + rb + 2 * rc);
    meanB = w * (ba + bb);
    const double gr1 = half * (ra - rb), gb1 = half * (ba - bb), gb2 = 2 * half * bc;
    rAlong = gr1 / l11;  // slopes along the columns; across, the range has none
    bAcross = gb2 / l22;
    bAlong = (gb1 - bAcross * l21) / l11;
    varR = w * (ra * ra + rb * rb + 2 * rc * rc) - meanR * meanR - gr1 * gr1;
    varB = w * (ba * ba + bb * bb + 2 * bc * bc) - meanB * meanB - gb1 * gb1 - gb2 * gb2;
    covRB = w * (ra * ba + rb * bb) - meanR * meanB - gr1 * gb1;
  }
};

/// innovate() by statistical linear regression over d = point - robot, whose covariance is the
/// point's plus the pose's (zero for a sampled pose): H becomes the regression's slope, nu is taken
/// from the transform's mean, and S gains what the regression leaves over.  Where the sigma points
/// would surround the robot, within four deviations, it is innovate().
inline bool innovateUnscented(const Eye& eye, const Ray& z, double mx, double my, double pxx,
                              double pxy, double pyy, const Matrix3* poseCov, Innovation& o,
                              double noise = 1)
{
  constexpr double kSurround = 16, kFlat = 1e-12;
  const double dx = mx - eye.x, dy = my - eye.y, q = dx * dx + dy * dy;
  const double dxx = poseCov ? pxx + (*poseCov)(0, 0) : pxx;
  const double dxy = poseCov ? pxy + (*poseCov)(1, 0) : pxy;
  const double dyy = poseCov ? pyy + (*poseCov)(1, 1) : pyy;
  if (!z.hasRange || q < kSurround * (dxx + dyy + z.varRange) || !(dxx * dyy - dxy * dxy > kFlat))
    return innovate(eye, z, mx, my, pxx, pxy, pyy, o, noise);

  const double r0 = std::sqrt(q), u = dx / r0, v = dy / r0;
  const UnscentedPolar t(r0, u * u * dxx + 2 * u * v * dxy + v * v * dyy,
                         u * v * (dyy - dxx) + (u * u - v * v) * dxy,
                         v * v * dxx - 2 * u * v * dxy + u * u * dyy);
  o.h11 = u * t.rAlong;
  o.h12 = v * t.rAlong;
  o.h21 = u * t.bAlong - v * t.bAcross;
  o.h22 = v * t.bAlong + u * t.bAcross;
  o.turnR = 0;
  o.turnB = -1;
  const double c = eye.c * z.cosB - eye.s * z.sinB, s = eye.s * z.cosB + eye.c * z.sinB;
  o.nuR = z.range - r0 - t.meanR;
  o.nuB = -smallAngle(c * dy - s * dx, c * dx + s * dy) - t.meanB;
  const double a1 = pxx * o.h11 + pxy * o.h12, a2 = pxy * o.h11 + pyy * o.h12;
  const double b1 = pxx * o.h21 + pxy * o.h22, b2 = pxy * o.h21 + pyy * o.h22;
  o.s11 = o.h11 * a1 + o.h12 * a2 + t.varR + noise * z.varRange;
  o.s12 = o.h21 * a1 + o.h22 * a2 + t.covRB;
  o.s22 = o.h21 * b1 + o.h22 * b2 + t.varB + noise * z.varBearing;
  o.det = o.s11 * o.s22 - o.s12 * o.s12;
  o.d2 = o.form();
  o.excess = o.e11 = o.e12 = o.e22 = 0;
  o.factor = 1;
  return true;
}

/// invert() by the unscented transform over range and bearing: the bend of the arc shortens the
/// mean and widens the covariance along the ray.
inline Gaussian<Point2D> invertUnscented(const Eye& eye, const Ray& z)
{
  const double c = eye.c * z.cosB - eye.s * z.sinB, s = eye.s * z.cosB + eye.c * z.sinB;
  const double turn = std::sqrt(3 * z.varBearing);  // of the two sigma points off the ray
  const double drop = (1 - std::cos(turn)) / 3, across = z.range * std::sin(turn);
  const double along = z.range * (1 - drop);
  // Weights: a third at the centre, a sixth for each other point.
  const double varAlong = z.varRange + z.range * z.range * drop * (1 - std::cos(turn) - drop);
  const double varAcross = across * across / 3;
  Gaussian<Point2D> out;
  out.mean = {eye.x + along * c, eye.y + along * s};
  out.cov(0, 0) = c * c * varAlong + s * s * varAcross;
  out.cov(1, 1) = s * s * varAlong + c * c * varAcross;
  out.cov(0, 1) = out.cov(1, 0) = c * s * (varAlong - varAcross);
  if (z.law) out.cov *= noiseAlone(z);
  return out;
}
}  // namespace slamot::filters
