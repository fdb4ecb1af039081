#include <slamot/team/teamFigures.h>

#include "series.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>

namespace slamot::team
{
namespace
{
using results::Ink;
using results::Plot;
using results::Series;
using Kind = Series::Kind;

constexpr std::size_t kFusionsInAll = 12, kFusionsOfEach = 6;

Series pathOf(const TeamView::Robot& robot, Ink ink)
{
  Series path = series(Kind::kLine, robot.name, ink);
  for (const auto& row : robot.run.record.rows) append(path, row.robot.mean.x, row.robot.mean.y);
  return path;
}

Series targetPathOf(const TeamView::Robot& robot, int target, Ink ink)
{
  Series path = series(Kind::kThin, "", ink);
  for (const std::size_t i : targetOf(robot, target).tracks)
  {
    const auto& rows = robot.run.record.targets[i].rows;
    for (std::size_t k = 0; k < rows.size(); ++k)
    {
      if (k > 0 && rows[k].row != rows[k - 1].row + 1) append(path, kNaN, kNaN);
      append(path, rows[k].pose.mean.x, rows[k].pose.mean.y);
    }
    append(path, kNaN, kNaN);
  }
  return path;
}

/// A true path, in the map's frame.
void appendTruth(Series& s, const eval::Trajectory& truth, const Pose2D& truthFromMap)
{
  const Pose2D mapFromTruth = math::between(truthFromMap, Pose2D{});
  const double gap = eval::EvaluationOptions{}.maxTruthGap;
  for (std::size_t i = 0; i < truth.poses.size(); ++i)
  {
    if (i > 0 && truth.poses[i].time - truth.poses[i - 1].time > gap) append(s, kNaN, kNaN);
    const auto& pose = truth.poses[i].pose;
    const Point2D p = math::transform(mapFromTruth, {pose.x, pose.y});
    append(s, p.x, p.y);
  }
  append(s, kNaN, kNaN);
}

Series truePaths(const TeamView& team)
{
  Series s = series(Kind::kDashes, "true paths", Ink::kText);
  std::set<int> told;
  for (const auto& robot : team.robots)
  {
    const auto& frame = robot.run.evaluation.truthFromMap;
    appendTruth(s, robot.run.truth.robot, frame);
    // It is the same target for all.
    const auto it = robot.run.truth.targets.find(team.target);
    if (it != robot.run.truth.targets.end() && told.insert(team.target).second)
      appendTruth(s, it->second, frame);
  }
  return s;
}

Series landmarks(const TeamView& team)
{
  Series s = series(Kind::kDots, "landmarks of all", Ink::kMuted);
  for (const auto& robot : team.robots)
    for (const auto& l : robot.run.record.landmarks)
      append(s, l.position.mean.x, l.position.mean.y);
  return s;
}

/// Where the team went: the side of a square about it [m].
double extent(const TeamView& team)
{
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
  for (const auto& robot : team.robots)
    for (const auto& row : robot.run.record.rows)
    {
      x0 = std::min(x0, row.robot.mean.x), x1 = std::max(x1, row.robot.mean.x);
      y0 = std::min(y0, row.robot.mean.y), y1 = std::max(y1, row.robot.mean.y);
    }
  return std::max({x1 - x0, y1 - y0, 0.1});
}

std::string times(double scale)
{
  return scale > 1 ? ", " + std::to_string(static_cast<long>(scale)) + ":1" : "";
}

void addEllipses(Plot& plot, const TeamView& team)
{
  const double scale = ellipseScale(team);
  bool named = false;
  for (std::size_t r = 0; r < team.robots.size(); ++r)
  {
    const auto fusions = someFusions(team, r);
    if (fusions.empty()) continue;
    Series before = series(Kind::kThin, named ? "" : "before fusion" + times(scale), inkOfRobot(r));
    Series after = series(Kind::kShape, named ? "" : "after", inkOfRobot(r));
    named = true;
    for (const fusion::FusionEvent& e : fusions)
    {
      appendEllipse(before, enlarged(e.robotBefore, scale));
      appendEllipse(after, enlarged(e.robotAfter, scale));
      if (!e.hasTarget) continue;
      appendEllipse(before, enlarged(e.targetBefore, scale));
      appendEllipse(after, enlarged(e.targetAfter, scale));
    }
    plot.series.push_back(before);
    plot.series.push_back(after);
  }
}

void addArrows(Plot& plot, const TeamView& team)
{
  const double length = 0.03 * extent(team);
  for (std::size_t r = 0; r < team.robots.size(); ++r)
  {
    const auto& rows = team.robots[r].run.record.rows;
    Series end = series(Kind::kSolid, "", inkOfRobot(r));
    if (!rows.empty()) appendArrow(end, rows.back().robot.mean, length);
    plot.series.push_back(end);
  }
}
}  // namespace

results::Ink inkOfRobot(std::size_t robot)
{
  constexpr std::array<Ink, 6> inks{Ink::kBlue,   Ink::kVermillion, Ink::kGreen,
                                    Ink::kPurple, Ink::kOrange,     Ink::kSky};
  return inks[robot % inks.size()];
}

results::TargetGroup targetOf(const TeamView::Robot& robot, int target)
{
  const auto& record = robot.run.record;
  for (auto& group : results::targetGroups(record, robot.run.evaluation))
  {
    if (group.truthId == target) return group;
    const bool sameIdentity = !group.truthId && group.tracks.size() == 1 &&
                              record.targets[group.tracks.front()].identified &&
                              record.targets[group.tracks.front()].id == target;
    if (sameIdentity) return group;
  }
  return {};
}

std::vector<fusion::FusionEvent> someFusions(const TeamView& team, std::size_t robot)
{
  std::vector<const fusion::FusionEvent*> fused;
  for (const auto& e : team.robots[robot].events)
    if (e.receipt.outcome == fusion::Outcome::kFused) fused.push_back(&e);
  std::vector<fusion::FusionEvent> out;
  if (fused.empty()) return out;
  const std::size_t n =
      std::clamp<std::size_t>(kFusionsInAll / team.robots.size(), 2, kFusionsOfEach);
  const double begin = fused.front()->time, length = fused.back()->time - begin;
  std::set<std::size_t> chosen;
  for (std::size_t i = 0; i < n; ++i)
  {
    const double wanted = begin + length * (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    const auto it = std::find_if(fused.begin(), fused.end() - 1,
                                 [&](const fusion::FusionEvent* e) { return e->time >= wanted; });
    chosen.insert(static_cast<std::size_t>(it - fused.begin()));
  }
  for (const std::size_t i : chosen) out.push_back(*fused[i]);
  return out;
}

double ellipseScale(const TeamView& team)
{
  std::vector<double> sizes;
  for (std::size_t r = 0; r < team.robots.size(); ++r)
    for (const auto& e : someFusions(team, r))
      sizes.push_back(std::sqrt(e.robotBefore.cov.trace()));
  if (sizes.empty()) return 1;
  std::nth_element(sizes.begin(), sizes.begin() + static_cast<long>(sizes.size() / 2), sizes.end());
  // The radius, some two deviations, should be a good twentieth of the map.
  const double wanted = extent(team) / 25 / std::max(sizes[sizes.size() / 2], 1e-9);
  double scale = 1;
  for (const double next : {2, 5, 10, 20, 50, 100, 200, 500, 1000})
    if (next <= 1.4 * wanted) scale = next;
  return scale;
}

Gaussian<Point2D> enlarged(const Gaussian<Point2D>& g, double scale)
{
  return {g.mean, scale * scale * g.cov};
}

results::Figure teamMapFigure(const TeamView& team)
{
  Plot plot;
  plot.equalAxes = true;
  plot.xLabel = "x [m]", plot.yLabel = "y [m]";
  plot.series.push_back(landmarks(team));
  for (std::size_t r = 0; r < team.robots.size(); ++r)
    plot.series.push_back(targetPathOf(team.robots[r], team.target, inkOfRobot(r)));
  for (std::size_t r = 0; r < team.robots.size(); ++r)
    plot.series.push_back(pathOf(team.robots[r], inkOfRobot(r)));
  addEllipses(plot, team);
  const Series truth = truePaths(team);
  if (std::any_of(truth.x.begin(), truth.x.end(), [](double x) { return std::isfinite(x); }))
    plot.series.push_back(truth);
  addArrows(plot, team);
  return results::Figure{{plot}};
}
}  // namespace slamot::team
