#include "MovingTrack.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "BoxFit.h"

namespace slamot::moving
{
namespace
{
constexpr double kCentreStd = 0.08;  // [m]: the middle of what is seen wanders over a thing
constexpr double kFastest = 1.5;     // [m/s], deviation of a thing just seen
constexpr double kTurnStd = 1.0;     // [rad/s] at first

constexpr double kSpeedStd = 0.5;     // [m/s]
constexpr double kHeadingStd = 0.35;  // [rad] of a thing that has just shown where it goes
constexpr double kStartStd = 0.01;    // [m, rad], least of a known start

double variance(const core::ObjectStart& start, core::ObjectStart::Field field, double least)
{
  return std::pow(std::max(start.getStd(field), least), 2);
}

models::ConstantVelocityTarget modelOf(const MovingOptions& options)
{
  return models::ConstantVelocityTarget({kFastest, 0, options.speedWalk});
}
}  // namespace

MovingTrack::MovingTrack(const Thing& thing, double time, const MovingOptions& options)
    : model_(modelOf(options)), lastSeen_(time)
{
  lately_.push_back({time, thing.centre, thing.freePart, thing.points});
  point_ = model_.birth({thing.centre, kCentreStd * kCentreStd * Matrix2::Identity()});
}

MovingTrack::MovingTrack(int id, const core::ObjectStart& start, double time,
                         const MovingOptions& options)
    : model_(modelOf(options)), id_(id), identified_(true), lastSeen_(time)
{
  using Start = core::ObjectStart;
  point_ = model_.start(start);
  point_.P.topLeftCorner<2, 2>().diagonal().array() += kCentreStd * kCentreStd;
  if (options.shape == Shape::kCentre || !start.value[Start::kTheta]) return;
  const double phi = start.get(Start::kTheta), c = std::cos(phi), s = std::sin(phi);
  const double speed = start.get(Start::kVx) * c + start.get(Start::kVy) * s;
  box_.emplace();
  box_->x << start.get(Start::kX) - options.reportAhead * c,
      start.get(Start::kY) - options.reportAhead * s, math::wrapToPi(phi), speed, 0,
      options.length.mean, options.width.mean;
  box_->P.diagonal() << variance(start, Start::kX, kStartStd),
      variance(start, Start::kY, kStartStd), variance(start, Start::kTheta, kStartStd),
      kSpeedStd * kSpeedStd, kTurnStd * kTurnStd, std::pow(options.length.std, 2),
      std::pow(options.width.std, 2);
}

void MovingTrack::predict(double dt, const MovingOptions& options)
{
  unseen_ += dt;
  if (box_)
    moving::predict(*box_, dt, options);
  else
    model_.predict(point_, dt);
}

void MovingTrack::widen(const Point2D& robot, const Matrix3& cov)
{
  const Point2D at = place();
  Matrix3 J = Matrix3::Identity();
  J(0, 2) = -(at.y - robot.y);
  J(1, 2) = at.x - robot.x;
  const Matrix3 added = J * cov * J.transpose();
  if (box_)
    box_->P.topLeftCorner<3, 3>() += added;
  else
    models::ConstantVelocityTarget::widen(point_, added);
}

BoxState MovingTrack::fitted(const Thing& thing, const Look& look,
                             const MovingOptions& options) const
{
  return correct(*box_, {{look.laser.x, look.laser.y}, thing.points, thing.right, thing.left},
                 options);
}

void MovingTrack::see(const Thing& thing, const Look& look, const MovingOptions& options)
{
  lastSeen_ = look.time;
  unseen_ = 0;
  if (box_)
  {
    *box_ = fitted(thing, look, options);
    return;
  }
  const Vector2 nu(thing.centre.x - point_.x[0], thing.centre.y - point_.x[1]);
  const Matrix2 S = point_.pointCov() + kCentreStd * kCentreStd * Matrix2::Identity();
  point_.correct<2>(nu, S, Matrix2::Identity());
  // What several lasers see at one instant counts once.
  if (!lately_.empty() && lately_.back().time == look.time) lately_.pop_back();
  lately_.push_back({look.time, thing.centre, thing.freePart, thing.points});
  while (lately_.front().time < look.time - options.confirmTime) lately_.pop_front();
}

std::vector<std::vector<Point2D>> MovingTrack::trail() const
{
  std::vector<std::vector<Point2D>> out;
  for (const Was& w : lately_) out.push_back(w.points);
  return out;
}

bool MovingTrack::hasMoved(double vacated, const MovingOptions& options) const
{
  if (static_cast<int>(lately_.size()) < options.confirmScans) return false;
  const auto recent = lately_.end() - options.confirmScans;
  const double freePart =
      std::accumulate(recent, lately_.end(), 0.0,
                      [](double sum, const Was& w) { return sum + w.freePart; }) /
      options.confirmScans;
  const Point2D& from = lately_.front().at;
  return freePart + vacated >= options.confirmFree &&
         std::hypot(point_.x[0] - from.x, point_.x[1] - from.y) >=
             std::max(options.confirmDistance, 2 * deviation());
}

// It drives the way it went.
void MovingTrack::confirm(int id, const MovingOptions& options)
{
  id_ = id;
  if (options.shape == Shape::kCentre) return;
  const Vector2 gone(point_.x[0] - lately_.front().at.x, point_.x[1] - lately_.front().at.y);
  const Vector2 v = point_.x.tail<2>();
  const double speed = std::max(v.norm(), 1e-3);
  const Vector2 way = v.dot(gone) > 0 ? Vector2(v) : gone;
  box_.emplace();
  box_->x << point_.x[0], point_.x[1], std::atan2(way[1], way[0]), speed, 0, options.length.mean,
      options.width.mean;
  const double placeVar = std::pow(kCentreStd, 2) + 0.25 * std::pow(options.width.mean, 2);
  box_->P.diagonal() << placeVar, placeVar, kHeadingStd * kHeadingStd, kSpeedStd * kSpeedStd,
      kTurnStd * kTurnStd, std::pow(options.length.std, 2), std::pow(options.width.std, 2);
}

Point2D MovingTrack::place() const
{
  return box_ ? Point2D{box_->x[0], box_->x[1]} : point_.point();
}

double MovingTrack::deviation() const
{
  return std::sqrt(0.5 *
                   (box_ ? box_->P.topLeftCorner<2, 2>().trace() : point_.pointCov().trace()));
}

core::TargetEstimate MovingTrack::estimate(const MovingOptions& options) const
{
  core::TargetEstimate out;
  out.id = id_;
  out.label = "target";
  out.identified = identified_;
  out.lastSeen = lastSeen_;
  if (box_)
  {
    const BoxPoint p = pointOf(*box_, options.reportAhead, options);
    out.pose = p.pose;
    out.velocity = p.velocity;
    out.velocityCov = p.velocityCov;
  }
  else
  {
    out.pose = models::ConstantVelocityTarget::pose(point_);
    out.velocity = models::ConstantVelocityTarget::velocity(point_, out.velocityCov);
  }
  return out;
}
}  // namespace slamot::moving
