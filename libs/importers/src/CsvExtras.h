#pragma once

#include <slamot/core/Start.h>
#include <slamot/core/Step.h>
#include <slamot/eval/Truth.h>

#include <string>

namespace slamot::importers
{
/// fov.csv; all round without it.
core::FieldOfView readFov(const std::string& folder);

/// start.csv, and that the log starts at time 0.
core::Starts readStarts(const std::string& folder);

/// truth_robot.csv, truth_target_<id>.csv and truth_landmarks.csv, as far as they are there.
eval::Truth readTruth(const std::string& folder);
}  // namespace slamot::importers
