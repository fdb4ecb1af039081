#pragma once

#include <slamot/core/Estimate.h>
#include <slamot/scans/Settings.h>
#include <slamot/scans/returns.h>

#include <memory>

namespace slamot::scans
{
/// The motion over dt [s] of which odometry tells nothing, after `since` [s] of the like.
[[nodiscard]] Gaussian<Pose2D> blindMotion(double since, double dt, const Settings& settings);

/// Localization and mapping by laser scans, a piece at a time: motion, then a scan is matched, then
/// what of it stands still is kept.  A scan is matched with those of the last stretch of path; what
/// is kept becomes nodes of a pose graph, in which loops are closed.  Lu and Milios, "Globally
/// consistent range scan alignment for environment mapping", 1997; Konolige et al., "Efficient
/// sparse pose adjustment for 2D mapping", 2010.
class ScanSlam
{
 public:
  /// The map's frame is the one that `start` is in.
  ScanSlam(const Settings& settings, const Gaussian<Pose2D>& start);
  ~ScanSlam();

  /// Takes in odometry: an increment in the robot's frame.
  void move(const Gaussian<Pose2D>& increment);
  /// Time that odometry tells nothing of [s].
  void wait(double dt);

  /// Puts the robot where its returns lie best on what was seen before.  \returns what came of it,
  /// in the frame of the last keyframe; the robot's pose is pose().
  Match match(const std::vector<Return>& returns);

  /// Keeps a scan, if the robot has moved far enough since the last one kept, and looks for loops.
  /// \param leaveOut by beam: whether it hit something that moves; may be shorter than the beams.
  void insert(const std::vector<Return>& returns, const std::vector<bool>& leaveOut = {});

  /// Where the robot is, in map axes.
  [[nodiscard]] Gaussian<Pose2D> pose() const;

  /// Notes the present place as that of a time [s], for path().
  void note(double time);
  /// The noted places as they are believed now.
  [[nodiscard]] std::vector<core::PathPose> path() const;

  /// What came of scans so far.
  struct Counts
  {
    int matched = 0;    ///< scans that were found in what was seen before
    int unmatched = 0;  ///< scans that were not: the robot went on by odometry
    int keyframes = 0;  ///< scans that were kept
    int loops = 0;      ///< relations that closed a loop
    int refused = 0;    ///< relations taken back, since they contradicted the graph
  };
  /// Since the start.
  [[nodiscard]] const Counts& counts() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};
}  // namespace slamot::scans
