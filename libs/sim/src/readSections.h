#pragma once

#include <slamot/core/Params.h>
#include <slamot/sim/Scenario.h>

/// A scenario's sections, one by one.  All \throw core::Error (kConfig).
namespace slamot::sim
{
StartKnowledge readStartKnowledge(core::Params& p, const Motion& motion);

/// [robot], or [robot_0], [robot_1], ... without a gap.
std::vector<RobotSetup> readRobots(core::Config& config, const Area& area,
                                   const std::map<int, TargetSetup>& targets);

/// Of [world].
LandmarkSetup readLandmarks(core::Params& p, const std::vector<RobotSetup>& robots);

SensorSetup readLandmarkSensor(core::Config& config);
/// Absent without [target_sensor] if nothing needs it.
std::optional<SensorSetup> readTargetSensor(core::Config& config, bool isNeeded);
/// Absent without [mate_sensor].
std::optional<SensorSetup> readMateSensor(core::Config& config);

/// The number n of section `prefix`n; none for other names.
std::optional<int> numberOf(const std::string& section, const std::string& prefix);
}  // namespace slamot::sim
