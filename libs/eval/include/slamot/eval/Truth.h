#pragma once

#include <slamot/eval/Trajectory.h>

#include <map>
#include <vector>

namespace slamot::eval
{
/// Which true landmark a sighting was of; id -1: clutter.
struct TrueAssociation
{
  double time = 0;  ///< [s]
  int index = 0;    ///< place in that time's list of landmark sightings
  int id = -1;
};

/// The robot's pose at one time as seen from that at another, as found by hand from its scans.
struct Relation
{
  double from = 0, to = 0;  ///< [s]
  Pose2D pose_from_to;
};

/// The ground truth that goes with a log; what is empty is not known.
struct Truth
{
  Trajectory robot;
  std::map<int, Trajectory> targets;
  std::map<int, Point2D> landmarks;
  std::vector<TrueAssociation> associations;  ///< in rising order of (time, index)
  std::vector<Relation> relations;            ///< in any order, both ways round
};
}  // namespace slamot::eval
