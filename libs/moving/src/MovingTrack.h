#pragma once

#include <slamot/core/Estimate.h>
#include <slamot/core/Start.h>
#include <slamot/models/PolynomialTarget.h>
#include <slamot/perception/LaserClusters.h>

#include <deque>

#include "Thing.h"

namespace slamot::moving
{
/// What is followed: at first a point, its middle; once it has moved, a box.
class MovingTrack
{
 public:
  MovingTrack(const Thing& thing, double time, const MovingOptions& options);

  /// A target whose start is known; without a heading it is a point until it moves.
  MovingTrack(int id, const core::ObjectStart& start, double time, const MovingOptions& options);

  /// Nobody has looked for it before.
  void expectNow() { unseen_ = 0; }
  void predict(double dt, const MovingOptions& options);
  /// The robot, at a place, moved by an increment with this covariance, in the tracks' axes: what
  /// is seen from it is as uncertain.
  void widen(const Point2D& robot, const Matrix3& cov);
  void see(const Thing& thing, const Look& look, const MovingOptions& options);

  /// What the box would become.  There must be one.
  [[nodiscard]] BoxState fitted(const Thing& thing, const Look& look,
                                const MovingOptions& options) const;

  [[nodiscard]] bool isMoving() const { return id_ != core::kNoId; }
  [[nodiscard]] int id() const { return id_; }
  /// Its returns when it was first seen lately [m].
  [[nodiscard]] const std::vector<Point2D>& before() const { return lately_.front().points; }
  /// All of them, lately.
  [[nodiscard]] std::vector<std::vector<Point2D>> trail() const;
  /// Whether it has gone far enough, to where nothing was or from where nothing is left.
  /// \param vacated part of before() that lies where nothing stands by now.
  [[nodiscard]] bool hasMoved(double vacated, const MovingOptions& options) const;
  void confirm(int id, const MovingOptions& options);

  [[nodiscard]] const std::optional<BoxState>& box() const { return box_; }
  [[nodiscard]] Point2D place() const;
  /// Of its place [m].
  [[nodiscard]] double deviation() const;
  /// Time since it was last seen [s].
  [[nodiscard]] double unseen() const { return unseen_; }
  /// In the tracks' axes.
  [[nodiscard]] core::TargetEstimate estimate(const MovingOptions& options) const;

  int seenThrough = 0;  ///< scans in a row that looked through it

 private:
  models::ConstantVelocityTarget model_;
  models::ConstantVelocityTarget::State point_;
  std::optional<BoxState> box_;
  struct Was
  {
    double time;
    Point2D at;
    double freePart;
    std::vector<Point2D> points;
  };
  std::deque<Was> lately_;  // where it was seen, as a point
  int id_ = core::kNoId;
  bool identified_ = false;
  double lastSeen_ = 0, unseen_ = 0;
};
}  // namespace slamot::moving
