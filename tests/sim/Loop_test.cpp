#include "worlds.h"

#include <slamot/core/checkStep.h>

namespace slamot::sim
{
namespace
{
using test::shipped;

struct Drive
{
  double length = 0, farthest = 0, homeDistance = 0;
  double inView = 0;  // true sightings per scan
  std::size_t neverSeen = 0;
};

Drive drive(const Scenario& s, std::uint64_t seed)
{
  World world(s, seed);
  Drive out;
  int scans = 0;
  double last = 0;
  while (const auto step = world.next())
  {
    EXPECT_NO_THROW(core::checkStep(*step, last));
    EXPECT_FALSE(step->blobs.has_value());  // no target sensor
    last = step->time;
    scans += step->landmarks ? 1 : 0;
  }
  std::map<int, int> sightings;
  for (const auto& a : world.truth().associations) ++sightings[a.id];
  sightings.erase(core::kNoId);
  out.neverSeen = world.truth().landmarks.size() - sightings.size();
  for (const auto& [id, count] : sightings) out.inView += double(count) / scans;
  const auto& poses = world.truth().robot.poses;
  for (std::size_t i = 0; i + 8 < poses.size(); i += 8)
  {
    const Point2D a(poses[i].pose.x, poses[i].pose.y), b(poses[i + 8].pose.x, poses[i + 8].pose.y);
    out.length += (b - a).norm();
    out.farthest = std::max(out.farthest, s.robots[0].motion.distanceToPath(a));
  }
  out.homeDistance =
      std::hypot(poses.back().pose.x - poses[0].pose.x, poses.back().pose.y - poses[0].pose.y);
  return out;
}

// Once around as the paper tells it: 690 m in 231 s, and home again, whatever noise does.
void expectOnceAround(const Drive& d)
{
  EXPECT_NEAR(d.length, 690, 10);
  EXPECT_LT(d.farthest, 4);
  EXPECT_LT(d.homeDistance, 8);
  EXPECT_EQ(d.neverSeen, 0u);
}

TEST(Loop, IsDrivenOnceByEitherDrive)
{
  for (const char* how : {"robot.drive=turn_rate", "robot.drive=steering"})
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
      expectOnceAround(drive(shipped("loop", {how}), seed));
}

TEST(Loop, StaysOnItsWayUnderTheLargestNoiseOfThePage)
{
  expectOnceAround(
      drive(shipped("loop", {"robot.v_std_mps=0.4", "robot.omega_std_radps=0.0873"}), 2));
  expectOnceAround(drive(
      shipped("loop", {"robot.v_std_mps=0.4", "robot.steer_std_deg=5", "robot.drive=steering"}),
      2));
}

// Over 20 seeds the means are 1.42, 4.88, 0.57 and 10.1; they differ between seeds by a tenth.
TEST(Loop, HasAsManyLandmarksInViewAsThePageSays)
{
  const auto inView = [](const char* name)
  {
    const Scenario s = shipped(name);
    double sum = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) sum += drive(s, seed).inView / 3;
    return sum;
  };
  EXPECT_NEAR(inView("loop"), 1.42, 0.3);
  EXPECT_NEAR(inView("loop-dense"), 4.88, 0.5);
  EXPECT_NEAR(inView("loop-sparse"), 0.57, 0.15);
  EXPECT_NEAR(inView("loop-hard"), 10.1, 2);
}
}  // namespace
}  // namespace slamot::sim
