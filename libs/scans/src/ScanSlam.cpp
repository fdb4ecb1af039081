#include <slamot/scans/ScanSlam.h>

#include <optional>

#include "LoopCloser.h"

namespace slamot::scans
{
namespace
{
constexpr double kLeastTrust = 0.5;  // of a loop that may stay

/// A time's place, by the keyframe before it: it moves as that one does.
struct Noted
{
  double time;
  std::size_t keyframe;
  Pose2D pose_keyframe_robot;
};
}  // namespace

struct ScanSlam::State
{
  State(const Settings& s, const Gaussian<Pose2D>& from)
      : settings(s),
        start(from),
        matcher(s.match),
        closer(s),
        graph(from.mean),
        keyframes(1),
        base(from)
  {
  }

  Settings settings;
  Gaussian<Pose2D> start;
  ScanMatcher matcher;
  LoopCloser closer;
  PoseGraph graph;
  Keyframes keyframes;             // the first is the start, where nothing was seen yet
  Gaussian<Pose2D> base, since;    // of the last keyframe; of the robot from there
  std::optional<LocalMap> recent;  // in the frame of the last keyframe
  double blind = 0;                // time without odometry or a match [s]
  std::vector<Noted> noted;
  Counts counts;

  [[nodiscard]] std::size_t last() const { return keyframes.size() - 1; }

  [[nodiscard]] const LocalMap& recentMap()
  {
    if (!recent)
    {
      const std::size_t first = around(keyframes, last(), settings.recent).first;
      recent.emplace(pointsOf(keyframes, graph, first, last(), graph.pose(last())),
                     settings.maxRange + settings.reach.mostRadius);
    }
    return *recent;
  }

  [[nodiscard]] bool isDue() const
  {
    return keyframes.back().points.empty() ||
           std::hypot(since.mean.x, since.mean.y) >= settings.keyframeDistance ||
           std::abs(since.mean.phi) >= settings.keyframeTurn;
  }

  void addKeyframe(std::vector<Point2D> points)
  {
    const double path = keyframes.back().path + std::hypot(since.mean.x, since.mean.y);
    const std::size_t node = graph.add(math::compose(graph.pose(last()), since.mean));
    Relation step{last(), node, since};
    step.pose_from_to.cov += 1e-6 * Matrix3::Identity();  // an exact one could not be solved with
    graph.relate(step);
    keyframes.push_back({std::move(points), path});
    base = math::compose(base, since);
    since = {};
    recent.reset();
    ++counts.keyframes;
  }

  void closeLoops()
  {
    const std::vector<Relation> loops = closer.search(graph, keyframes);
    if (loops.empty()) return;
    const std::size_t before = graph.relations().size();
    const std::vector<Pose2D> poses = graph.poses();
    for (const Relation& loop : loops) graph.relate(loop);
    graph.optimise(before);
    graph.optimise();
    for (const Relation& loop : loops)
      if (!(graph.trust(loop) >= kLeastTrust))
      {
        graph.restore(before, poses);
        counts.refused += static_cast<int>(loops.size());
        return;
      }
    counts.loops += static_cast<int>(loops.size());
    recent.reset();
    // The graph is solved relative to the start, which is uncertain itself.
    const Matrix3 R = math::poseRotation(start.mean.phi);
    const Pose2D there = math::between(start.mean, graph.pose(last()));
    base = math::compose(start, {there, R.transpose() * graph.covariance(last()) * R});
  }
};

ScanSlam::ScanSlam(const Settings& settings, const Gaussian<Pose2D>& start)
    : state_(std::make_unique<State>(settings, start))
{
}
ScanSlam::~ScanSlam() = default;

void ScanSlam::move(const Gaussian<Pose2D>& increment)
{
  const double scale = state_->settings.odometryScale;
  state_->since = math::compose(state_->since, {increment.mean, scale * scale * increment.cov});
  state_->blind = 0;
}

// An unknown speed goes on: over several steps it adds up as over one.
Gaussian<Pose2D> blindMotion(double since, double dt, const Settings& settings)
{
  const double squares = dt * (2 * since + dt);
  const double v = settings.blindSpeed, w = settings.blindTurn;
  return {{}, Vector3(v * v * squares, v * v * squares, w * w * squares).asDiagonal()};
}

void ScanSlam::wait(double dt)
{
  state_->since = math::compose(state_->since, blindMotion(state_->blind, dt, state_->settings));
  state_->blind += dt;
}

Match ScanSlam::match(const std::vector<Return>& returns)
{
  std::vector<Point2D> points;
  for (const Return& r : returns) points.push_back(r.point);
  State& s = *state_;
  const Match out = s.matcher.match(s.recentMap(), thinned(points, s.settings.thinning), s.since,
                                    s.settings.reach);
  if (out.matched) s.since = out.pose, s.blind = 0;
  ++(out.matched ? s.counts.matched : s.counts.unmatched);
  return out;
}

void ScanSlam::insert(const std::vector<Return>& returns, const std::vector<bool>& leaveOut)
{
  State& s = *state_;
  if (!s.isDue()) return;
  std::vector<Point2D> points;
  for (const Return& r : returns)
    if (r.beam >= leaveOut.size() || !leaveOut[r.beam]) points.push_back(r.point);
  if (points.empty()) return;
  s.addKeyframe(thinned(points, s.settings.thinning));
  if (s.settings.loop.search) s.closeLoops();
}

Gaussian<Pose2D> ScanSlam::pose() const
{
  return math::compose(state_->base, state_->since);
}

void ScanSlam::note(double time)
{
  state_->noted.push_back({time, state_->last(), state_->since.mean});
}

std::vector<core::PathPose> ScanSlam::path() const
{
  std::vector<core::PathPose> out;
  for (const Noted& n : state_->noted)
    out.push_back({n.time, math::compose(state_->graph.pose(n.keyframe), n.pose_keyframe_robot)});
  return out;
}

const ScanSlam::Counts& ScanSlam::counts() const
{
  return state_->counts;
}
}  // namespace slamot::scans
