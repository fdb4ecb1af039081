#include "LinearSighting.h"
#include "sighting/Sighting.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

// What near sightings are taken in a frame along their ray for, and that it fits where it begins.
namespace slamot::filters
{
namespace
{
using models::RangeBearing;

const Eye kOrigin{Pose2D{0, 0, 0}};
const Matrix2 kPrior = 0.09 * (Matrix2() << 1, 0.3, 0.3, 0.5).finished();

Innovation innovation(const Ray& ray, const Vector2& m, const Matrix2& P)
{
  Innovation o{};
  EXPECT_TRUE(innovate(kOrigin, ray, m[0], m[1], P(0, 0), P(0, 1), P(1, 1), o));
  return o;
}

struct Posterior
{
  Vector2 mean;
  Matrix2 cov;
  double density;  ///< of the sighting
};

/// Bayes' rule for N(m, P) and a sighting from the origin, summed up over a fine grid.
Posterior byBayes(const Vector2& m, const Matrix2& P, const Vector2& z, const Vector2& std)
{
  constexpr int n = 60;
  constexpr double step = 6.0 / n;  // in deviations
  const Matrix2 information = P.inverse();
  double sum = 0;
  Vector2 first = Vector2::Zero();
  Matrix2 second = Matrix2::Zero();
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
    {
      const Vector2 error = step * Vector2(i, j), polar = z + std.cwiseProduct(error);
      if (polar[0] <= 0) continue;
      const RangeBearing::Z at(polar);
      const Point2D p = RangeBearing::invert({}, at);
      const Vector2 d(p.x - m[0], p.y - m[1]);
      // The area that a grid's cell covers grows with the range.
      const double w = polar[0] * std::exp(-0.5 * (error.squaredNorm() + d.dot(information * d)));
      sum += w;
      first += w * d;
      second += w * d * d.transpose();
    }
  first /= sum;
  const double scale = step * step / (math::kTwoPi * math::kTwoPi * std::sqrt(P.determinant()));
  return {m + first, second / sum - first * first.transpose(), scale * sum};
}

/// How far an update is from the exact one.
struct Misfit
{
  double mean = 0;     ///< in exact deviations
  double cov = 0;      ///< log of the worst ratio of variances
  double density = 0;  ///< of logs

  void include(const Misfit& o)
  {
    mean = std::max(mean, o.mean);
    cov = std::max(cov, o.cov);
    density = std::max(density, o.density);
  }
};

Misfit misfit(const Posterior& exact, const Vector2& mean, const Matrix2& cov, double logDensity)
{
  const Vector2 d = mean - exact.mean;
  const Matrix2 inverse = exact.cov.inverse(), ratio = inverse * cov;
  const double half = ratio.trace() / 2;  // of the variances' ratios, the eigenvalues
  const double apart = std::sqrt(std::max(0.0, half * half - ratio.determinant()));
  const double worst = std::max(std::abs(std::log(half + apart)), std::abs(std::log(half - apart)));
  return {std::sqrt(d.dot(inverse * d)), worst, std::abs(logDensity - std::log(exact.density))};
}

Misfit ofFilter(const Posterior& exact, const Vector2& m, const Vector2& z, const Vector2& std)
{
  const Innovation o = innovation(Ray::of(z[0], z[1], std[0], std[1]), m, kPrior);
  maps::Landmark l{m[0], m[1], kPrior(0, 0), kPrior(0, 1), kPrior(1, 1), 1, 0};
  correct(l, o);
  return misfit(exact, {l.x, l.y}, l.cov(),
                -0.5 * (o.d2 + std::log(o.det)) - std::log(math::kTwoPi));
}

Misfit inPolar(const Posterior& exact, const Vector2& m, const Vector2& z, const Vector2& std)
{
  const auto l = test::inPolar({}, {m[0], m[1]}, z, {std[0], std[1]});
  const Matrix2 S = l.S(kPrior), K = kPrior * l.byPoint.transpose() * S.inverse();
  return misfit(
      exact, m + K * l.nu, kPrior - K * l.byPoint * kPrior,
      -0.5 * (l.nu.dot(S.inverse() * l.nu) + std::log(S.determinant())) - std::log(math::kTwoPi));
}
}  // namespace

// Points that are 1.5 to 5 deviations away, and truly up to 1.5 of them off.
TEST(NearSighting, IsWeighedAndTakenInMuchAsByBayesRule)
{
  const Vector2 std(0.1, 0.02);
  const Matrix2 root = Eigen::LLT<Matrix2>(kPrior).matrixL();
  for (const double distance : {1.5, 2.5, 5.0})
  {
    SCOPED_TRACE(distance);
    Misfit filter, polar;
    for (double a = 0; a < 6; a += 1)
      for (const double u : {-1.5, 0.0, 1.5})
        for (const double v : {-1.5, 0.0, 1.5})
        {
          const Vector2 m =
              distance * std::sqrt(kPrior.trace()) * Vector2(std::cos(a), std::sin(a));
          const Vector2 truth = m + root * Vector2(u, v);
          const Vector2 z = RangeBearing::predict({}, {truth[0], truth[1]});
          if (z[0] < 2 * std[0]) continue;
          const Posterior exact = byBayes(m, kPrior, z, std);
          filter.include(ofFilter(exact, m, z, std));
          polar.include(inPolar(exact, m, z, std));
        }
    EXPECT_LT(filter.mean, 0.5);
    EXPECT_LT(filter.cov, 0.5);
    EXPECT_LT(filter.density, 0.2);
    // What would be without.
    EXPECT_GT(polar.mean, 5 * filter.mean);
    EXPECT_GT(polar.cov, 5 * filter.cov);
    EXPECT_GT(polar.density, 5 * filter.density);
  }
}

// Over all the points that would be seen so, the innovation has the variances that R says: across
// too, and where the range is all noise.
TEST(NearSighting, HasTheNoiseOfItsRangeAndBearing)
{
  constexpr double rangeStd = 0.1, bearingStd = 0.02;
  for (const double range : {1e-6, 0.03, 0.1, 0.3})
  {
    const Ray ray = Ray::of(range, 0.7, rangeStd, bearingStd);
    Matrix2 second = Matrix2::Zero();
    double sum = 0;
    for (double u = -4.75; u < 5; u += 0.25)
      for (double v = -4.75; v < 5; v += 0.25)
      {
        const double r = range + u * rangeStd, b = 0.7 + v * bearingStd;
        const Innovation o =
            innovation(ray, {r * std::cos(b), r * std::sin(b)}, 1e-16 * Matrix2::Identity());
        const double w = std::exp(-0.5 * (u * u + v * v));
        sum += w;
        second += w * Vector2(o.nuR, o.nuB) * Vector2(o.nuR, o.nuB).transpose();
      }
    second /= sum;
    const Innovation o = innovation(ray, {range, 0}, 1e-16 * Matrix2::Identity());
    EXPECT_NEAR(second(0, 0) / o.s11, 1, 1e-3);
    EXPECT_NEAR(second(1, 1) / o.s22, 1, 1e-3);
    EXPECT_NEAR(second(0, 1) / std::sqrt(o.s11 * o.s22), 0, 1e-3);
  }
}

// At the switch both are the same to first order in the innovation, but for the 1/128 that range
// noise of an eighth of the range makes of its mean square.
TEST(NearSighting, FitsPolarCoordinatesWhereItBegins)
{
  constexpr double rangeStd = 0.1, phi = 0.4;
  const double r = 8 * std::sqrt(kPrior.trace() + rangeStd * rangeStd);
  const Vector2 m = r * Vector2(std::cos(phi), std::sin(phi));
  for (double off = -0.25; off < 0.3; off += 0.05)
    for (double longer = -0.3; longer < 0.4; longer += 0.1)
    {
      const Ray ray = Ray::of(r + longer, phi + off, rangeStd, 0.02);
      const Innovation far = innovation(ray, m, (1 - 1e-9) * kPrior);
      const Innovation near = innovation(ray, m, (1 + 1e-9) * kPrior);
      ASSERT_TRUE(far.turnB == -1 && near.turnB != -1);
      const double turn = std::abs(off), scale = r / std::hypot(r + longer, rangeStd);
      const double stretch = std::abs(1 - scale), rounding = 1e-12;
      EXPECT_LE(std::abs(near.nuR - far.nuR), 0.5 * r * turn * turn + rounding);
      EXPECT_LE(std::abs(near.nuB - far.nuB),
                turn * stretch + scale * std::pow(turn, 3) / 6 + rounding);
      const Vector2 first(near.h11 - far.h11, near.h12 - far.h12);
      const Vector2 second(near.h21 - far.h21, near.h22 - far.h22);
      EXPECT_LE(first.norm(), turn + rounding);
      EXPECT_LE(r * second.norm(), scale * turn + stretch + rounding);
      EXPECT_LE(std::abs(near.turnR), r * turn + rounding);
      EXPECT_LE(std::abs(near.turnB - far.turnB), stretch + scale * turn * turn / 2 + rounding);
    }
}
}  // namespace slamot::filters
