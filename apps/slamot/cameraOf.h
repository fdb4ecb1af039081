#pragma once

#include <mrpt/poses/CPose3D.h>
#include <slamot/mrpt/RawlogEditor.h>
#include <slamot/perception/Pipeline.h>

#include <stdexcept>
#include <string>

namespace mrpt::obs
{
class CObservationImage;
}

namespace slamot::apps
{
/// An image that can't be had: its file is missing, or damaged.
struct NoImage : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// The pixels of an image, from the log or from its file in `folder`.  \throws NoImage.
[[nodiscard]] cv::Mat pixelsOf(const mrpt::EditedEntry& entry, const mrpt::SensedEntry& sensed,
                               const std::string& folder);

/// The log's camera; `otherwise`, from the configuration, where the log has none.
[[nodiscard]] perception::Camera cameraOf(const ::mrpt::obs::CObservationImage& observation,
                                          const perception::Camera& otherwise);

/// Where a camera looks.  MRPT's cameras have their z axis ahead and y down; poses with x ahead and
/// z up are met too.  Whichever of y and z is nearer to the vertical says which: cameras on robots
/// are seldom on their side.  \throws NoImage for a pose that is none.
[[nodiscard]] perception::Mount mountOf(const ::mrpt::poses::CPose3D& pose_robot_camera);
}  // namespace slamot::apps
