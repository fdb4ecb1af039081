#pragma once

#include <slamot/mrpt/Renderer.h>

#include <map>

#include "savedRun.h"

namespace slamot::apps
{
/// A result as moments that can be drawn, one a row.
class Story
{
 public:
  virtual ~Story() = default;
  /// All of it: what moments' pictures have in common.
  [[nodiscard]] virtual const mrpt::SceneData& whole() const = 0;
  /// From the first row to the last [s].
  [[nodiscard]] virtual double duration() const = 0;
  /// The last row that is not after a time [s, from the first row].
  [[nodiscard]] virtual std::size_t rowAt(double time) const = 0;
  [[nodiscard]] virtual mrpt::Moment at(std::size_t row) const = 0;
};

/// One robot's run.  Of the map, files hold the end only: a landmark stands where it will be at the
/// end, from its first sighting on, or, where most sightings were of landmarks that the map no
/// longer holds, from the start.
class RobotStory : public Story
{
 public:
  /// \param run must outlive it.
  explicit RobotStory(const SavedRun& run);

  [[nodiscard]] const mrpt::SceneData& whole() const override { return whole_; }
  [[nodiscard]] double duration() const override;
  [[nodiscard]] std::size_t rowAt(double time) const override;
  [[nodiscard]] mrpt::Moment at(std::size_t row) const override;

  /// Of the robot's position in a row [m]; none without truth for it.
  [[nodiscard]] std::optional<double> errorAt(std::size_t row) const;

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
