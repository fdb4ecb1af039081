#include <slamot/results/Figures.h>

namespace slamot::results
{
namespace
{
constexpr int kWidth = 360;                // [px]
constexpr std::size_t kMostDrawn = 20000;  // more are one blot, and a large page

}  // namespace

std::optional<Figure> scanFigure(const RunView& run, eval::PosesOf poses)
{
  if (!run.evaluation.scanMap || run.evaluation.scanMap->points == 0) return std::nullopt;
  Plot plot;
  plot.equalAxes = true;
  plot.xLabel = "x [m]", plot.yLabel = "y [m]";
  const auto points = eval::scanPoints(run.record, poses);
  if (points.empty()) return std::nullopt;
  const std::size_t stride = (points.size() + kMostDrawn - 1) / kMostDrawn;
  Series cloud{Series::Kind::kPoints, "", Ink::kText, {}, {}, {}, {}};
  for (std::size_t i = 0; i < points.size(); i += stride)
  {
    cloud.x.push_back(points[i].x);
    cloud.y.push_back(points[i].y);
  }
  plot.series.push_back(std::move(cloud));
  return Figure{{plot}, kWidth};
}
}  // namespace slamot::results
