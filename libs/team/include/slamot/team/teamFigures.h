#pragma once

#include <slamot/fusion/Member.h>
#include <slamot/results/Figures.h>

namespace slamot::team
{
/// A team's run as figures show it; what it refers to must outlive it.
struct TeamView
{
  /// One robot's run.
  struct Robot
  {
    std::string name;                                ///< for legends
    results::RunView run;                            ///< its record, truth and evaluation
    const std::vector<fusion::FusionEvent>& events;  ///< good messages that it took in
  };
  std::vector<Robot> robots;  ///< in the order of their logs
  int target = 0;             ///< identity of the target that all follow
};

/// The colour of a robot, and of the target as it tracks it; they repeat after the last.
[[nodiscard]] results::Ink inkOfRobot(std::size_t robot);

/// All tracks of the team's target that one robot made; no name if it made none.
[[nodiscard]] results::TargetGroup targetOf(const TeamView::Robot& robot, int target);

/// A handful of a robot's fusions, spread over its run.
[[nodiscard]] std::vector<fusion::FusionEvent> someFusions(const TeamView& team, std::size_t robot);

/// How many times as large as they are the ellipses of someFusions() should be drawn, to be seen on
/// a map of all: 1, 2, 5, 10, ...
[[nodiscard]] double ellipseScale(const TeamView& team);

/// The ellipse of a place, with axes so many times as long.
[[nodiscard]] Gaussian<Point2D> enlarged(const Gaussian<Point2D>& g, double scale);

/// From above, in the map's frame: paths of all robots, the target as each tracks it, true paths,
/// landmarks, and ellipses before and after a few fusions.
[[nodiscard]] results::Figure teamMapFigure(const TeamView& team);

/// Distance from the truth, and errors of heading, of all robots; none without truth.
[[nodiscard]] std::optional<results::Figure> robotErrorsFigure(const TeamView& team);
/// The same of the target as each robot tracks it.
[[nodiscard]] std::optional<results::Figure> targetErrorsFigure(const TeamView& team);

/// How uncertain the places of robots and target are, marked where a message was fused.
[[nodiscard]] results::Figure uncertaintyFigure(const TeamView& team);

/// Normalised squared errors of robots and target with the band of a consistent filter's; none
/// without truth.
[[nodiscard]] std::optional<results::Figure> teamNeesFigure(const TeamView& team);

/// The weights that were given to own estimates; none if nothing was fused.
[[nodiscard]] std::optional<results::Figure> omegaFigure(const TeamView& team);
}  // namespace slamot::team
