#include "../../libs/results/src/thin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace slamot::results
{
namespace
{
using Kind = Series::Kind;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Distance [px] of a point from a chain of line segments.
double distanceToChain(double px, double py, const Series& s, const PixelScale& scale)
{
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < s.x.size(); ++i)
  {
    const double ax = scale.x(s.x[i]), ay = scale.y(s.y[i]);
    const double dx = scale.x(s.x[i + 1]) - ax, dy = scale.y(s.y[i + 1]) - ay;
    const double length2 = dx * dx + dy * dy;
    const double t =
        length2 > 0 ? std::clamp(((px - ax) * dx + (py - ay) * dy) / length2, 0.0, 1.0) : 0.0;
    best = std::min(best, std::hypot(px - ax - t * dx, py - ay - t * dy));
  }
  return best;
}

TEST(Thinned, PathStaysWithinAThirdOfAPixel)
{
  PixelScale scale;
  scale.perX = scale.perY = 80;
  Series path{Kind::kLine, "", Ink::kBlue, {}, {}, {}, {}};
  for (int i = 0; i < 3000; ++i)
  {
    path.x.push_back(4 * std::cos(0.005 * i));
    path.y.push_back(3 * std::sin(0.011 * i));
  }
  const Series thin = thinned(path, scale);
  EXPECT_LT(thin.x.size(), 600u);
  for (std::size_t i = 0; i < path.x.size(); ++i)
    ASSERT_LE(distanceToChain(scale.x(path.x[i]), scale.y(path.y[i]), thin, scale), 0.34) << i;
}

TEST(Thinned, GapsStay)
{
  Series line{Kind::kLine, "", Ink::kBlue, {0, 1, 2, 2, 3, 4, 5}, {0, 0, 0, kNaN, 0, 0, 0}, {}, {}};
  const Series thin = thinned(line, PixelScale{});
  EXPECT_EQ(thin.x, (std::vector<double>{0, 2, 2, 3, 5}));
  EXPECT_EQ(std::count_if(thin.y.begin(), thin.y.end(), [](double v) { return std::isnan(v); }), 1);
}

TEST(Thinned, DenseCurveKeepsItsExtremes)
{
  PixelScale scale;
  scale.perX = 0.008, scale.perY = 50;
  Series noise{Kind::kLine, "", Ink::kBlue, {}, {}, {}, {}};
  for (int i = 0; i < 100000; ++i) noise.x.push_back(i), noise.y.push_back(std::sin(1.7 * i));
  noise.y[50123] = 9, noise.y[70001] = -9;
  const Series thin = thinned(noise, scale);
  EXPECT_LT(thin.x.size(), 8000u);
  EXPECT_EQ(*std::max_element(thin.y.begin(), thin.y.end()), 9);
  EXPECT_EQ(*std::min_element(thin.y.begin(), thin.y.end()), -9);
  EXPECT_TRUE(std::is_sorted(thin.x.begin(), thin.x.end()));
}

TEST(Thinned, BandKeepsItsWidest)
{
  PixelScale scale;
  scale.perX = 0.008;
  Series band{Kind::kBand, "", Ink::kMuted, {}, {}, {}, {}};
  for (int i = 0; i < 100000; ++i)
    band.x.push_back(i), band.low.push_back(i == 777 ? -5 : -1), band.high.push_back(1);
  const Series thin = thinned(band, scale);
  EXPECT_LT(thin.x.size(), 8000u);
  EXPECT_EQ(thin.x.size(), thin.low.size());
  EXPECT_EQ(*std::min_element(thin.low.begin(), thin.low.end()), -5);
}

TEST(Thinned, MarksInOnePixelAreDrawnOnce)
{
  Series marks{Kind::kTicks, "", Ink::kBlue, {1, 1.01, 1.02, 5}, {}, {}, {}};
  EXPECT_EQ(thinned(marks, PixelScale{}).x, (std::vector<double>{1, 5}));
}
}  // namespace
}  // namespace slamot::results
