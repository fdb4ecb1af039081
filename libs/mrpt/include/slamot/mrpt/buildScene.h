#pragma once

#include <slamot/mrpt/Scene.h>
#include <slamot/mrpt/mrpt_compat.h>

#include SLAMOT_VIZ(CCamera.h)

namespace slamot::mrpt
{
/// Makes a scene of MRPT's, such as a window's, that of the data, with title and legend.
/// \return a camera that has all of it in view.
slamot_viz::CCamera buildScene(MrptScene& scene, const SceneData& data,
                               const RenderOptions& options);
}  // namespace slamot::mrpt
