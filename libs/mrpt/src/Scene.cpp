#include <slamot/mrpt/Scene.h>

#include "SceneBuilder.h"
#include "sceneLegend.h"
#include "view.h"

#include <filesystem>

#include SLAMOT_SCENE_HEADER
#include SLAMOT_VIZ(CPointCloud.h)

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include "GzWriter.h"

namespace slamot::mrpt
{
namespace
{
/// Whether SceneViewer3D's first view, of 20 m about the origin, has most of the ground in it.
bool shownByDefault(const SceneFrame& frame)
{
  return std::max({-frame.xMin, frame.xMax, -frame.yMin, frame.yMax}) < 10;
}

/// The whole map, small, in a corner: the user sees where to go.
void addOverview(MrptScene& scene, const SceneFrame& frame)
{
  auto view = scene.createViewport("overview");
  view->setCloneView("main");
  view->setViewportPosition(0.01, 0.01, 0.4, 0.4);
  view->setBorderSize(1);
  view->setCustomBackgroundColor({1.0f, 1.0f, 1.0f});
  const double height = std::max(frame.yMax - frame.yMin, (frame.xMax - frame.xMin) / 1.3);
  auto camera = slamot_viz::CCamera::Create();
  camera->setPointingAt((frame.xMin + frame.xMax) / 2, (frame.yMin + frame.yMax) / 2, 0);
  camera->setZoomDistance(static_cast<float>(kOrthogonalZoom * 1.05 * height));
  camera->setAzimuthDegrees(-90);
  camera->setElevationDegrees(90);
  camera->setProjectiveModel(false);
  view->insert(camera);
}

MrptScene sceneOf(const SceneData& data)
{
  const SceneFrame frame(data);
  MrptScene scene;
  SceneBuilder(data, frame).addObjects(scene);
  scene.getViewport()->setCustomBackgroundColor({1.0f, 1.0f, 1.0f});
  addLegend(scene, data, frame);
  if (!shownByDefault(frame)) addOverview(scene, frame);
  return scene;
}
}  // namespace

void saveScene(const std::string& path, const SceneData& data)
{
  const MrptScene scene = sceneOf(data);
  ::mrpt::io::CMemoryStream bytes;
  auto archive = ::mrpt::serialization::archiveFrom(bytes);
  archive << scene;
  GzWriter file(path);
  file.write(bytes.getRawBufferData(), bytes.getTotalBytesCount());
  file.close();
}

std::vector<Point2D> loadParticles(const std::string& scenePath)
{
  MrptScene scene;
  std::vector<Point2D> places;
  if (!std::filesystem::exists(scenePath) || !scene.loadFromFile(scenePath)) return places;
  const auto cloud = std::dynamic_pointer_cast<slamot_viz::CPointCloud>(
      scene.getViewport()->getByName("particles"));
  if (!cloud) return places;
  for (std::size_t i = 0; i < cloud->size(); ++i)
  {
    const auto p = cloud->getPoint3Df(i);
    places.push_back({p.x, p.y});
  }
  return places;
}
}  // namespace slamot::mrpt
