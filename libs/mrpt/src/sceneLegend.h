#pragma once

#include <slamot/mrpt/mrpt_compat.h>

#include "SceneFrame.h"

namespace slamot::mrpt
{
/// Adds the viewports of a scene's title and legend.
void addLegend(MrptScene& scene, const SceneData& data, const SceneFrame& frame);
}  // namespace slamot::mrpt
