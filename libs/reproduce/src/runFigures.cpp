#include "runFigures.h"

#include <slamot/team/teamReport.h>

namespace slamot::reproduce
{
namespace
{
using results::Figure;

constexpr int kMapWidth = 680;  // [px]: as high as wide, a map would else fill a page

/// Where the scans lie by the estimate, and by odometry.
std::vector<TitledFigure> scanFigures(const results::RunView& run)
{
  std::vector<TitledFigure> out;
  if (auto f = results::scanFigure(run, eval::PosesOf::kFilter))
    out.push_back({"by the estimated path", *f});
  if (auto f = results::scanFigure(run, eval::PosesOf::kOdometry))
    out.push_back({"by odometry alone", *f});
  return out;
}

std::optional<Figure> figureOf(Picture::Kind kind, const results::RunView& run)
{
  switch (kind)
  {
    case Picture::Kind::kMap:
      return results::mapFigure(run);
    case Picture::Kind::kRobotErrors:
      return results::robotErrorFigure(run);
    case Picture::Kind::kNees:
      return results::neesFigure(run);
    case Picture::Kind::kTargetErrors:
    case Picture::Kind::kScans:
      break;
  }
  const auto groups = results::targetGroups(run.record, run.evaluation);
  if (groups.empty()) return std::nullopt;
  return results::targetErrorFigure(run, groups.front(), results::inkOf(0));
}

std::optional<Figure> figureOf(Picture::Kind kind, const team::TeamView& team)
{
  switch (kind)
  {
    case Picture::Kind::kMap:
      return team::teamMapFigure(team);
    case Picture::Kind::kRobotErrors:
      return team::robotErrorsFigure(team);
    case Picture::Kind::kTargetErrors:
      return team::targetErrorsFigure(team);
    case Picture::Kind::kNees:
      return team::teamNeesFigure(team);
    case Picture::Kind::kScans:
      break;
  }
  return std::nullopt;
}

}  // namespace

std::vector<TitledFigure> runFigures(Picture::Kind kind, const study::Trial& trial,
                                     const study::FinishedTrial& done)
{
  std::vector<team::RobotResult> robots;
  for (std::size_t r = 0; r < done.records.size(); ++r)
    robots.push_back(
        {"robot " + std::to_string(r), {done.records[r], *done.truths[r], done.evaluations[r]}});
  if (!trial.team && kind == Picture::Kind::kScans) return scanFigures(robots[0].view);
  const auto figure = trial.team ? figureOf(kind, team::viewOf(*trial.team, robots))
                                 : figureOf(kind, robots[0].view);
  if (!figure) return {};
  TitledFigure out{"", *figure};
  if (kind == Picture::Kind::kMap) out.figure.width = kMapWidth;
  return {out};
}
}  // namespace slamot::reproduce
