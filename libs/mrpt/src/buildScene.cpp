#include <slamot/mrpt/buildScene.h>

#include "SceneBuilder.h"
#include "planCamera.h"
#include "sceneLegend.h"

#include SLAMOT_SCENE_HEADER

namespace slamot::mrpt
{
slamot_viz::CCamera buildScene(MrptScene& scene, const SceneData& data,
                               const RenderOptions& options)
{
  const SceneFrame frame(data);
  scene.clear();
  SceneBuilder(data, frame).addObjects(scene);
  addLegend(scene, data, frame);
  const auto camera = planCamera({frame.xMin, frame.xMax, frame.yMin, frame.yMax}, options);
  const auto main = scene.getViewport();
  main->setCustomBackgroundColor({1.0f, 1.0f, 1.0f});
  // Room to come nearer and to go away, and yet depth enough to tell layers apart.
  const float far = camera.getZoomDistance();
  main->setViewportClipDistances(far / 20, 5 * far);
  return camera;
}
}  // namespace slamot::mrpt
