#pragma once

#include <slamot/math/geometry.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace slamot::apps
{
/// An option in degrees for a value kept in radians, whose default its help shows.
CLI::Option* addDegrees(CLI::App& command, const std::string& name, double& radians,
                        const std::string& what);

/// An option X,Y,DEG for a pose, given to `set` in metres and radians.
CLI::Option* addPose(CLI::App& command, const std::string& name,
                     std::function<void(const Pose2D&)> set, const std::string& what);

/// "a", "a and b", "a, b and c".
std::string enumerate(const std::vector<std::string>& names);
}  // namespace slamot::apps
