#include <gtest/gtest.h>
#include <slamot/mrpt/LiveScene.h>

namespace slamot::mrpt
{
namespace
{
core::Update updateAt(double x, const std::vector<int>& targets)
{
  core::Update update;
  update.estimate.robot.mean = {x, 0, 0};
  for (const int id : targets)
  {
    core::TargetEstimate t;
    t.id = id, t.pose.mean = {x, 1.0 * id, 0};
    update.estimate.targets.push_back(t);
  }
  return update;
}

core::Step stepWithScan(float range)
{
  auto scan = std::make_shared<core::LaserScan>();
  scan->rangeMax = 10;
  scan->ranges = {range};
  core::Step step;
  step.lasers = {scan};
  return step;
}

class OneLandmark : public core::LandmarkView
{
 public:
  void visit(const std::function<void(const core::LandmarkEstimate&)>& visitor) const override
  {
    visitor({7, {}, 1});
  }
  [[nodiscard]] std::size_t size() const override { return 1; }
};

TEST(LiveScene, GrowsWithTheRun)
{
  LiveScene live("a");
  live.begin(updateAt(0, {}).estimate);
  live.add({}, updateAt(1, {3}));
  auto update = updateAt(2, {3});
  const OneLandmark map;
  update.estimate.landmarks = &map;
  live.add(stepWithScan(4), update);
  const SceneData scene = live.at(update.estimate, {{{2, 0, 0}, 1}});
  EXPECT_EQ(scene.title, "a");
  EXPECT_EQ(scene.robot.path.at(0).size(), 3u);
  EXPECT_DOUBLE_EQ(scene.robot.now->mean.x, 2);
  EXPECT_EQ(scene.targets.at(0).name, "target 3");
  EXPECT_EQ(scene.landmarks.at(0).id, 7);
  EXPECT_DOUBLE_EQ(scene.scanPoints.at(0).x, 6);
  EXPECT_EQ(scene.particles.size(), 1u);
}

TEST(LiveScene, TargetsComeAndGoUnderTheirOwnColours)
{
  LiveScene live("a");
  live.add({}, updateAt(0, {3}));
  live.add({}, updateAt(1, {4}));
  live.add({}, updateAt(2, {3, 4}));
  const SceneData scene = live.at({}, {});
  ASSERT_EQ(scene.targets.size(), 2u);
  EXPECT_EQ(scene.targets[0].path.size(), 2u) << "lost and found again: no line between";
  EXPECT_EQ(scene.targets[1].path.size(), 1u);
}

TEST(LiveScene, AWallIsDrawnOnceHoweverOftenItIsSeen)
{
  LiveScene live("a");
  for (int i = 0; i < 5; ++i) live.add(stepWithScan(4), updateAt(0, {}));
  EXPECT_EQ(live.at({}, {}).laserPoints.size(), 1u);
  EXPECT_EQ(live.at({}, {}).scanPoints.size(), 1u);
}
}  // namespace
}  // namespace slamot::mrpt
