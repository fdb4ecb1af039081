#include <slamot/results/Figures.h>

#include <algorithm>
#include <limits>

namespace slamot::results
{
namespace
{
using Kind = Series::Kind;
const double kTruthGap = eval::EvaluationOptions{}.maxTruthGap;
constexpr std::size_t kNamedTargets = 6;  ///< more do not fit the legend

void appendPoint(Series& s, double x, double y)
{
  s.x.push_back(x);
  s.y.push_back(y);
}

void breakLine(Series& s)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  appendPoint(s, nan, nan);
}

/// Long paths cross themselves often: thin lines leave something to see.
Kind lineKind(std::size_t points)
{
  return points > 20000 ? Kind::kThin : Kind::kLine;
}

/// Truth moved into the map's frame.
struct TruthMover
{
  Pose2D mapFromTruth;
  explicit TruthMover(const Pose2D& truthFromMap)
      : mapFromTruth(math::between(truthFromMap, Pose2D{}))
  {
  }
  void append(Series& s, const Point2D& p) const
  {
    const Point2D q = math::transform(mapFromTruth, p);
    appendPoint(s, q.x, q.y);
  }
  void append(Series& s, const eval::Trajectory& t) const
  {
    for (std::size_t i = 0; i < t.poses.size(); ++i)
    {
      if (i > 0 && t.poses[i].time - t.poses[i - 1].time > kTruthGap) breakLine(s);
      append(s, Point2D{t.poses[i].pose.x, t.poses[i].pose.y});
    }
    breakLine(s);
  }
};

void addLandmarks(Plot& plot, const RunView& run, const TruthMover& mover)
{
  Series ellipses{Kind::kShape, "landmarks, 95% ellipse", Ink::kGreen, {}, {}, {}, {}};
  Series centres{Kind::kDots, "", Ink::kGreen, {}, {}, {}, {}};
  for (const auto& landmark : run.record.landmarks)
  {
    appendEllipse(ellipses, landmark.position);
    appendPoint(centres, landmark.position.mean.x, landmark.position.mean.y);
  }
  Series truth{Kind::kCrosses, "landmarks, true", Ink::kText, {}, {}, {}, {}};
  for (const auto& [id, p] : run.truth.landmarks) mover.append(truth, p);
  plot.series.insert(plot.series.end(), {ellipses, centres, truth});
}

Series pathOf(const eval::TargetTrack& track, Kind kind)
{
  Series path{kind, "", Ink::kVermillion, {}, {}, {}, {}};
  for (std::size_t i = 0; i < track.rows.size(); ++i)
  {
    if (i > 0 && track.rows[i].row != track.rows[i - 1].row + 1) breakLine(path);
    appendPoint(path, track.rows[i].pose.mean.x, track.rows[i].pose.mean.y);
  }
  return path;
}

void addTrack(Plot& plot, const RunView& run, const eval::TargetTrack& track,
              const std::string& title, Ink ink, double arrow)
{
  Series path = pathOf(track, lineKind(run.record.rows.size()));
  path.title = title;
  path.ink = ink;
  plot.series.push_back(path);
  if (track.rows.back().row + 1 != run.record.rows.size()) return;  // lost by then
  Series end{Kind::kSolid, "", ink, {}, {}, {}, {}};
  appendArrow(end, track.rows.back().pose.mean, arrow);
  plot.series.push_back(end);
}

/// All tracks of one target have one colour, and its true path too.
void addTargets(Plot& plot, const RunView& run, const std::vector<TargetGroup>& groups,
                double arrow)
{
  bool named = false;
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    std::string title = groups[g].name;
    if (groups.size() > kNamedTargets) title = named ? "" : "targets";
    for (const std::size_t i : groups[g].tracks)
    {
      if (run.record.targets[i].rows.empty()) continue;
      addTrack(plot, run, run.record.targets[i], title, inkOf(g), arrow);
      title.clear();
      named = true;
    }
  }
}

void addTruePaths(Plot& plot, const RunView& run, const std::vector<TargetGroup>& groups,
                  const TruthMover& mover)
{
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    if (!groups[g].truthId) continue;
    Series path{Kind::kDashes, "", inkOf(g), {}, {}, {}, {}};
    mover.append(path, run.truth.targets.at(*groups[g].truthId));
    plot.series.push_back(path);
  }
  if (run.truth.robot.empty()) return;
  Series path{Kind::kDashes, "true paths", Ink::kText, {}, {}, {}, {}};
  mover.append(path, run.truth.robot);
  plot.series.push_back(path);
}

/// Size of what is mapped, for marks that should neither vanish nor hide the rest [m].
double extent(const eval::Record& record)
{
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  for (const auto& row : record.rows)
  {
    x0 = std::min(x0, row.robot.mean.x), x1 = std::max(x1, row.robot.mean.x);
    y0 = std::min(y0, row.robot.mean.y), y1 = std::max(y1, row.robot.mean.y);
  }
  for (const auto& l : record.landmarks)
  {
    x0 = std::min(x0, l.position.mean.x), x1 = std::max(x1, l.position.mean.x);
    y0 = std::min(y0, l.position.mean.y), y1 = std::max(y1, l.position.mean.y);
  }
  return std::max({x1 - x0, y1 - y0, 0.1});
}
}  // namespace

Figure mapFigure(const RunView& run)
{
  Plot plot;
  plot.equalAxes = true;
  plot.xLabel = "x [m]", plot.yLabel = "y [m]";
  const TruthMover mover(run.evaluation.truthFromMap);
  const double arrow = 0.03 * extent(run.record);

  Series odometry{Kind::kThin, "odometry alone", Ink::kMuted, {}, {}, {}, {}};
  Series robot{lineKind(run.record.rows.size()), "robot", Ink::kBlue, {}, {}, {}, {}};
  for (const auto& row : run.record.rows)
  {
    appendPoint(odometry, row.odometry.x, row.odometry.y);
    appendPoint(robot, row.robot.mean.x, row.robot.mean.y);
  }
  plot.series = {odometry, robot};
  const auto groups = targetGroups(run.record, run.evaluation);
  addTargets(plot, run, groups, arrow);
  addTruePaths(plot, run, groups, mover);
  addLandmarks(plot, run, mover);
  Series end{Kind::kSolid, "", Ink::kBlue, {}, {}, {}, {}};
  if (!run.record.rows.empty()) appendArrow(end, run.record.rows.back().robot.mean, arrow);
  plot.series.push_back(end);
  return Figure{{plot}};
}
}  // namespace slamot::results
