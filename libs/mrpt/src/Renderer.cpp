#include <slamot/mrpt/Renderer.h>

#include "Canvas.h"
#include "SceneBuilder.h"
#include "openGlError.h"
#include "planCamera.h"
#include "saveWhole.h"
#include "sceneLegend.h"

namespace slamot::mrpt
{
namespace
{
using ::mrpt::img::CImage;

// Near by, marks of a hundredth of the map would be far too large.
constexpr double kFollowShrink = 0.5;
constexpr double kFollowDistance = 80;  // [in the frame's unit, shrunk]

SceneFrame frameOf(const SceneData& whole, const RenderOptions& options)
{
  SceneFrame frame(whole);
  if (options.view == View::kFollow) frame.unit *= kFollowShrink;
  return frame;
}

slamot_viz::CCamera followCamera(const Pose2D& at, double unit)
{
  const double ahead = 10 * unit;  // more room before the robot than behind it
  slamot_viz::CCamera camera;
  camera.setPointingAt(at.x + ahead * std::cos(at.phi), at.y + ahead * std::sin(at.phi), 0);
  camera.setAzimuthDegrees(math::radToDeg(math::wrapToPi(at.phi + math::kPi)));
  camera.setElevationDegrees(35);
  camera.setProjectiveModel(true);
  camera.setProjectiveFOVdeg(45);
  camera.setZoomDistance(static_cast<float>(kFollowDistance * unit));
  return camera;
}

void addCaption(MrptScene& scene, const std::string& text, const Size& size)
{
  slamot_viz::TFontParams font;
  font.vfont_name = "sans";
  font.vfont_scale = static_cast<float>(kOversampling * std::min(size.width, size.height)) / 45;
  font.color = ::mrpt::img::TColorf(0.14f, 0.16f, 0.18f, 1.0f);
  scene.getViewport()->addTextMessage(0.015, 0.02, text, 0, font);
}
}  // namespace

struct Renderer::Parts
{
  RenderOptions options;
  SceneFrame frame;
  std::vector<Patch> overlays;
  Canvas canvas;  // after the overlays: theirs are gone by then

  Parts(const SceneData& whole, const RenderOptions& o)
      : options(o),
        frame(frameOf(whole, o)),
        overlays(drawLegend(whole)),
        canvas({o.width, o.height})
  {
  }
  [[nodiscard]] std::vector<Patch> drawLegend(const SceneData& whole) const
  {
    MrptScene scene;
    addLegend(scene, whole, frame);
    return drawOverlays(scene, {options.width, options.height});
  }
  [[nodiscard]] bool follows() const { return options.view == View::kFollow; }
};

Renderer::Renderer(const SceneData& whole, const RenderOptions& options)
try : parts_(std::make_unique<Parts>(whole, options))
{
}
catch (const std::exception& e)
{
  throw openGlError(e);
}

Renderer::~Renderer() = default;

CImage Renderer::draw(const Moment& moment)
{
  Parts& p = *parts_;
  MrptScene scene;
  SceneBuilder(moment.scene, p.frame).addObjects(scene);
  addCaption(scene, moment.caption, {p.options.width, p.options.height});
  const slamot_viz::CCamera camera =
      p.follows() ? followCamera(moment.lookedAt, p.frame.unit)
                  : planCamera({p.frame.xMin, p.frame.xMax, p.frame.yMin, p.frame.yMax}, p.options);
  const float far = camera.getZoomDistance();
  try
  {
    CImage picture =
        p.canvas.draw(scene, camera, far / (p.follows() ? 10 : 4), (p.follows() ? 12 : 3) * far);
    paste(picture, p.overlays);
    return picture;
  }
  catch (const std::exception& e)
  {
    throw openGlError(e);
  }
}

void savePng(const std::string& path, const CImage& picture)
{
  saveWhole(path, [&](const std::string& file) { return picture.saveToFile(file); });
}
}  // namespace slamot::mrpt
