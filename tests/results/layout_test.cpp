#include "../../libs/results/src/layout.h"

#include <gtest/gtest.h>

namespace slamot::results
{
namespace
{
Plot plotOf(std::vector<double> x, std::vector<double> y)
{
  Plot plot;
  plot.series = {{Series::Kind::kLine, "a", Ink::kBlue, std::move(x), std::move(y), {}, {}}};
  return plot;
}

TEST(Layout, MapsHaveOneScaleAndShowAll)
{
  for (const auto& [lx, ly] : {std::pair{10.0, 10.0}, {300.0, 2.0}, {2.0, 300.0}, {0.0, 0.0}})
  {
    Plot plot = plotOf({5, 5 + lx}, {-3, -3 + ly});
    plot.equalAxes = true;
    const PanelLayout p = layOut(Figure{{plot}}).panels.at(0);
    const double perX = (p.right - p.left) / (p.x.max - p.x.min);
    const double perY = (p.bottom - p.top) / (p.y.max - p.y.min);
    EXPECT_NEAR(perX / perY, 1, 1e-9) << lx << " x " << ly;
    EXPECT_LE(p.x.min, 5);
    EXPECT_GE(p.x.max, 5 + lx);
    EXPECT_LE(p.y.min, -3);
    EXPECT_GE(p.y.max, -3 + ly);
  }
}

TEST(Layout, PanelsShareTheFirstOnesX)
{
  const Layout layout = layOut(Figure{{plotOf({0, 8}, {0, 1}), plotOf({2, 3}, {5, 6})}});
  EXPECT_EQ(layout.panels[1].x.min, 0);
  EXPECT_EQ(layout.panels[1].x.max, 8);
  EXPECT_GT(layout.panels[1].top, layout.panels[0].bottom);
  EXPECT_GT(layout.height, layout.panels[1].bottom);
  EXPECT_FALSE(layout.panels[0].showXAxis);
  EXPECT_TRUE(layout.panels[1].showXAxis);
}

TEST(Layout, LogarithmicAxisLeavesOutWhatItCannotShow)
{
  Plot plot = plotOf({1, 2, 3}, {0, 0.01, 100});
  plot.logY = true;
  const Range y = layOut(Figure{{plot}}).panels.at(0).y;
  EXPECT_GT(y.min, 0.001);
  EXPECT_LE(y.min, 0.01);
  EXPECT_GE(y.max, 100);
}
}  // namespace
}  // namespace slamot::results
