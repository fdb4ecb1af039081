#include <slamot/moving/MovingObjects.h>

#include <algorithm>
#include <set>

#include "claims.h"

namespace slamot::moving
{
class MovingObjects::Impl
{
 public:
  Impl(const MovingOptions& options, const core::Starts& starts)
      : options_(options),
        space_(options.freeSpace, {starts.robotPose().mean.x, starts.robotPose().mean.y}),
        robot_(starts.robotPose().mean)
  {
    for (const auto& [id, start] : starts.targets)
    {
      tracks_.emplace_back(id, start, starts.time.value_or(0), options_);
      taken_.insert(id);
    }
  }

  void move(const Gaussian<Pose2D>& increment, double dt)
  {
    const double turned = robot_.phi;
    robot_ = math::compose(robot_, increment.mean);
    const Matrix3 R = math::poseRotation(turned);
    const Matrix3 cov = R * increment.cov * R.transpose();
    for (MovingTrack& t : tracks_)
    {
      t.predict(dt, options_);
      t.widen({robot_.x, robot_.y}, cov);
    }
    if (hasSeen_) dropIf([&](const MovingTrack& t) { return t.isMoving() && isUnseen(t); });
  }

  std::vector<bool> see(double time, const core::LaserScan& scan)
  {
    const Look look(time, robot_, scan);
    if (!hasSeen_)
      for (MovingTrack& t : tracks_) t.expectNow();
    hasSeen_ = true;
    const auto clusters = perception::clustersOf(scan, options_.laser);
    std::vector<bool> moving(scan.ranges.size(), false);
    const Claims claims = claim(clusters, tracks_, look, space_, options_);
    followBoxes(claims, look, moving);
    followPoints(claims.rest, look, moving);
    lookThrough(look);
    for (const auto& c : clusters)
      for (const auto& p : c.points)
        space_.add({look.laser.x, look.laser.y}, look.at(p), !moving[p.beam], time);
    space_.tidy(time);
    dropIf([&](const MovingTrack& t)
           { return isUnseen(t) || t.seenThrough >= options_.seenThrough; });
    return moving;
  }

  [[nodiscard]] std::vector<bool> expected(const core::LaserScan& scan) const
  {
    std::vector<bool> out(scan.ranges.size(), false);
    for (const auto& c : perception::clustersOf(scan, options_.laser))
      for (const auto& p : c.points)
        out[p.beam] = ownerOf(math::transform(robot_, p.at), tracks_) != nullptr;
    return out;
  }

  [[nodiscard]] std::vector<core::TargetEstimate> targets(const Gaussian<Pose2D>& robot) const
  {
    std::vector<core::TargetEstimate> out;
    for (const MovingTrack& t : tracks_)
      if (t.isMoving()) out.push_back(inMap(t.estimate(options_), robot));
    std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    return out;
  }

 private:
  void followBoxes(const Claims& claims, const Look& look, std::vector<bool>& moving)
  {
    for (MovingTrack& t : tracks_)
    {
      const auto found = claims.boxes.find(&t);
      if (found == claims.boxes.end()) continue;
      const Thing& thing = found->second;
      for (const std::size_t b : thing.beams) moving[b] = true;
      if (static_cast<int>(thing.points.size()) >= options_.minPoints) t.see(thing, look, options_);
    }
  }

  /// Things that are no boxes: candidates, and what is followed by its middle.
  void followPoints(const std::vector<Thing>& things, const Look& look, std::vector<bool>& moving)
  {
    std::vector<bool> used(things.size(), false);
    for (const PointPair& pair : pairPoints(tracks_, things))
    {
      const Thing& thing = things[pair.thing];
      MovingTrack& t = tracks_[pair.track];
      used[pair.thing] = true;
      t.see(thing, look, options_);
      const bool maybe = !t.isMoving() || options_.shape == Shape::kRectangle;
      if (maybe && t.hasMoved(freePartOf(t.before(), look, space_), options_)) believe(t);
      if (t.isMoving())
        for (const std::size_t b : thing.beams) moving[b] = true;
    }
    for (std::size_t i = 0; i < things.size(); ++i)
      if (!used[i] && things[i].isWhole) tracks_.emplace_back(things[i], look.time, options_);
  }

  /// What it left behind while it was a candidate never stood there.
  void believe(MovingTrack& t)
  {
    for (const auto& points : t.trail())
      for (const Point2D& p : points) space_.forget(p);
    while (taken_.count(nextId_) > 0) ++nextId_;
    t.confirm(t.isMoving() ? t.id() : nextId_++, options_);
  }

  void lookThrough(const Look& look)
  {
    for (MovingTrack& t : tracks_)
      if (!t.isMoving() || t.unseen() == 0)
        t.seenThrough = 0;
      else if (look.goesThrough(t.place(), 0.5 * options_.maxSize))
        ++t.seenThrough;
  }

  [[nodiscard]] bool isUnseen(const MovingTrack& t) const
  {
    return t.unseen() > (t.isMoving() ? options_.lostTime : options_.tentativeTime);
  }

  template <class Is>
  void dropIf(const Is& is)
  {
    tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), is), tracks_.end());
  }

  [[nodiscard]] core::TargetEstimate inMap(core::TargetEstimate t,
                                           const Gaussian<Pose2D>& robot) const
  {
    const double turn = robot.mean.phi - robot_.phi;
    const Pose2D relative = math::between(robot_, t.pose.mean);
    t.pose.mean = math::compose(robot.mean, relative);
    const Matrix3 R = math::poseRotation(turn);
    Matrix3 J = Matrix3::Identity();
    J(0, 2) = -(t.pose.mean.y - robot.mean.y);
    J(1, 2) = t.pose.mean.x - robot.mean.x;
    t.pose.cov = (R * t.pose.cov * R.transpose() + J * robot.cov * J.transpose()).eval();
    t.pose.cov = (0.5 * (t.pose.cov + t.pose.cov.transpose())).eval();
    const Matrix2 r = R.topLeftCorner<2, 2>();
    t.velocity = (r * t.velocity).eval();
    const Vector2 across(-t.velocity[1], t.velocity[0]);
    t.velocityCov =
        (r * t.velocityCov * r.transpose() + robot.cov(2, 2) * across * across.transpose()).eval();
    t.velocityCov = (0.5 * (t.velocityCov + t.velocityCov.transpose())).eval();
    return t;
  }

  MovingOptions options_;
  FreeSpace space_;
  Pose2D robot_;
  std::vector<MovingTrack> tracks_;
  bool hasSeen_ = false;
  std::set<int> taken_;  // by starts
  int nextId_ = 0;
};

MovingObjects::MovingObjects(const MovingOptions& options, const core::Starts& starts)
    : impl_(std::make_unique<Impl>(options, starts))
{
}
MovingObjects::~MovingObjects() = default;
MovingObjects::MovingObjects(MovingObjects&&) noexcept = default;
MovingObjects& MovingObjects::operator=(MovingObjects&&) noexcept = default;

void MovingObjects::move(const Gaussian<Pose2D>& increment, double dt)
{
  impl_->move(increment, dt);
}
std::vector<bool> MovingObjects::see(double time, const core::LaserScan& scan)
{
  return impl_->see(time, scan);
}
std::vector<bool> MovingObjects::expected(const core::LaserScan& scan) const
{
  return impl_->expected(scan);
}
std::vector<core::TargetEstimate> MovingObjects::targets(const Gaussian<Pose2D>& robot) const
{
  return impl_->targets(robot);
}
}  // namespace slamot::moving
