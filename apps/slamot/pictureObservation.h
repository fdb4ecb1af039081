#pragma once

#include <mrpt/obs/CObservation.h>
#include <slamot/sim/RawSensors.h>

#include <memory>
#include <string>

namespace slamot::apps
{
/// Where a log's images go.
enum class ImagesGo
{
  kInside,  ///< as JPEG
  kBeside   ///< as PNG, to <log>_Images, where MRPT's tools look for them
};

/// A simulated image as MRPT's CObservationImage, with its camera.
/// \param log the log's path.  \throws core::Error (kUnreadable) if a file can't be written.
[[nodiscard]] std::shared_ptr<::mrpt::obs::CObservation> pictureObservation(
    const sim::Picture& picture, const sim::CameraSetup& camera, double time,
    const std::string& log, ImagesGo where);
}  // namespace slamot::apps
