#pragma once

#include <slamot/mrpt/Renderer.h>

#include <map>

#include "savedRun.h"

namespace slamot::apps
{
/// A run as moments that can be drawn.  Of the map, files hold the end only: a landmark stands
/// where it will be at the end, from its first sighting on, or, where most sightings were of
/// landmarks that the map no longer holds, from the start.
class Story
{
 public:
  /// \param run must outlive it.
  explicit Story(const SavedRun& run);

  /// All of it: what moments' pictures have in common.
  [[nodiscard]] const mrpt::SceneData& whole() const { return whole_; }
  /// From the first row to the last [s].
  [[nodiscard]] double duration() const;
  /// The last row that is not after a time [s, from the first row].
  [[nodiscard]] std::size_t rowAt(double time) const;
  [[nodiscard]] mrpt::Moment at(std::size_t row) const;

 private:
  struct LaserPoint
  {
    std::size_t row;
    Point2D point;
  };

  void collectLandmarks();
  void collectErrors();
  void collectLaserPoints();
  [[nodiscard]] double timeOf(std::size_t row) const;
  [[nodiscard]] std::vector<Point2D> scanAt(std::size_t row) const;
  [[nodiscard]] std::vector<mrpt::Polyline> sightingsAt(std::size_t row,
                                                        const mrpt::SceneData& scene) const;
  [[nodiscard]] std::string captionAt(std::size_t row) const;
  [[nodiscard]] Pose2D lookedAt(std::size_t row) const;

  const SavedRun& run_;
  mrpt::SceneData whole_;
  std::map<int, std::size_t> landmarks_;  // by id, their places in the record
  std::map<int, double> firstSeen_;       // of landmarks, by id [s]
  std::map<std::size_t, double> errors_;  // of the robot's position [m], by row
  std::vector<LaserPoint> points_;        // no two at one place; in order of time
};

/// The moments of a film, `step` seconds of the run apart, from its start to its end: the row of
/// each.
[[nodiscard]] std::vector<std::size_t> momentsOf(const Story& story, double step);
}  // namespace slamot::apps
