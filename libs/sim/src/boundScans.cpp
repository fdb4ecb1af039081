#include <slamot/models/RangeBearing.h>

#include <Eigen/LU>

#include "BoundRecursion.h"

namespace slamot::sim
{
using models::RangeBearing;

void BoundRecursion::scan(int robot)
{
  Rows rows;
  const std::vector<Seen> fresh = scanLandmarks(robot, rows);
  if (scenario_.targetSensor) scanTargets(robot, rows);
  if (scenario_.mateSensor && robots_.size() > 1) scanMates(robot, rows);
  errors_.observe(rows);
  for (const Seen& seen : fresh) addLandmark(robot, seen);
}

ScanKeys BoundRecursion::keys(int robot, Purpose sensing, Purpose clutter) const
{
  return {seed_, sensing, clutter, static_cast<std::uint64_t>(bodies_.step()), robotKey(robot)};
}

// Whether filters are given it, and it has derivatives.
bool BoundRecursion::counts(int robot, const SensorSetup& sensor, const core::FieldOfView& fov,
                            const Seen& seen, const std::map<int, Point2D>& objects) const
{
  return seen.object != core::kNoId && usable(sensor, fov, seen) &&
         RangeBearing::predict(bodies_.robot(robot), objects.at(seen.object))[0] >=
             RangeBearing::kSmallestRange;
}

/// \return those seen for the first time.
std::vector<Seen> BoundRecursion::scanLandmarks(int robot, Rows& rows) const
{
  const SensorSetup& sensor = scenario_.landmarkSensor;
  std::vector<Seen> fresh;
  for (const Seen& seen : sense(sensor, bodies_.robot(robot), landmarks_,
                                keys(robot, Purpose::kLandmarkSensing, Purpose::kLandmarkClutter)))
  {
    if (!counts(robot, sensor, sensor.fov, seen, landmarks_)) continue;
    const auto known = landmarkAt_.find(seen.object);
    if (known == landmarkAt_.end())
      fresh.push_back(seen);
    else
      rows.push_back(row(robot, sensor, seen, landmarks_.at(seen.object), known->second));
  }
  return fresh;
}

void BoundRecursion::scanTargets(int robot, Rows& rows)
{
  const SensorSetup& sensor = *scenario_.targetSensor;
  std::map<int, Point2D> places;
  for (const auto& [id, pose] : bodies_.presentTargets()) places[id] = {pose.x, pose.y};
  for (const Seen& seen : sense(sensor, bodies_.robot(robot), places,
                                keys(robot, Purpose::kTargetSensing, Purpose::kTargetClutter)))
  {
    if (!counts(robot, sensor, blobView(scenario_), seen, places)) continue;
    Target& target = targets_.at(seen.object);
    rows.push_back(row(robot, sensor, seen, places.at(seen.object), target.at));
    target.begun = true;
  }
}

void BoundRecursion::scanMates(int robot, Rows& rows) const
{
  const SensorSetup& sensor = *scenario_.mateSensor;
  const auto mates = bodies_.matesOf(robot);
  for (const Seen& seen : sense(sensor, bodies_.robot(robot), mates,
                                keys(robot, Purpose::kMateSensing, Purpose::kMateClutter)))
  {
    const auto mate = static_cast<std::size_t>(seen.object);
    if (!counts(robot, sensor, blobView(scenario_), seen, mates) || mate >= robots_.size())
      continue;
    rows.push_back(row(robot, sensor, seen, mates.at(seen.object), robots_[mate].at));
  }
}

// What was drawn is the sighting less what is true.  Of a law with tails the bound takes what it
// tells: a noise as large as the Fisher information says, and for what was drawn the score.
BoundRecursion::Noise BoundRecursion::noiseOf(int robot, const SensorSetup& sensor,
                                              const Seen& seen, const Point2D& point) const
{
  const Pose2D& pose = bodies_.robot(robot);
  const Vector2 truth = RangeBearing::predict(pose, point), z(seen.range, seen.bearing);
  Noise out{{sensor.rangeStd * sensor.rangeStd, sensor.bearingStd * sensor.bearingStd},
            RangeBearing::residual(z, truth)};
  if (const double std = sensor.positionStd; std > 0)
  {
    const Point2D off = RangeBearing::invert(pose, z) - point;
    out.variance = Vector2(std * std, std * std / (truth[0] * truth[0]));
    out.drawn = RangeBearing::jacobians(pose, point).point * Vector2(off.x, off.y);
  }
  const auto score = scores_.find(&sensor);
  if (score == scores_.end()) return out;
  const Vector2 squares = out.drawn.cwiseAbs2().cwiseQuotient(out.variance);
  const double q = sensor.bearingOnly ? squares[1] : squares.sum();
  out.variance /= score->second.information();
  out.drawn *= score->second.inverseFactor(q) / score->second.information();
  return out;
}

// A sighting of a point whose place has the coordinates from `at` on.
JointErrors::Row BoundRecursion::row(int robot, const SensorSetup& sensor, const Seen& seen,
                                     const Point2D& point, int at) const
{
  const auto J = RangeBearing::jacobians(bodies_.robot(robot), point);
  const int first = sensor.bearingOnly ? 1 : 0, count = 2 - first;
  const Noise noise = noiseOf(robot, sensor, seen, point);
  return {{{robots_[std::size_t(robot)].at, J.pose.middleRows(first, count)},
           {at, J.point.middleRows(first, count)}},
          noise.variance.segment(first, count),
          noise.drawn.segment(first, count)};
}

// Of one seen first nothing else is known: its error e is what H_point e + H_pose e_pose = noise
// makes it.
void BoundRecursion::addLandmark(int robot, const Seen& seen)
{
  const SensorSetup& sensor = scenario_.landmarkSensor;
  const Point2D& point = landmarks_.at(seen.object);
  const auto J = RangeBearing::jacobians(bodies_.robot(robot), point);
  const Matrix2 inverse = J.point.inverse();
  const Noise noise = noiseOf(robot, sensor, seen, point);
  const Matrix2 R = noise.variance.asDiagonal();
  landmarkAt_[seen.object] =
      errors_.addFrom({{robots_[std::size_t(robot)].at, -inverse * J.pose}},
                      inverse * R * inverse.transpose(), inverse * noise.drawn);
}
}  // namespace slamot::sim
