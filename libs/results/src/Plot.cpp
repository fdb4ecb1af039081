#include <slamot/results/Plot.h>

#include <slamot/math/statistics.h>

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
  const math::Ellipse axes = math::ellipse(g.cov);
  const Pose2D centre(g.mean.x, g.mean.y, axes.direction);
  const double radius = std::sqrt(math::chiSquareQuantile(probability, 2));
  for (int i = 0; i <= kCorners; ++i)
  {
    const double a = math::kTwoPi * i / kCorners;
    const Point2D p = math::transform(
        centre, {radius * axes.longer * std::cos(a), radius * axes.shorter * std::sin(a)});
    shapes.x.push_back(p.x);
    shapes.y.push_back(p.y);
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
