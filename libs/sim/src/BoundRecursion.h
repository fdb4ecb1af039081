#pragma once

#include <slamot/sim/posteriorBound.h>

#include "Bodies.h"
#include "JointCovariance.h"
#include "Sensor.h"

#include <utility>

namespace slamot::sim
{
/// The recursion of posteriorBound(), step by step.
class BoundRecursion
{
 public:
  BoundRecursion(const Scenario& scenario, std::uint64_t seed, int robots);

  void step();
  [[nodiscard]] std::size_t landmarksSeen() const { return landmarkAt_.size(); }
  [[nodiscard]] PosteriorBound result() const;

 private:
  using Rows = std::vector<JointCovariance::Row>;
  struct MeanSquare
  {
    double sum = 0;
    int count = 0;

    void add(double square) { sum += square, ++count; }
    [[nodiscard]] double root() const;
  };
  struct Robot
  {
    int at = 0;  // its first coordinate
    MeanSquare position, heading;
  };
  struct Target
  {
    int at = 0;
    bool begun = false;  // known at the start, or seen since
    MeanSquare position;
  };

  void addRobot(int index);
  void addTarget(int id, const TargetSetup& setup);
  void move(int at, const Transition& t) { covariance_.move(at, t.F, t.Q); }
  [[nodiscard]] double placeVariance(int at) const;
  void recordErrors();

  void scan(int robot);
  [[nodiscard]] ScanKeys keys(int robot, Purpose sensing, Purpose clutter) const;
  [[nodiscard]] bool counts(int robot, const SensorSetup& sensor, const core::FieldOfView& fov,
                            const Seen& seen, const std::map<int, Point2D>& objects) const;
  [[nodiscard]] std::vector<int> scanLandmarks(int robot, Rows& rows) const;
  void scanTargets(int robot, Rows& rows);
  void scanMates(int robot, Rows& rows) const;
  [[nodiscard]] JointCovariance::Row row(int robot, const SensorSetup& sensor, const Point2D& point,
                                         int at) const;
  void addLandmark(int robot, int id);

  const Scenario& scenario_;
  std::uint64_t seed_;
  std::map<int, Point2D> landmarks_;
  Bodies bodies_;
  JointCovariance covariance_;
  std::vector<Robot> robots_;
  std::map<int, Target> targets_;
  std::map<int, int> landmarkAt_;  // first coordinates, of those seen
};
}  // namespace slamot::sim
