#pragma once

#include <slamot/eval/Truth.h>

#include <string>

namespace slamot::importers
{
/// Reads relations between poses of a path, as of Kuemmerle et al., "On measuring the accuracy of
/// SLAM algorithms", 2009: rows `t1 t2 dx dy dz droll dpitch dyaw` [s, m, rad], plain or gz.
/// \throws core::Error as the tables' reader does; kNonsense on a relation out of the plane, or of
/// a time to itself.
[[nodiscard]] std::vector<eval::Relation> readRelations(const std::string& path);
}  // namespace slamot::importers
