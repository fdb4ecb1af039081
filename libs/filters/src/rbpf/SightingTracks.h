#pragma once

#include "sighting/Matching.h"
#include "sighting/Sighting.h"

#include <slamot/math/gaussian.h>

namespace slamot::filters::rbpf
{
/// Which sightings of successive scans are of one thing, whatever it is: seen from the robot, a
/// thing at rest moves as the odometry says, so that neighbours are told apart which the map, less
/// exact than the sensor from scan to scan, can't.  One list serves all particles.
class SightingTracks
{
 public:
  struct Settings
  {
    double rangeStd = 0, bearingStd = 0;  ///< [m, rad] of a sighting against the last one; 0: off
  };
  explicit SightingTracks(const Settings& s) : settings_(s) {}

  [[nodiscard]] bool isOn() const { return settings_.rangeStd > 0 && settings_.bearingStd > 0; }
  void move(const Gaussian<Pose2D>& increment);
  /// Gives each sighting a track, one of those before or a new one.
  void link(const std::vector<Ray>& rays, double time);

  [[nodiscard]] std::size_t capacity() const { return tracks_.size(); }
  /// Place of a sighting's track, below capacity(); places of ended tracks are given anew.
  [[nodiscard]] std::size_t place(std::size_t sighting) const { return places_[sighting]; }
  /// Sightings of the track so far, this one included.
  [[nodiscard]] int hits(std::size_t sighting) const { return tracks_[places_[sighting]].hits; }

 private:
  struct Track
  {
    Point2D at;  // in the robot's frame
    Matrix2 cov = Matrix2::Zero();
    double seen = 0;
    int hits = 0;  // 0: a free place
  };
  [[nodiscard]] Gaussian<Point2D> pointOf(const Ray& ray) const;

  Settings settings_;
  std::vector<Track> tracks_;
  std::vector<std::size_t> places_;
  std::vector<Candidate> candidates_;
  std::vector<std::int32_t> matches_;
};
}  // namespace slamot::filters::rbpf
