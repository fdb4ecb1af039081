#pragma once

/// \file
/// The one place for differences between MRPT's versions.
// 2.5.8 defines MRPT_VERSION as 0x258, later releases as 0x020E00, 0x030102, ...: compare with
// 0x030000 only.
#include <mrpt/version.h>

// NOLINTBEGIN(bugprone-macro-parentheses): types and whole functions take none.
#if MRPT_VERSION >= 0x030000
#define SLAMOT_VIZ(header) <mrpt/viz/header>
#define SLAMOT_SCENE_HEADER <mrpt/viz/Scene.h>
namespace mrpt::viz
{
class Scene;
}
namespace slamot::mrpt
{
using MrptScene = ::mrpt::viz::Scene;
}
#include <mrpt/viz/CSetOfObjects.h>
#include <mrpt/viz/Visualizable.h>
namespace slamot_viz = ::mrpt::viz;
#define SLAMOT_GET_SENSOR_POSE(member)                  \
  ::mrpt::poses::CPose3D getSensorPose() const override \
  {                                                     \
    return member;                                      \
  }
#define SLAMOT_METRIC_MAP_POINTER ::mrpt::maps::CMetricMap::Ptr
#define SLAMOT_SET_CAMERA(renderer, scene, camera) (renderer).setCamera(camera)
#else
/// `#include SLAMOT_VIZ(CText3D.h)`: a header of what can be drawn.
#define SLAMOT_VIZ(header) <mrpt/opengl/header>
/// The header of MrptScene.
#define SLAMOT_SCENE_HEADER <mrpt/opengl/COpenGLScene.h>
namespace mrpt::opengl
{
class COpenGLScene;
}
namespace slamot::mrpt
{
/// What a .3Dscene file holds.
using MrptScene = ::mrpt::opengl::COpenGLScene;
}  // namespace slamot::mrpt
/// What an off-screen renderer draws from; arguments: CFBORender, MrptScene, CCamera.
#define SLAMOT_SET_CAMERA(renderer, scene, camera) (renderer).setCamera(scene, camera)
/// Who owns what a metric map's definition makes.
#define SLAMOT_METRIC_MAP_POINTER ::mrpt::maps::CMetricMap*
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/Visualizable.h>
namespace slamot_viz = ::mrpt::opengl;
/// The signature of CObservation::getSensorPose() in a class; `member` holds the pose.
#define SLAMOT_GET_SENSOR_POSE(member)                           \
  void getSensorPose(::mrpt::poses::CPose3D& out) const override \
  {                                                              \
    out = member;                                                \
  }
#endif
// NOLINTEND(bugprone-macro-parentheses)
