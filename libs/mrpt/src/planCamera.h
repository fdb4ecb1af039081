#pragma once

#include <slamot/mrpt/Scene.h>
#include <slamot/mrpt/mrpt_compat.h>

#include "view.h"

#include SLAMOT_VIZ(CCamera.h)

namespace slamot::mrpt
{
/// A camera that has a piece of ground in view, beside the legend and below the title.
[[nodiscard]] slamot_viz::CCamera planCamera(const Box& ground, const RenderOptions& options);
}  // namespace slamot::mrpt
