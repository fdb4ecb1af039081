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
  int id = -1;      ///< its landmark, as in Truth::landmarks; -1: clutter
};

/// The robot's pose at one time as seen from that at another, as found by hand from its scans.
struct Relation
{
  double from = 0;      ///< time of the pose that is looked from [s]
  double to = 0;        ///< time of the pose that is looked at [s]
  Pose2D pose_from_to;  ///< the latter in the frame of the former
};

/// The ground truth that goes with a log; what is empty is not known.
struct Truth
{
  Trajectory robot;                           ///< its path
  std::map<int, Trajectory> targets;          ///< their paths, by identity
  std::map<int, Point2D> landmarks;           ///< their places [m], by identity
  std::vector<TrueAssociation> associations;  ///< in rising order of (time, index)
  std::vector<Relation> relations;            ///< in any order, both ways round
};
}  // namespace slamot::eval
