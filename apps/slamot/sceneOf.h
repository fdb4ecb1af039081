#pragma once

#include <slamot/mrpt/Scene.h>
#include <slamot/results/Figures.h>

namespace slamot::apps
{
/// A run as what saveScene() draws, in the map's frame: truth is moved there as for the errors.
/// \param particles the filter's at the end, if it has any.
[[nodiscard]] mrpt::SceneData sceneOf(const std::string& title, const results::RunView& run,
                                      std::vector<core::WeightedPose> particles);

/// What is known of paths, targets and truth up to a row of the record: no map, no scans.
[[nodiscard]] mrpt::SceneData sceneUntil(const std::string& title, const results::RunView& run,
                                         std::size_t lastRow);
}  // namespace slamot::apps
