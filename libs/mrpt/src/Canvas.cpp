#include "Canvas.h"

#include <algorithm>
#include <cmath>

#include "view.h"

#include SLAMOT_VIZ(CText3D.h)

namespace slamot::mrpt
{
namespace
{
using ::mrpt::img::CImage;
using Viewport = std::remove_reference_t<decltype(*MrptScene().getViewport())>;

// MRPT reads rows of a length that is no multiple of four bytes past the picture's end.
unsigned columns(const Size& s)
{
  return static_cast<unsigned>(kOversampling * (s.width + s.width % 2));
}
unsigned rows(const Size& s)
{
  return static_cast<unsigned>(kOversampling * s.height);
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

Patch drawOverlay(Viewport& view, const slamot_viz::CCamera& saved, const Size& whole)
{
  double x, y, width, height;
  view.getViewportPosition(x, y, width, height);
  const auto pixels = [](double part, int of) { return static_cast<int>(std::lround(part * of)); };
  const Size size{pixels(width, whole.width), pixels(height, whole.height)};
  // The saved camera suits most windows; this one is made for this picture's proportions.
  const double aspect = static_cast<double>(size.width) / size.height;
  const double across = textsEnd(view) - kOverlayLeft;
  const double shown = std::max(saved.getZoomDistance() / kOrthogonalZoom, across / aspect);
  slamot_viz::CCamera camera = saved;
  camera.setZoomDistance(static_cast<float>(kOrthogonalZoom * shown * std::min(1.0, aspect)));
  camera.setPointingAt(kOverlayLeft + shown * aspect / 2, saved.getPointingAtY(), 0);
  // The renderer would use one camera for all viewports: this one becomes a scene of its own.
  MrptScene alone;
  for (const auto& object : view)
    if (!std::dynamic_pointer_cast<slamot_viz::CCamera>(object)) alone.insert(object);
  const float far = camera.getZoomDistance();
  return {Canvas(size).draw(alone, camera, far / 4, 3 * far), pixels(x, whole.width),
          pixels(1 - y - height, whole.height)};
}
}  // namespace

Canvas::Canvas(const Size& size) : size_(size), renderer_(columns(size), rows(size)) {}

CImage Canvas::draw(MrptScene& scene, const slamot_viz::CCamera& camera, float near, float far)
{
  // The default planes, 0.01 m to 10 km, leave too little depth to tell layers apart.
  scene.getViewport()->setViewportClipDistances(near, far);
  scene.getViewport()->setCustomBackgroundColor({1.0f, 1.0f, 1.0f});
  SLAMOT_SET_CAMERA(renderer_, scene, camera);
  CImage large, picture;
  renderer_.render_RGB(scene, large);
  large.scaleImage(picture, static_cast<unsigned>(size_.width), static_cast<unsigned>(size_.height),
                   ::mrpt::img::IMG_INTERP_AREA);
  return picture;
}

std::vector<Patch> drawOverlays(MrptScene& scene, const Size& picture)
{
  std::vector<Patch> patches;
  for (const char* name : {"title", "legend"})
    if (const auto view = scene.getViewport(name))
      if (const auto camera = view->getByClass<slamot_viz::CCamera>())
        patches.push_back(drawOverlay(*view, *camera, picture));
  return patches;
}

void paste(CImage& picture, const std::vector<Patch>& patches)
{
  for (const Patch& p : patches) picture.drawImage(p.x, p.y, p.picture);
}
}  // namespace slamot::mrpt
