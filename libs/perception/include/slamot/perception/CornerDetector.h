#pragma once

#include <slamot/perception/LandmarkDetector.h>

#include <optional>

namespace slamot::perception
{
/// How straight lines are found in scans.
struct LineOptions
{
  double mostOff = 0.1;      ///< of a return from its line [m]; five deviations part no wall
  int leastPoints = 6;       ///< on a line
  double leastLength = 0.4;  ///< [m]
  double sharpest = 0.7853981633974483;  ///< least angle of a corner [rad]
  double flattest = 2.356194490192345;   ///< largest angle of a corner [rad]
  double maxRange = 20;                  ///< of a corner [m]

  /// Keys max_off_m, min_points, min_length_m, min_angle_deg, max_angle_deg, max_range_m.
  static LineOptions from(core::Params& p);
};

/// A straight wall as it is seen: the line through its returns, by total least squares.
struct LineSegment
{
  Point2D from;          ///< its end at the lesser angle, in the robot's frame [m]
  Point2D to;            ///< its other end, in the robot's frame [m]
  Point2D middle;        ///< mean of its returns, in the robot's frame [m]
  Point2D direction;     ///< from `from` to `to`, of length 1
  double offsetStd = 0;  ///< of the middle, across the line [m]
  double angleStd = 0;   ///< [rad]
  int points = 0;        ///< returns on it

  /// Standard deviation across the line, `along` from its middle [m].
  [[nodiscard]] double stdAt(double along) const;
};

/// The lines of a cluster: split where a return is farthest off the chord (Ramer, Douglas and
/// Peucker), neighbours that are one line merged, fitted, short ones left out; by rising angle.
[[nodiscard]] std::vector<LineSegment> linesOf(const Cluster& cluster, double rangeStd,
                                               const LineOptions& options);

/// Corners of walls: where two neighbouring lines of one cluster meet.
class CornerDetector : public LandmarkDetector
{
 public:
  /// `laser` tells how far returns err.
  CornerDetector(const LineOptions& options, const LaserOptions& laser)
      : options_(options), laser_(laser)
  {
  }
  [[nodiscard]] std::vector<DetectedLandmark> detect(
      const core::LaserScan& scan, const std::vector<Cluster>& clusters) const override;
  [[nodiscard]] double maxRange() const override { return options_.maxRange; }

 private:
  [[nodiscard]] std::optional<DetectedLandmark> cornerOf(const LineSegment& a,
                                                         const LineSegment& b) const;
  LineOptions options_;
  LaserOptions laser_;
};
}  // namespace slamot::perception
