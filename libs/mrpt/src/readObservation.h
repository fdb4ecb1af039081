#pragma once

#include "Entry.h"

#include <mrpt/obs/CObservation.h>
#include <slamot/core/Step.h>
#include <slamot/mrpt/RawlogSource.h>

namespace mrpt::obs
{
class CObservation2DRangeScan;
}

namespace slamot::mrpt
{
/// Adds what an observation saw to a step, in the robot's frame: landmark sightings, blobs and
/// laser scans.  Sightings at or below range zero or out of the sensor's view are counted in
/// step.dropped. \return whether it was of a class that steps hold. \throws core::Error (kNonsense)
/// for a value that makes no sense; names the entry.
bool addObservation(core::Step& step, const ::mrpt::obs::CObservation& observation,
                    const Entry& entry, const RawlogSource::SensorDeviations& otherwise);

/// A laser's scan, counter-clockwise in the robot's plane, whichever way the sensor turns or is
/// mounted.  \throws core::Error (kNonsense); names the entry.
[[nodiscard]] std::shared_ptr<const core::LaserScan> laserScanOf(
    const ::mrpt::obs::CObservation2DRangeScan& observation, const Entry& entry);
}  // namespace slamot::mrpt
