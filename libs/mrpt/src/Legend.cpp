#include "Legend.h"

#include "view.h"

#include <algorithm>

#include SLAMOT_SCENE_HEADER
#include SLAMOT_VIZ(CText3D.h)

namespace slamot::mrpt
{
namespace
{
using Viewport = std::remove_reference_t<decltype(*MrptScene().getViewport())>;

constexpr double kRow = 0.042;  // a line's height, as a part of the window's

slamot_viz::CText3D::Ptr textAt(const std::string& text, double x, double y)
{
  auto object = slamot_viz::CText3D::Create(text, "sans", 0.5f);
  object->setTextKerning(0.02);
  object->setColor_u8(0x24, 0x29, 0x2f);
  object->setLocation(x, y - 0.2, 0);
  object->setName("text: " + text);
  return object;
}

/// Where a viewport lies in the window, as parts of it, and what its camera, from above, shows.
struct Overlay
{
  double x = 0, width = 1, height = 0.1;
  double left = 0, top = 0, bottom = 0;
};

Viewport& addOverlay(MrptScene& scene, const std::string& name, const Overlay& o)
{
  auto view = scene.createViewport(name);
  view->setViewportPosition(o.x, 1 - o.height, o.width, o.height);
  view->setTransparent(true);
  // How wide it is, and so where its left border is, depends on the window: taken for 4:3.
  const double shown = o.top - o.bottom, across = shown * o.width / o.height * 4 / 3;
  auto camera = slamot_viz::CCamera::Create();
  camera->setPointingAt(o.left + across / 2, (o.top + o.bottom) / 2, 0);
  camera->setZoomDistance(static_cast<float>(kOrthogonalZoom * shown));
  camera->setAzimuthDegrees(-90);
  camera->setElevationDegrees(90);
  camera->setProjectiveModel(false);
  view->insert(camera);
  return *view;
}
}  // namespace

Legend::Legend(MrptScene& scene, const std::string& title) : scene_(scene), title_(title) {}

Mesh& Legend::add(const std::string& text, const ::mrpt::img::TColor& colour)
{
  entries_.push_back({text, Mesh(colour)});
  return entries_.back().mark;
}

void Legend::line(const std::string& text, const ::mrpt::img::TColor& colour)
{
  Mesh& mark = add(text, colour);
  mark.ribbon({{0, y()}, {1.2, y()}}, 0.18, 0);
}

void Legend::thinLine(const std::string& text, const ::mrpt::img::TColor& colour)
{
  Mesh& mark = add(text, colour);
  mark.ribbon({{0, y()}, {1.2, y()}}, 0.07, 0);
}

void Legend::ellipse(const std::string& text, const ::mrpt::img::TColor& colour)
{
  Mesh& mark = add(text, colour);
  Gaussian<Point2D> g;
  g.mean = {0.6, y()};
  g.cov = Vector2(0.035, 0.012).asDiagonal();
  mark.ellipse(g, 0.06, 0);
}

void Legend::dots(const std::string& text, const ::mrpt::img::TColor& colour)
{
  constexpr double kDots[][2] = {
      {0.15, 0.1}, {0.4, -0.12}, {0.62, 0.14}, {0.85, -0.05}, {1.1, 0.08}};
  Mesh& mark = add(text, colour);
  for (const auto& d : kDots)
    mark.sheet({d[0] - 0.06, y() + d[1] - 0.06}, {d[0] + 0.06, y() + d[1] + 0.06}, 0);
}

void Legend::cross(const std::string& text, const ::mrpt::img::TColor& colour)
{
  Mesh& mark = add(text, colour);
  mark.cross({0.6, y()}, 0.3, 0.08, 0);
}

void Legend::finish()
{
  const double rows = static_cast<double>(entries_.size());
  Viewport& lines = addOverlay(
      scene_, "legend",
      {1 - kLegendPart, kLegendPart, kRow * (rows + 1), kOverlayLeft, -0.25, -rows - 1.25});
  for (std::size_t i = 0; i < entries_.size(); ++i)
  {
    lines.insert(entries_[i].mark.object("legend: " + entries_[i].text));
    lines.insert(textAt(entries_[i].text, 1.6, -static_cast<double>(i + 1)));
  }
  Viewport& head =
      addOverlay(scene_, "title", {0, 1 - kLegendPart, kTitlePart, kOverlayLeft, 0.6, -0.6});
  head.insert(textAt(title_, 0, 0));
}
}  // namespace slamot::mrpt
