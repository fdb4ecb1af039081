#pragma once

#include <slamot/core/Estimate.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace slamot::mrpt
{
using Polyline = std::vector<Point2D>;  ///< corners [m], in map axes

/// Something that moves.
struct SceneTrack
{
  std::string name;                     ///< as the legend has it
  std::vector<Polyline> path;           ///< as estimated; in pieces where it was lost
  std::vector<Polyline> truth;          ///< empty: not known
  std::optional<Gaussian<Pose2D>> now;  ///< where it is at the end; none: lost
};

/// What a robot believed of a place before and after a fusion.
struct SceneFusion
{
  Gaussian<Point2D> before;  ///< in map axes
  Gaussian<Point2D> after;   ///< in map axes
};

/// One robot of a team, drawn in a colour of its own: its path, thin the target as it tracks it,
/// and 95% ellipses around some fusions, the rim before and filled after.
struct SceneMember
{
  SceneTrack robot;                  ///< its own path
  SceneTrack target;                 ///< the team's target as this robot tracks it
  std::vector<SceneFusion> fusions;  ///< whose ellipses are drawn
};

/// A run as a scene, all in the map's frame.
struct SceneData
{
  std::string title;                              ///< above the scene; empty: none
  SceneTrack robot;                               ///< not drawn with a `team`
  std::vector<SceneTrack> targets;                ///< not drawn with a `team`
  std::vector<core::LandmarkEstimate> landmarks;  ///< confirmed ones
  std::vector<Point2D> trueLandmarks;             ///< crosses; empty: not known
  std::vector<Point2D> laserPoints;               ///< returns of the run's scans
  std::vector<Point2D> scanPoints;                ///< of the latest laser scans alone
  std::vector<Polyline> sightings;                ///< from the robot to what it sees
  std::vector<core::WeightedPose> particles;      ///< at the end
  std::vector<SceneMember> team;                  ///< of a team: in place of robot and targets
  double fusionScale = 1;  ///< the ellipses of fusions are drawn so many times as large
  bool ofMoments = false;  ///< moments of it are drawn, with the map and particles of its end
};

/// Writes a .3Dscene for SceneViewer3D: paths as ribbons, landmarks as posts on their 95% ellipses,
/// truth as thin dark lines and crosses, a legend and a grid.  The same data gives the same bytes.
/// The file is written whole or not at all.  \throws core::Error (kUnreadable) if it can't be.
void saveScene(const std::string& path, const SceneData& data);

/// The places of the particles that saveScene() put into a file; none if it holds none or can't be
/// read.
[[nodiscard]] std::vector<Point2D> loadParticles(const std::string& scenePath);

/// From where a scene is looked at.
enum class View
{
  kPlan,   ///< the whole map
  kFollow  ///< from behind the robot
};

/// How to look at a scene.
struct RenderOptions
{
  View view = View::kPlan;  ///< plan or follow
  bool fromAbove = false;   ///< a plan without perspective; else from the side
  int width = 1280;         ///< [px]
  int height = 960;         ///< [px]
};

/// Draws a .3Dscene file to a PNG, with neither display nor graphics card.
/// \throws core::Error: kUnreadable if the scene can't be read or the picture not be written;
/// kInternal where there is no OpenGL at all.
void renderScene(const std::string& scenePath, const std::string& pngPath,
                 const RenderOptions& options);
}  // namespace slamot::mrpt
