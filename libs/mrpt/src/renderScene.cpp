#include <slamot/core/Error.h>
#include <slamot/mrpt/Scene.h>
#include <slamot/mrpt/mrpt_compat.h>

#include <mrpt/opengl/CFBORender.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "view.h"

#include SLAMOT_SCENE_HEADER
#include SLAMOT_VIZ(CText3D.h)

namespace slamot::mrpt
{
namespace
{
using core::Error;
using core::ExitStatus;
constexpr int kOversampling = 2;  // smooth edges: the software renderer makes none

using Viewport = std::remove_reference_t<decltype(*MrptScene().getViewport())>;
using ::mrpt::img::CImage;

struct Size
{
  int width, height;
};

/// The ground that a scene covers: its grid's, or that of all there is.
Box groundOf(MrptScene& scene)
{
  const auto grid = scene.getViewport()->getByName("grid");
  const auto box = grid ? grid->getBoundingBox() : scene.getBoundingBox();
  return {box.min.x, box.max.x, box.min.y, box.max.y};
}

slamot_viz::CCamera cameraFor(const Box& ground, const RenderOptions& options)
{
  CameraView view;
  view.elevation = math::degToRad(options.fromAbove ? 90 : 60);
  view.opening = options.fromAbove ? 0 : math::degToRad(30);
  view = fitted(view, static_cast<double>(options.width) / options.height, ground);
  slamot_viz::CCamera camera;
  camera.setPointingAt(view.x, view.y, 0);
  camera.setAzimuthDegrees(-90);
  camera.setElevationDegrees(math::radToDeg(view.elevation));
  camera.setProjectiveModel(!options.fromAbove);
  camera.setProjectiveFOVdeg(30);
  const double shorter = std::min(1.0, static_cast<double>(options.width) / options.height);
  camera.setZoomDistance(static_cast<float>(
      options.fromAbove ? kOrthogonalZoom * view.span * shorter : view.distance()));
  return camera;
}

/// A viewport as a picture of its own: the renderer would use one camera for all viewports.
CImage draw(Viewport& view, const slamot_viz::CCamera& camera, const Size& size)
{
  MrptScene alone;
  for (const auto& object : view)
    if (!std::dynamic_pointer_cast<slamot_viz::CCamera>(object)) alone.insert(object);
  // The default planes, 0.01 m to 10 km, leave too little depth to tell layers apart.
  const float far = camera.getZoomDistance();
  alone.getViewport()->setViewportClipDistances(far / 4, 3 * far);
  alone.getViewport()->setCustomBackgroundColor({1.0f, 1.0f, 1.0f});
  // MRPT reads rows of a length that is no multiple of four bytes past the picture's end.
  const auto rows = static_cast<unsigned>(kOversampling * size.height);
  const auto columns = static_cast<unsigned>(kOversampling * (size.width + size.width % 2));
  ::mrpt::opengl::CFBORender renderer(columns, rows);
  SLAMOT_SET_CAMERA(renderer, alone, camera);
  CImage large, picture;
  renderer.render_RGB(alone, large);
  large.scaleImage(picture, static_cast<unsigned>(size.width), static_cast<unsigned>(size.height),
                   ::mrpt::img::IMG_INTERP_AREA);
  return picture;
}

/// Where the longest text of a viewport ends; MRPT's bounding boxes of texts are too small.
double textsEnd(Viewport& view)
{
  constexpr double kLetter = 0.4;
  double end = 0;
  for (const auto& object : view)
    if (const auto text = std::dynamic_pointer_cast<slamot_viz::CText3D>(object))
      end = std::max(end,
                     text->getPose().x + kLetter * static_cast<double>(text->getString().size()));
  return end;
}

/// Puts an overlay, such as the legend, to its place.
void drawOverlay(CImage& picture, Viewport& view, const Size& whole)
{
  const auto saved = view.getByClass<slamot_viz::CCamera>();
  if (!saved) return;
  double x, y, width, height;
  view.getViewportPosition(x, y, width, height);
  const auto pixels = [](double part, int of) { return static_cast<int>(std::lround(part * of)); };
  const Size size{pixels(width, whole.width), pixels(height, whole.height)};
  // The saved camera suits most windows; this one is made for this picture's proportions.
  const double aspect = static_cast<double>(size.width) / size.height;
  const double across = textsEnd(view) - kOverlayLeft;
  const double shown = std::max(saved->getZoomDistance() / kOrthogonalZoom, across / aspect);
  slamot_viz::CCamera camera = *saved;
  camera.setZoomDistance(static_cast<float>(kOrthogonalZoom * shown * std::min(1.0, aspect)));
  camera.setPointingAt(kOverlayLeft + shown * aspect / 2, saved->getPointingAtY(), 0);
  picture.drawImage(pixels(x, whole.width), pixels(1 - y - height, whole.height),
                    draw(view, camera, size));
}

CImage drawAll(MrptScene& scene, const RenderOptions& options)
{
  const Size size{options.width, options.height};
  CImage picture = draw(*scene.getViewport(), cameraFor(groundOf(scene), options), size);
  for (const char* name : {"title", "legend"})
    if (const auto view = scene.getViewport(name)) drawOverlay(picture, *view, size);
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
    picture = drawAll(scene, options);
  }
  catch (const std::exception& e)
  {
    throw Error(ExitStatus::kInternal, "OpenGL", e.what(), "install libegl1 and libgl1-mesa-dri");
  }
  const std::string partial = pngPath + ".part.png";
  std::error_code error;
  if (!picture.saveToFile(partial) || (std::filesystem::rename(partial, pngPath, error), error))
    throw Error(ExitStatus::kUnreadable, pngPath, "can't be written", "choose another place");
}
}  // namespace slamot::mrpt
