#include <slamot/moving/MovingObjects.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "MovingTrack.h"
#include "boxBeams.h"

namespace slamot::moving
{
namespace
{
using perception::Cluster;
using perception::ScanPoint;

double distance(const Point2D& a, const Point2D& b)
{
  return std::hypot(a.x - b.x, a.y - b.y);
}
}  // namespace

class MovingObjects::Impl
{
 public:
  Impl(const MovingOptions& options, const core::Starts& starts)
      : options_(options), space_(options.freeSpace), robot_(starts.robotPose().mean)
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
  }

  std::vector<bool> see(double time, const core::LaserScan& scan)
  {
    const Pose2D laser = math::compose(robot_, scan.pose_robot_sensor);
    const Look look{time, {laser.x, laser.y}, std::abs(scan.angleStep), &scan};
    const std::vector<Cluster> clusters = perception::clustersOf(scan, options_.laser);
    std::vector<bool> moving(scan.ranges.size(), false);
    std::vector<Thing> rest = followBoxes(clusters, look, moving);
    followPoints(rest, look, moving);
    lookThrough(scan, look, laser.phi);
    for (const Cluster& c : clusters)
      for (const ScanPoint& p : c.points)
        space_.add(look.laser, math::transform(robot_, p.at), !moving[p.beam], time);
    space_.tidy(time);
    forget(time);
    return moving;
  }

  [[nodiscard]] std::vector<bool> expected(const core::LaserScan& scan) const
  {
    std::vector<bool> out(scan.ranges.size(), false);
    for (const Cluster& c : perception::clustersOf(scan, options_.laser))
      for (const ScanPoint& p : c.points)
        out[p.beam] = ownerOf(math::transform(robot_, p.at)) != nullptr;
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
  struct Look
  {
    double time;
    Point2D laser;    // in the tracks' axes
    double beamStep;  // [rad]
    const core::LaserScan* scan;
  };

  /// Where a thing ends beside a return, `step` beams on: between these beams, if the next one sees
  /// something farther away.  If it sees nothing, the thing may go on: dark parts and flat angles
  /// give no return.
  [[nodiscard]] End endAt(const ScanPoint& end, int step, const Look& look) const
  {
    constexpr double kDoubtful = 3;  // beams
    const auto n = static_cast<std::ptrdiff_t>(look.scan->ranges.size());
    const std::ptrdiff_t next = (static_cast<std::ptrdiff_t>(end.beam) + step + n) % n;
    const double r = look.scan->ranges[static_cast<std::size_t>(next)];
    const bool isSure = r > end.range && r < look.scan->rangeMax;
    const Point2D at = math::transform(robot_, end.at);
    const double bearing = std::atan2(at.y - look.laser.y, at.x - look.laser.x);
    return {math::wrapToPi(bearing + 0.5 * step * look.scan->angleStep),
            (isSure ? 0.5 : kDoubtful) * look.beamStep};
  }

  [[nodiscard]] static double gateOf(const MovingTrack& t)
  {
    constexpr double kLeast = 0.1, kMost = 0.35;  // [m]
    return std::clamp(3 * t.deviation(), kLeast, kMost);
  }

  /// The moving thing, with a box, whose outline a return is near to; none: null.
  [[nodiscard]] const MovingTrack* ownerOf(const Point2D& at) const
  {
    const MovingTrack* owner = nullptr;
    double nearest = std::numeric_limits<double>::infinity();
    for (const MovingTrack& t : tracks_)
    {
      if (!t.box()) continue;
      const double d = distanceToOutline(*t.box(), at);
      if (d <= gateOf(t) && d < nearest) nearest = d, owner = &t;
    }
    return owner;
  }

  [[nodiscard]] Thing thingOf(const Cluster& cluster, std::size_t from, std::size_t to,
                              const Look& look) const
  {
    Thing out;
    double x = 0, y = 0;
    std::size_t inFree = 0;
    for (std::size_t i = from; i < to; ++i)
    {
      const Point2D at = math::transform(robot_, cluster.points[i].at);
      out.points.push_back(at);
      out.beams.push_back(cluster.points[i].beam);
      x += at.x, y += at.y;
      inFree += space_.at(at, cluster.points[i].range, look.time) == Evidence::kFree ? 1 : 0;
    }
    const auto n = static_cast<double>(to - from);
    out.isWhole = cluster.freeRight && cluster.freeLeft;
    out.centre = {x / n, y / n};
    out.freePart = static_cast<double>(inFree) / n;
    const int leftwards = look.scan->angleStep > 0 ? 1 : -1;
    if (from == 0 && cluster.freeRight) out.right = endAt(cluster.points.front(), -leftwards, look);
    if (to == cluster.points.size() && cluster.freeLeft)
      out.left = endAt(cluster.points.back(), leftwards, look);
    return out;
  }

  [[nodiscard]] double vacatedPart(const std::vector<Point2D>& points, const Look& look) const
  {
    const auto isFree = [&](const Point2D& p)
    { return space_.at(p, distance(p, look.laser), look.time) == Evidence::kFree; };
    return static_cast<double>(std::count_if(points.begin(), points.end(), isFree)) /
           static_cast<double>(points.size());
  }

  /// Gives the boxes their returns. \returns the small things that are nobody's.
  std::vector<Thing> followBoxes(const std::vector<Cluster>& clusters, const Look& look,
                                 std::vector<bool>& moving)
  {
    std::vector<Thing> rest;
    std::map<const MovingTrack*, std::vector<Thing>> seen;
    for (const Cluster& c : clusters)
    {
      std::vector<const MovingTrack*> owners;
      for (const ScanPoint& p : c.points) owners.push_back(ownerOf(math::transform(robot_, p.at)));
      const auto owned = std::count_if(owners.begin(), owners.end(), [](auto* t) { return t; });
      const bool small = c.width() <= options_.maxSize;
      if (owned > 0 && standsThere(c, owners, look)) continue;
      if (owned == 0)
      {
        if (small && static_cast<int>(c.points.size()) >= options_.minPoints)
          rest.push_back(thingOf(c, 0, c.points.size(), look));
        continue;
      }
      if (small && 2 * owned >= static_cast<std::ptrdiff_t>(owners.size())) spread(owners);
      addRuns(c, owners, look, seen);
    }
    for (MovingTrack& t : tracks_)
    {
      const auto found = seen.find(&t);
      if (found == seen.end()) continue;
      const Thing thing = ownParts(t, found->second, look);
      for (const std::size_t b : thing.beams) moving[b] = true;
      if (static_cast<int>(thing.points.size()) >= options_.minPoints)
        t.see(thing, look.laser, look.time, options_);
    }
    return rest;
  }

  /// Whether what lies in a moving thing's gate stood there before.
  [[nodiscard]] bool standsThere(const Cluster& c, const std::vector<const MovingTrack*>& owners,
                                 const Look& look) const
  {
    constexpr double kMostly = 0.7;
    int owned = 0, standing = 0;
    for (std::size_t i = 0; i < owners.size(); ++i)
    {
      if (!owners[i]) continue;
      ++owned;
      const Point2D at = math::transform(robot_, c.points[i].at);
      standing += space_.isOccupied(at, look.time) ? 1 : 0;
    }
    return standing > kMostly * owned;
  }

  /// A thing's points beside those that are in the gate are its own too.
  static void spread(std::vector<const MovingTrack*>& owners)
  {
    for (std::size_t i = 1; i < owners.size(); ++i)
      if (!owners[i]) owners[i] = owners[i - 1];
    for (std::size_t i = owners.size() - 1; i-- > 0;)
      if (!owners[i]) owners[i] = owners[i + 1];
  }

  void addRuns(const Cluster& c, const std::vector<const MovingTrack*>& owners, const Look& look,
               std::map<const MovingTrack*, std::vector<Thing>>& seen) const
  {
    for (std::size_t from = 0; from < owners.size();)
    {
      std::size_t to = from;
      while (to < owners.size() && owners[to] == owners[from]) ++to;
      if (owners[from]) seen[owners[from]].push_back(thingOf(c, from, to, look));
      from = to;
    }
  }

  /// Of the parts in a box's gate, together, those that lie on it once it is fitted to them all:
  /// what stands beside it is no part of it.
  [[nodiscard]] Thing ownParts(const MovingTrack& t, const std::vector<Thing>& parts,
                               const Look& look) const
  {
    constexpr double kOff = 0.1;  // [m], mean distance
    Thing all, own;
    for (const Thing& part : parts) join(all, part, look.laser);
    const BoxState box = t.fitted(all, look.laser, options_);
    for (const Thing& part : parts)
    {
      double sum = 0;
      for (const Point2D& p : part.points) sum += distanceToOutline(box, p);
      if (sum <= kOff * static_cast<double>(part.points.size())) join(own, part, look.laser);
    }
    return own;
  }

  static void join(Thing& all, const Thing& part, const Point2D& laser)
  {
    if (all.points.empty())
    {
      all = part;
      return;
    }
    // Clusters come by rising angle, but one may lie across the end of the circle.
    const auto towards = [&](const Point2D& p) { return std::atan2(p.y - laser.y, p.x - laser.x); };
    const bool after =
        math::wrapToPi(towards(part.points.front()) - towards(all.points.front())) > 0;
    (after ? all.left : all.right) = after ? part.left : part.right;
    all.points.insert(all.points.end(), part.points.begin(), part.points.end());
    all.beams.insert(all.beams.end(), part.beams.begin(), part.beams.end());
  }

  /// Things that are no boxes: candidates, and what is followed by its middle.
  void followPoints(std::vector<Thing>& things, const Look& look, std::vector<bool>& moving)
  {
    constexpr double kGate = 0.3;  // [m]
    struct Pair
    {
      double apart;
      std::size_t track, thing;
    };
    std::vector<Pair> pairs;
    for (std::size_t t = 0; t < tracks_.size(); ++t)
      if (!tracks_[t].box())
        for (std::size_t i = 0; i < things.size(); ++i)
        {
          const double apart = distance(tracks_[t].place(), things[i].centre);
          if (apart < kGate + tracks_[t].deviation()) pairs.push_back({apart, t, i});
        }
    std::sort(pairs.begin(), pairs.end(),
              [](const Pair& a, const Pair& b) {
                return std::tie(a.apart, a.track, a.thing) < std::tie(b.apart, b.track, b.thing);
              });
    std::vector<bool> usedTrack(tracks_.size(), false), usedThing(things.size(), false);
    for (const Pair& p : pairs)
    {
      if (usedTrack[p.track] || usedThing[p.thing]) continue;
      usedTrack[p.track] = usedThing[p.thing] = true;
      MovingTrack& t = tracks_[p.track];
      t.see(things[p.thing], look.laser, look.time, options_);
      const bool maybe = !t.isMoving() || options_.shape == Shape::kRectangle;
      if (maybe && t.hasMoved(vacatedPart(t.before(), look), options_)) believe(t);
      if (t.isMoving())
        for (const std::size_t b : things[p.thing].beams) moving[b] = true;
    }
    for (std::size_t i = 0; i < things.size(); ++i)
      if (!usedThing[i] && things[i].isWhole) tracks_.emplace_back(things[i], look.time, options_);
  }

  /// What it left behind while it was a candidate never stood there.
  void believe(MovingTrack& t)
  {
    for (const auto& points : t.trail())
      for (const Point2D& p : points) space_.forget(p);
    while (taken_.count(nextId_) > 0) ++nextId_;
    t.confirm(t.isMoving() ? t.id() : nextId_++, options_);
  }

  /// A thing that most beams pass, where it is thought to be, is not there.
  void lookThrough(const core::LaserScan& scan, const Look& look, double laserHeading)
  {
    constexpr double kCore = 0.1;  // [m] around its middle: beams near its ends may miss it
    for (MovingTrack& t : tracks_)
    {
      if (!t.isMoving() || t.lastSeen() == look.time)
      {
        t.seenThrough = 0;
        continue;
      }
      const Point2D at = t.place();
      const double range = distance(at, look.laser);
      const double bearing = std::atan2(at.y - look.laser.y, at.x - look.laser.x) - laserHeading;
      const int reach = static_cast<int>(std::atan2(kCore, range) / look.beamStep);
      int through = 0, stopped = 0;
      for (int k = -reach; k <= reach; ++k)
      {
        const double i = math::wrapToPi(bearing - scan.angleMin - math::kPi) / scan.angleStep +
                         math::kPi / scan.angleStep + k;
        if (i < 0 || i >= static_cast<double>(scan.ranges.size())) continue;
        const double r = scan.ranges[static_cast<std::size_t>(i)];
        if (!(r > 0) || r >= scan.rangeMax) continue;
        ++(r > range + 0.5 * options_.maxSize ? through : stopped);
      }
      t.seenThrough = through > stopped ? t.seenThrough + 1 : t.seenThrough;
    }
  }

  void forget(double time)
  {
    const auto isLost = [&](const MovingTrack& t)
    {
      const double unseen = time - t.lastSeen();
      return !t.isMoving() ? unseen > options_.tentativeTime
                           : unseen > options_.lostTime || t.seenThrough >= options_.seenThrough;
    };
    tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), isLost), tracks_.end());
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
    t.velocityCov = (r * t.velocityCov * r.transpose()).eval();
    t.velocityCov = (0.5 * (t.velocityCov + t.velocityCov.transpose())).eval();
    return t;
  }

  MovingOptions options_;
  FreeSpace space_;
  Pose2D robot_;
  std::vector<MovingTrack> tracks_;
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
