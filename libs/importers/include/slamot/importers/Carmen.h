#pragma once

#include <slamot/importers/DrivenNoise.h>
#include <slamot/importers/Import.h>

#include <memory>
#include <optional>
#include <string>

namespace slamot::importers
{
/// How the lasers of a CARMEN log are mounted, and how far its odometry errs.  The defaults of
/// noise were measured on two such logs by matching scans; see doc/importing.md.
struct CarmenOptions
{
  std::optional<Pose2D> mount;      ///< of FLASER, ROBOTLASER1; none: as logged, or the robot's own
  std::optional<Pose2D> rearMount;  ///< of RLASER, ROBOTLASER2; none: as logged, or facing back
  std::optional<double> firstBeam;  ///< of FLASER, RLASER [rad]; none: what their number says
  std::optional<double> beamStep;   ///< likewise
  double maxRange = 80;             ///< from this on a range is no return [m]
  bool odometryLines = false;       ///< poses from ODOM lines, not from the scans' own messages

  DrivenNoise noise{0.07, math::degToRad(3), 0.05, math::degToRad(4.5), 0.1};  ///< of odometry
  std::string relations;  ///< file of reference relations; empty: none
};

/// Opens a log of the Carnegie Mellon Robot Navigation Toolkit, plain or gz.  It is read as it is
/// delivered.
///
/// Each FLASER, RLASER, ROBOTLASER1 or ROBOTLASER2 ends a step, with the odometry since the one
/// before; the first makes a step without odometry.  Times are those of the messages
/// (ipc_timestamp).  Messages that are out of order by up to 1 s are sorted.  PARAM, comments and
/// messages of other sensors are left out; those of unknown kind too, with a warning.  There is no
/// truth but relations.
/// \throws core::Error: kUnreadable (a message too short, what is no number, no scan at all),
/// kNonsense (values that make no sense, times that go back by more), as the tables' reader does.
std::unique_ptr<Import> openCarmen(const std::string& path, const CarmenOptions& options);
}  // namespace slamot::importers
