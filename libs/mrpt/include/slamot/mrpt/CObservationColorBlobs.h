#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/poses/CPose3D.h>
#include <slamot/mrpt/mrpt_compat.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace slamot::obs
{
/// \cond
namespace mrpt = ::mrpt;  // MRPT's macros say `mrpt::`, which slamot::mrpt would hide
/// \endcond

// MRPT's Visualizable has a public destructor that is not virtual; nobody deletes through it.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wnon-virtual-dtor"

/// A camera's colour blobs: targets and team mates, seen as patches of a known colour.  An empty
/// list is a look that saw none.  Directions are in the sensor's frame: bearing positive to the
/// left, elevation positive upwards.
class CObservationColorBlobs : public ::mrpt::obs::CObservation, public slamot_viz::Visualizable
{
  DEFINE_SERIALIZABLE(CObservationColorBlobs, slamot::obs)

 public:
  static constexpr std::uint32_t kMostBlobs = 10000;   ///< in one observation, when read back
  static constexpr std::uint32_t kLongestLabel = 255;  ///< [bytes]

  /// One patch of a known colour.
  struct Blob
  {
    std::string label;            ///< what the colour stands for: "target", "robot", ...
    std::int32_t id = -1;         ///< identity; -1: the sensor can't tell
    double centerX = 0;           ///< [pixel], from the image's left
    double centerY = 0;           ///< [pixel], from the image's top
    double boxLeft = 0;           ///< bounding box [pixel]
    double boxTop = 0;            ///< [pixel]
    double boxWidth = 0;          ///< [pixel]; 0: no image behind it
    double boxHeight = 0;         ///< [pixel]
    double area = 0;              ///< [pixel²]
    double bearing = 0;           ///< [rad]
    double bearingStd = 0;        ///< [rad]
    double elevation = 0;         ///< [rad]
    double elevationStd = 0;      ///< [rad]
    std::optional<double> range;  ///< [m], along the line of sight; absent: not ranged
    double rangeStd = 0;          ///< [m]; meaningless without a range
    bool cut = false;             ///< by the image's edge: part of the thing may be outside
  };

  ::mrpt::poses::CPose3D sensorPoseOnRobot;       ///< its x axis is the line of sight
  double rangeMin = 0;                            ///< where a blob is detected [m]
  double rangeMax = 1e6;                          ///< [m]
  double bearingMin = -3.14159265358979323846;    ///< field of view [rad]
  double bearingMax = 3.14159265358979323846;     ///< [rad]
  double elevationMin = -1.57079632679489661923;  ///< field of view [rad]
  double elevationMax = 1.57079632679489661923;   ///< [rad]
  std::vector<Blob> blobs;                        ///< empty: it looked and saw none

  SLAMOT_GET_SENSOR_POSE(sensorPoseOnRobot)
  /// Of the sensor, in the robot's frame.
  void setSensorPose(const ::mrpt::poses::CPose3D& pose) override { sensorPoseOnRobot = pose; }

  /// What RawLogViewer prints beside it.
  void getDescriptionAsText(std::ostream& o) const override;

  /// rawlog-edit --export-txt: one row an observation; the blobs' columns repeat for each blob.
  bool exportTxtSupported() const override { return true; }
  /// Names of the columns, for one blob.
  std::string exportTxtHeader() const override;
  /// The columns of this observation.
  std::string exportTxtDataRow() const override;

  /// What RawLogViewer shows: the sensor, ranged blobs as balls, others as rays.
  void getVisualizationInto(slamot_viz::CSetOfObjects& o) const override;
};
#pragma GCC diagnostic pop
}  // namespace slamot::obs
