#include "planCamera.h"

#include <slamot/math/geometry.h>

#include <algorithm>

namespace slamot::mrpt
{
slamot_viz::CCamera planCamera(const Box& ground, const RenderOptions& options)
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
}  // namespace slamot::mrpt
