#include <slamot/core/Error.h>
#include <slamot/mrpt/Renderer.h>

#include "Canvas.h"
#include "openGlError.h"
#include "planCamera.h"

namespace slamot::mrpt
{
namespace
{
using core::Error;
using core::ExitStatus;
using ::mrpt::img::CImage;

/// The ground that a scene covers: its grid's, or that of all there is.
Box groundOf(MrptScene& scene)
{
  const auto grid = scene.getViewport()->getByName("grid");
  const auto box = grid ? grid->getBoundingBox() : scene.getBoundingBox();
  return {box.min.x, box.max.x, box.min.y, box.max.y};
}

CImage draw(MrptScene& scene, const RenderOptions& options)
{
  const Size size{options.width, options.height};
  const auto overlays = drawOverlays(scene, size);
  const slamot_viz::CCamera camera = planCamera(groundOf(scene), options);
  MrptScene alone;
  for (const auto& object : *scene.getViewport())
    if (!std::dynamic_pointer_cast<slamot_viz::CCamera>(object)) alone.insert(object);
  const float far = camera.getZoomDistance();
  CImage picture = Canvas(size).draw(alone, camera, far / 4, 3 * far);
  paste(picture, overlays);
  return picture;
}
}  // namespace

void renderScene(const std::string& scenePath, const std::string& pngPath,
                 const RenderOptions& options)
{
  MrptScene scene;
  if (!scene.loadFromFile(scenePath))
    throw Error(ExitStatus::kUnreadable, scenePath, "is not a scene that can be read",
                "give a result folder or a .3Dscene file");
  CImage picture;
  try
  {
    picture = draw(scene, options);
  }
  catch (const std::exception& e)
  {
    throw openGlError(e);
  }
  savePng(pngPath, picture);
}
}  // namespace slamot::mrpt
