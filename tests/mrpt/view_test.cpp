#include "../../libs/mrpt/src/view.h"

#include <gtest/gtest.h>
#include <slamot/math/geometry.h>

#include <algorithm>

namespace slamot::mrpt
{
namespace
{
TEST(View, FromAboveIsAMap)
{
  CameraView view;
  view.x = 3, view.y = -1, view.span = 8, view.elevation = math::kPi / 2;
  const ScreenPoint middle = project(view, 1.5, 3, -1), corner = project(view, 1.5, 9, 3);
  EXPECT_NEAR(middle.x, 0, 1e-12);
  EXPECT_NEAR(middle.y, 0, 1e-12);
  EXPECT_NEAR(corner.x, 1, 1e-12);
  EXPECT_NEAR(corner.y, 1, 1e-12);
}

TEST(View, PerspectiveEqualsAPinholeCamera)
{
  CameraView view;
  view.span = 10, view.elevation = 0.8, view.opening = 0.5;
  const double d = view.distance(), x = 2, y = -3;
  const double eyeY = -d * std::cos(0.8), eyeZ = d * std::sin(0.8);
  const double depth = (y - eyeY) * std::cos(0.8) + eyeZ * std::sin(0.8);
  const double up = (y - eyeY) * std::sin(0.8) - eyeZ * std::cos(0.8);
  const ScreenPoint p = project(view, 1.25, x, y);
  EXPECT_NEAR(p.x, x / depth / std::tan(0.25) / 1.25, 1e-12);
  EXPECT_NEAR(p.y, up / depth / std::tan(0.25), 1e-12);
}

TEST(View, FittedShowsAllAndAsLargeAsMayBe)
{
  for (const double elevation : {90.0, 55.0, 30.0})
    for (const double aspect : {0.6, 4.0 / 3, 2.5})
      for (const Box& box : {Box{-5, 5, -5, 5}, Box{100, 400, -2, 0}, Box{0, 1, -80, 90}})
      {
        CameraView view;
        view.elevation = math::degToRad(elevation);
        view.opening = elevation < 90 ? math::degToRad(30) : 0;
        view = fitted(view, aspect, box);
        double left = 2, right = -2, bottom = 2, top = -2;
        for (const double x : {box.xMin, box.xMax})
          for (const double y : {box.yMin, box.yMax})
          {
            const ScreenPoint p = project(view, aspect, x, y);
            left = std::min(left, p.x), right = std::max(right, p.x);
            bottom = std::min(bottom, p.y), top = std::max(top, p.y);
          }
        const double freeRight = 1 - 2 * kLegendPart, freeTop = 1 - 2 * kTitlePart;
        EXPECT_GE(left, -1);
        EXPECT_GE(bottom, -1);
        EXPECT_LE(right, freeRight);
        EXPECT_LE(top, freeTop);
        EXPECT_TRUE(right - left > 0.9 * (freeRight + 1) || top - bottom > 0.9 * (freeTop + 1))
            << elevation << " deg, aspect " << aspect;
      }
}
}  // namespace
}  // namespace slamot::mrpt
