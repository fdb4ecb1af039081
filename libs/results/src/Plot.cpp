#include <slamot/results/Plot.h>

#include <slamot/math/statistics.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <limits>

namespace slamot::results
{
namespace
{
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

void endOutline(Series& shapes)
{
  shapes.x.push_back(kNaN);
  shapes.y.push_back(kNaN);
}
}  // namespace

Ink inkOf(std::size_t n)
{
  constexpr std::array<Ink, 5> inks{Ink::kVermillion, Ink::kPurple, Ink::kOrange, Ink::kSky,
                                    Ink::kGreen};
  return inks[n % inks.size()];
}

void appendEllipse(Series& shapes, const Gaussian<Point2D>& g, double probability)
{
  constexpr int kCorners = 36;
  const Eigen::SelfAdjointEigenSolver<Matrix2> eigen(g.cov);
  const double radius = std::sqrt(math::chiSquareQuantile(probability, 2));
  const Vector2 axes = radius * eigen.eigenvalues().cwiseMax(0).cwiseSqrt();
  for (int i = 0; i <= kCorners; ++i)
  {
    const double a = math::kTwoPi * i / kCorners;
    const Vector2 p = eigen.eigenvectors() * Vector2(axes[0] * std::cos(a), axes[1] * std::sin(a));
    shapes.x.push_back(g.mean.x + p[0]);
    shapes.y.push_back(g.mean.y + p[1]);
  }
  endOutline(shapes);
}

void appendArrow(Series& shapes, const Pose2D& pose, double length)
{
  constexpr double kOutline[][2] = {{0.6, 0}, {-0.4, 0.38}, {-0.2, 0}, {-0.4, -0.38}, {0.6, 0}};
  for (const auto& corner : kOutline)
  {
    const Point2D p = math::transform(pose, {length * corner[0], length * corner[1]});
    shapes.x.push_back(p.x);
    shapes.y.push_back(p.y);
  }
  endOutline(shapes);
}
}  // namespace slamot::results
