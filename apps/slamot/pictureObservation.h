#pragma once

#include <mrpt/obs/CObservation.h>
#include <slamot/sim/RawSensors.h>

#include <memory>

#include "ImagesBeside.h"

namespace slamot::apps
{
/// A simulated image as MRPT's CObservationImage, with its camera.
/// \param beside where it goes as PNG; null: into the log, as JPEG.
/// \throws core::Error (kUnreadable) if a file can't be written.
[[nodiscard]] std::shared_ptr<::mrpt::obs::CObservation> pictureObservation(
    const sim::Picture& picture, const sim::CameraSetup& camera, double time,
    const ImagesBeside* beside);
}  // namespace slamot::apps
