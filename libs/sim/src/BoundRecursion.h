#pragma once

#include <slamot/sim/posteriorBound.h>

#include "Bodies.h"
#include "JointErrors.h"
#include "LawScore.h"
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
  using Rows = std::vector<JointErrors::Row>;
  /// Over time or landmarks: the variances, and the squares of the errors drawn.
  struct Squares
  {
    double variance = 0, drawn = 0;
    int count = 0;

    void add(const Squares& other);
    /// Roots of the means.
    [[nodiscard]] PosteriorBound::Figure figure() const;
  };
  struct Robot
  {
    int at = 0;  // its first coordinate
    Squares position, heading;
  };
  struct Target
  {
    int at = 0;
    bool begun = false;  // known at the start, or seen since
    Squares position;
  };

  void addRobot(int index);
  void addTarget(int id, const TargetSetup& setup);
  [[nodiscard]] Eigen::VectorXd startErrors(int id, const StartKnowledge& start,
                                            const Eigen::VectorXd& std) const;
  void move(int at, const Transition& t) { errors_.move(at, t.F, t.Q, t.w); }
  /// Of the coordinates from `at` on.
  [[nodiscard]] Squares squares(int at, int count) const;
  void recordErrors();

  void scan(int robot);
  [[nodiscard]] ScanKeys keys(int robot, Purpose sensing, Purpose clutter) const;
  [[nodiscard]] bool counts(int robot, const SensorSetup& sensor, const core::FieldOfView& fov,
                            const Seen& seen, const std::map<int, Point2D>& objects) const;
  [[nodiscard]] std::vector<Seen> scanLandmarks(int robot, Rows& rows) const;
  void scanTargets(int robot, Rows& rows);
  void scanMates(int robot, Rows& rows) const;
  /// A sighting's noise of (range, bearing) as the bound has it.
  struct Noise
  {
    Vector2 variance, drawn;
  };
  [[nodiscard]] Noise noiseOf(int robot, const SensorSetup& sensor, const Seen& seen,
                              const Point2D& point) const;
  [[nodiscard]] JointErrors::Row row(int robot, const SensorSetup& sensor, const Seen& seen,
                                     const Point2D& point, int at) const;
  void addLandmark(int robot, const Seen& seen);

  const Scenario& scenario_;
  std::uint64_t seed_;
  std::map<int, Point2D> landmarks_;
  Bodies bodies_;
  JointErrors errors_;
  std::vector<Robot> robots_;
  std::map<int, Target> targets_;
  std::map<int, int> landmarkAt_;                  // first coordinates, of those seen
  std::map<const SensorSetup*, LawScore> scores_;  // of the sensors that glint
};
}  // namespace slamot::sim
