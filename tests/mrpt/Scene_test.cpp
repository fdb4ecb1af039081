#include "../../libs/mrpt/src/view.h"
#include "../results/TemporaryFolder.h"

#include <slamot/core/Error.h>
#include <slamot/mrpt/Scene.h>
#include <slamot/mrpt/mrpt_compat.h>

#include SLAMOT_SCENE_HEADER
#include SLAMOT_VIZ(CPointCloud.h)
#include SLAMOT_VIZ(CSetOfTriangles.h)

#include <mrpt/img/CImage.h>

namespace slamot::mrpt
{
namespace
{
using core::ExitStatus;
using slamot::test::TemporaryFolder;

SceneData sampleScene()
{
  SceneData data;
  data.title = "a method on a.rawlog";
  data.robot.name = "robot";
  data.robot.path = {{{-4, -4}, {-4, 4}, {0, 4}}};
  data.robot.truth = {{{-4.2, -4}, {-4.2, 4}, {0, 4.2}}};
  data.robot.now = Gaussian<Pose2D>{{0, 4, 0}, 0.01 * Matrix3::Identity()};
  SceneTrack target;
  target.name = "target 1";
  target.path = {{{3.5, -4}, {3.5, 0}}, {{3.5, 2}, {3, 4}}};
  data.targets = {target};
  for (int i = 0; i < 5; ++i)
    data.landmarks.push_back({i, {{i - 2.0, 0}, 0.02 * Matrix2::Identity()}, 3});
  data.trueLandmarks = {{-2, 0.1}, {-1, 0.1}, {0, 0.1}};
  data.particles = {{{0, 4, 0}, 0.5}, {{0.1, 4, 0}, 0.5}};
  return data;
}

/// The exit status of what is done; kDone without an error.
template <class Action>
ExitStatus statusOf(Action action)
{
  try
  {
    action();
  }
  catch (const core::Error& e)
  {
    return e.status();
  }
  return ExitStatus::kDone;
}

std::size_t trianglesOf(MrptScene& scene, const std::string& name)
{
  const auto object = scene.getViewport()->getByName(name);
  const auto triangles = std::dynamic_pointer_cast<slamot_viz::CSetOfTriangles>(object);
  return triangles ? triangles->getTrianglesCount() : 0;
}

/// A picture of the sample; empty where there is no OpenGL.
std::optional<::mrpt::img::CImage> pictureOf(const SceneData& data, const RenderOptions& options)
{
  const TemporaryFolder folder;
  saveScene(folder.file("a.3Dscene"), data);
  const auto render = [&] { renderScene(folder.file("a.3Dscene"), folder.file("a.png"), options); };
  if (statusOf(render) == ExitStatus::kInternal) return std::nullopt;
  ::mrpt::img::CImage picture;
  if (!picture.loadFromFile(folder.file("a.png"))) throw std::runtime_error("no picture");
  return picture;
}

/// How far a pixel is from a colour, over all three channels (in whatever order they are).
int distanceTo(::mrpt::img::CImage& picture, int x, int y, const ::mrpt::img::TColor& c)
{
  const auto byte = [&](std::int8_t channel)
  { return static_cast<int>(*picture.ptr<std::uint8_t>(x, y, channel)); };
  return std::abs(byte(0) - c.B) + std::abs(byte(1) - c.G) + std::abs(byte(2) - c.R);
}

TEST(Scene, SameDataGivesTheSameBytes)
{
  const TemporaryFolder folder;
  saveScene(folder.file("a.3Dscene"), sampleScene());
  saveScene(folder.file("b.3Dscene"), sampleScene());
  EXPECT_EQ(folder.read("a.3Dscene"), folder.read("b.3Dscene"));
}

TEST(Scene, LoadsBackWithAllThatWasPutIn)
{
  const TemporaryFolder folder;
  saveScene(folder.file("a.3Dscene"), sampleScene());
  MrptScene scene;
  ASSERT_TRUE(scene.loadFromFile(folder.file("a.3Dscene")));
  for (const char* name :
       {"grid", "robot path", "robot", "robot ellipse", "target 1 path", "robot truth", "landmarks",
        "landmark ellipses", "true landmarks", "particles"})
    EXPECT_TRUE(scene.getViewport()->getByName(name)) << name;
  EXPECT_FALSE(scene.getViewport()->getByName("target 1")) << "it is lost at the end";
  EXPECT_FALSE(scene.getViewport()->getByName("laser points"));
  EXPECT_EQ(trianglesOf(scene, "target 1 path"), 4u) << "a gap is not bridged";
  EXPECT_EQ(trianglesOf(scene, "true landmarks"), 3u * 4u);
  EXPECT_EQ(trianglesOf(scene, "landmarks") % 5, 0u);
  EXPECT_TRUE(scene.getViewport("legend")->getByName("text: target 1"));
  EXPECT_TRUE(scene.getViewport("title")->getByName("text: a method on a.rawlog"));
}

TEST(Scene, OfNothingIsStillAScene)
{
  const TemporaryFolder folder;
  saveScene(folder.file("a.3Dscene"), SceneData{});
  MrptScene scene;
  EXPECT_TRUE(scene.loadFromFile(folder.file("a.3Dscene")));
}

TEST(Scene, CannotBeSavedWhereNoFolderIs)
{
  EXPECT_EQ(statusOf([] { saveScene("/nowhere/a.3Dscene", sampleScene()); }),
            ExitStatus::kUnreadable);
}

TEST(RenderScene, ShowsThingsInTheirColoursWhereTheyAre)
{
  RenderOptions options;
  options.fromAbove = true, options.width = 800, options.height = 600;
  auto picture = pictureOf(sampleScene(), options);
  if (!picture) GTEST_SKIP() << "no OpenGL on this machine";
  CameraView view;
  view.elevation = math::kPi / 2;
  view = fitted(view, 4.0 / 3, {-5, 4, -5, 5});  // the grid: whole metres about the sample
  const auto distance = [&](double x, double y, const ::mrpt::img::TColor& colour)
  {
    const ScreenPoint p = project(view, 4.0 / 3, x, y);
    return distanceTo(*picture, static_cast<int>(std::lround((p.x + 1) / 2 * 800)),
                      static_cast<int>(std::lround((1 - p.y) / 2 * 600)), colour);
  };
  EXPECT_LT(distance(-4, 1.3, {0x00, 0x72, 0xb2}), 40) << "the robot's path";
  EXPECT_LT(distance(3.5, -1.7, {0xd5, 0x5e, 0x00}), 40) << "the target's path";
  EXPECT_LT(distance(3.5, 1.3, {0xff, 0xff, 0xff}), 40) << "where the target was lost";
  EXPECT_LT(distance(2, 0, {0x00, 0x9e, 0x73}), 40) << "a landmark";
  EXPECT_GT(distance(2, 0.2, {0x00, 0x9e, 0x73}), 40) << "its ellipse is paler";
  EXPECT_GT(distance(2, 0.2, {0xff, 0xff, 0xff}), 40) << "but not white";
}

TEST(RenderScene, DrawsInPerspectiveAtOddSizes)
{
  RenderOptions options;
  options.width = 333, options.height = 251;
  const auto picture = pictureOf(sampleScene(), options);
  if (!picture) GTEST_SKIP() << "no OpenGL on this machine";
  EXPECT_EQ(picture->getWidth(), 333u);
  EXPECT_EQ(picture->getHeight(), 251u);
}

TEST(RenderScene, RefusesWhatIsNoScene)
{
  const TemporaryFolder folder;
  const std::string text = folder.write("a.3Dscene", "not a scene");
  EXPECT_EQ(statusOf([&] { renderScene(text, folder.file("a.png"), {}); }),
            ExitStatus::kUnreadable);
  EXPECT_EQ(statusOf([&] { renderScene(folder.file("none"), folder.file("a.png"), {}); }),
            ExitStatus::kUnreadable);
}
}  // namespace
}  // namespace slamot::mrpt
