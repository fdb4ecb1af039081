#include "Story.h"

#include <slamot/mrpt/scanPoints.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "sceneOf.h"

namespace slamot::apps
{
namespace
{
constexpr double kShown = 1.0;     // a scan or sighting stays in view so long [s]
constexpr double kSmoothed = 1.0;  // the camera's heading is the mean of so long [s]

std::string fixed(double value, int decimals)
{
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}
}  // namespace

RobotStory::RobotStory(const SavedRun& run) : run_(run)
{
  collectLandmarks();
  collectErrors();
  whole_ = sceneOf(run.title, run.view(), run.particles);
  whole_.ofMoments = true;
  collectLaserPoints();
  if (!whole_.laserPoints.empty()) whole_.scanPoints = {whole_.laserPoints.front()};
  const bool seen = std::any_of(run.record.pairings.begin(), run.record.pairings.end(),
                                [](const eval::PairingRow& p)
                                { return p.pairing.outcome != core::Pairing::Outcome::kRejected; });
  if (seen) whole_.sightings.emplace_back();
}

void RobotStory::collectLandmarks()
{
  const auto& landmarks = run_.record.landmarks;
  for (std::size_t i = 0; i < landmarks.size(); ++i) landmarks_[landmarks[i].id] = i;
  std::size_t ofMap = 0, all = 0;
  for (const eval::PairingRow& p : run_.record.pairings)
  {
    if (p.pairing.isBlob || p.pairing.outcome == core::Pairing::Outcome::kRejected) continue;
    firstSeen_.emplace(p.pairing.id, p.time);
    ofMap += landmarks_.count(p.pairing.id);
    ++all;
  }
  // Filters that doubt and forget landmarks number the same one anew: first sightings tell nothing.
  if (2 * ofMap < all) firstSeen_.clear();
}

void RobotStory::collectErrors()
{
  for (const eval::StepError& e : run_.evaluation.robot.steps)
    errors_[e.row] = e.error.head<2>().norm();
}

// A wall that is seen a thousand times is drawn once.
void RobotStory::collectLaserPoints()
{
  const auto& rows = run_.record.rows;
  double side = 1;
  for (const eval::RobotRow& r : rows)
    side = std::max({side, std::abs(r.robot.mean.x), std::abs(r.robot.mean.y)});
  const double cell = std::max(0.05, side / 500);
  std::set<std::pair<long, long>> filled;
  whole_.laserPoints.clear();
  for (const eval::LaserRow& laser : run_.record.lasers)
  {
    std::vector<Point2D> seen;
    mrpt::appendPoints(seen, *laser.scan, rows[laser.row].robot.mean);
    for (const Point2D& p : seen)
      if (filled.emplace(std::lround(p.x / cell), std::lround(p.y / cell)).second)
        points_.push_back({laser.row, p}), whole_.laserPoints.push_back(p);
  }
}

double RobotStory::timeOf(std::size_t row) const
{
  return run_.record.rows[row].time;
}

double RobotStory::duration() const
{
  return timeOf(run_.record.rows.size() - 1) - timeOf(0);
}

std::size_t RobotStory::rowAt(double time) const
{
  const auto& rows = run_.record.rows;
  const double limit = timeOf(0) + time + 1e-9;
  const auto after = std::upper_bound(rows.begin(), rows.end(), limit,
                                      [](double t, const auto& row) { return t < row.time; });
  return after == rows.begin() ? 0 : static_cast<std::size_t>(after - rows.begin()) - 1;
}

mrpt::Moment RobotStory::at(std::size_t row) const
{
  mrpt::Moment moment;
  mrpt::SceneData& scene = moment.scene;
  scene = sceneUntil(run_.title, run_.view(), row);
  const double now = timeOf(row);
  for (const auto& landmark : run_.record.landmarks)
    if (const auto first = firstSeen_.find(landmark.id);
        first == firstSeen_.end() || first->second <= now)
      scene.landmarks.push_back(landmark);
  for (const LaserPoint& p : points_)
    if (p.row <= row) scene.laserPoints.push_back(p.point);
  scene.scanPoints = scanAt(row);
  scene.sightings = sightingsAt(row, scene);
  if (row + 1 == run_.record.rows.size()) scene.particles = run_.particles;
  moment.caption = captionAt(row);
  moment.lookedAt = lookedAt(row);
  return moment;
}

std::vector<Point2D> RobotStory::scanAt(std::size_t row) const
{
  const auto& lasers = run_.record.lasers;
  const auto after =
      std::upper_bound(lasers.begin(), lasers.end(), row,
                       [](std::size_t r, const eval::LaserRow& l) { return r < l.row; });
  std::vector<Point2D> points;
  for (auto it = after; it != lasers.begin() && (it - 1)->row == (after - 1)->row; --it)
    if (timeOf((it - 1)->row) > timeOf(row) - kShown)
      mrpt::appendPoints(points, *(it - 1)->scan, run_.record.rows[(it - 1)->row].robot.mean);
  return points;
}

std::vector<mrpt::Polyline> RobotStory::sightingsAt(std::size_t row,
                                                    const mrpt::SceneData& scene) const
{
  const auto& all = run_.record.pairings;
  const auto after =
      std::upper_bound(all.begin(), all.end(), timeOf(row) + 1e-9,
                       [](double t, const eval::PairingRow& p) { return t < p.time; });
  std::vector<mrpt::Polyline> rays;
  const Point2D robot{scene.robot.now->mean.x, scene.robot.now->mean.y};
  for (auto it = after; it != all.begin() && (it - 1)->time == (after - 1)->time; --it)
  {
    const core::Pairing& p = (it - 1)->pairing;
    const auto landmark = landmarks_.find(p.id);
    const bool old = (it - 1)->time < timeOf(row) - kShown;
    if (old || p.isBlob || p.outcome == core::Pairing::Outcome::kRejected ||
        landmark == landmarks_.end())
      continue;
    rays.push_back({robot, run_.record.landmarks[landmark->second].position.mean});
  }
  return rays;
}

std::optional<double> RobotStory::errorAt(std::size_t row) const
{
  const auto error = errors_.find(row);
  return error == errors_.end() ? std::nullopt : std::optional<double>(error->second);
}

std::string RobotStory::captionAt(std::size_t row) const
{
  std::string text = "t = " + fixed(timeOf(row) - timeOf(0), 1) + " s";
  if (const auto error = errorAt(row))
    text += "   position error " + fixed(*error, *error < 10 ? 2 : 1) + " m";
  else if (!errors_.empty())
    text += "   no truth for this moment";
  return text;
}

// Its own heading would shake the picture with each update.
Pose2D RobotStory::lookedAt(std::size_t row) const
{
  const auto& rows = run_.record.rows;
  double x = 0, y = 0;
  for (std::size_t i = row + 1; i-- > 0 && rows[i].time > timeOf(row) - kSmoothed;)
    x += std::cos(rows[i].robot.mean.phi), y += std::sin(rows[i].robot.mean.phi);
  const Pose2D& now = rows[row].robot.mean;
  return {now.x, now.y, std::atan2(y, x)};
}

std::vector<std::size_t> momentsOf(const Story& story, double step)
{
  std::vector<std::size_t> rows;
  const auto n = static_cast<std::size_t>(story.duration() / step + 1e-9);
  for (std::size_t i = 0; i <= n; ++i) rows.push_back(story.rowAt(static_cast<double>(i) * step));
  const std::size_t end = story.rowAt(story.duration());
  if (rows.back() != end) rows.push_back(end);
  return rows;
}
}  // namespace slamot::apps
