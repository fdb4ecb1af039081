#include "worlds.h"

#include <slamot/core/Error.h>

#include <filesystem>

namespace slamot::sim
{
namespace
{
// What reading experiment 1 with this change says; empty if it is fine.
std::string complaint(const std::vector<std::string>& changes)
{
  try
  {
    (void)World(test::scenario(changes), 1);
  }
  catch (const core::Error& e)
  {
    EXPECT_EQ(e.status(), core::ExitStatus::kConfig);
    return e.what();
  }
  return {};
}

TEST(Scenario, Experiment1IsThatOfThePage)
{
  const Scenario s = test::scenario();
  EXPECT_EQ(s.steps, 320);
  EXPECT_EQ(s.scanEvery, 8);
  EXPECT_EQ(s.dt, 0.025);
  EXPECT_EQ(s.landmarks.count, 20);
  EXPECT_EQ(s.robots.at(0).motion.vStd, 0.4);
  EXPECT_EQ(s.robots.at(0).motion.omegaStd, 0.0872);
  ASSERT_EQ(s.targets.count(1), 1u);
  EXPECT_EQ(s.targets.at(1).motion.vStd, 0.8);
  EXPECT_EQ(s.targets.at(1).motion.omegaStd, 0.6);
  EXPECT_EQ(s.targets.at(1).start.std, (std::array<double, 3>{0.1, 0.1, 0.1}));
  EXPECT_EQ(s.landmarkSensor.fov.rangeMax, 5);
  EXPECT_EQ(s.landmarkSensor.fov.bearingMax, math::kPi);
  EXPECT_EQ(s.targetSensor->bearingStd, 0.008);
}

TEST(Scenario, WhatIsWrongIsSaidWithItsKey)
{
  const auto expect = [](const std::vector<std::string>& changes, const std::string& part)
  {
    const std::string said = complaint(changes);
    EXPECT_NE(said.find(part), std::string::npos) << changes[0] << " -> " << said;
    EXPECT_EQ(said.find('\n'), std::string::npos);
  };
  expect({"world.step=3"}, "[world] step: unknown key; did you mean steps?");
  expect({"robt.following=true"}, "[robt]: unknown section; did you mean robot?");
  expect({"target_x.speed_mps=1"}, "[target_x]: unknown section");
  expect({"world.dt_s=0"}, "[world] dt_s: 0 is out of range");
  expect({"world.steps=many"}, "[world] steps: 'many' is no whole number");
  expect({"world.landmark_positions_m=1,2"},
         "[world] landmark_positions_m: given beside landmarks");
  expect({"world.landmarks=0", "world.landmark_positions_m=1,2,3"}, "has an x without y");
  expect({"world.landmark_spacing_min_m=9"},
         "[world] landmark_spacing_min_m: leaves no place for landmark");
  expect({"robot.start_distance_m=40"}, "[robot] start_distance_m: leaves no place for the robot");
  expect({"robot.motion=loop"},
         "[robot] motion: 'loop' is not known; set it to circle | waypoints");
  expect({"robot.start=given"},
         "[robot] start: given, but where is not; set start_x_m and start_y_m");
  expect({"target.motion=straight"},
         "[target] start: path, but only circle and waypoints have one");
  expect({"target.motion=waypoints"}, "[target] waypoints_m: missing");
  expect({"target.motion=waypoints", "target.waypoints_m=1,2,3"},
         "not a list of two or more points");
  expect({"target.start=near_target"}, "[target] start: near_target is for robots");
  expect({"target.present_s=3,2"}, "[target] present_s: has times that do not rise");
  expect({"target.present_s=3"}, "[target] present_s: has a time without its partner");
  expect({"target.switch_min_s=4"}, "[target] switch_max_s: is below switch_min_s");
  expect({"robot.follow_target=2"}, "[robot] follow_target: there is no target 2");
  expect({"world.landmark_placement=along_path", "world.landmark_path_max_m=2"},
         "[world] landmark_placement: along_path, but no robot has a path of its own");
  expect({"world.landmark_placement=along_path"}, "[world] landmark_path_max_m: missing");
  expect({"world.landmark_path_max_m=2", "world.landmark_path_min_m=2"},
         "[world] landmark_path_max_m: is not above landmark_path_min_m; raise it");
  expect({"world.landmark_placement=along_path", "world.landmark_path_max_m=12",
          "world.landmark_path_min_m=11", "robot.following=false", "robot.start=path"},
         "[world] landmark_path_max_m: leaves no place for landmark 0; raise it");
  expect({"world.landmarks=1000", "world.landmark_cluster_size=1000"},
         "[world] landmark_spacing_min_m: leaves no place for landmark");
  expect({"robot.drive=steering"}, "[robot] steer_std_deg: missing");
  expect({"target.drive=steering", "target.steer_std_deg=1"},
         "[target] drive: steering is for motion = waypoints and straight; set it to turn_rate");
  expect({"robot.drive=steering", "robot.steer_std_deg=1", "robot.motion=straight"},
         "[robot] drive: steering can't follow a target; set it to turn_rate");
  expect({"landmark_sensor.detection_probability=1.1"},
         "detection_probability: 1.1 is out of range");
  expect({"target_sensor.range_max_m=0.5", "target_sensor.range_min_m=1"},
         "is not above range_min_m");
  expect({"landmark_sensor.bearing_max_deg=-180"}, "bearing_max_deg: is not above bearing_min_deg");
  expect({"landmark_sensor.range_std_m=0"}, "[landmark_sensor] range_std_m: 0 is out of range");
  expect({"target_sensor.glint_probability=1.1"},
         "[target_sensor] glint_probability: 1.1 is out of range");
  expect({"target_sensor.glint_law=cauchy"},
         "[target_sensor] glint_law: 'cauchy' is not known; set it to student-t | gaussian");
  expect({"target_sensor.position_std_m=1", "target_sensor.bearing_only=true"},
         "[target_sensor] position_std_m: is of a place, which bearing_only leaves out");
  expect({"target.motion=white_acceleration", "target.start=random"},
         "[target] acceleration_std_mps2: missing");
  expect(
      {"target.motion=white_acceleration", "target.start=random", "target.acceleration_std_mps2=1"},
      "[target] v_std_mps: is not for motion = white_acceleration; set it to 0");
  expect({"target.motion=white_acceleration", "target.start=random",
          "target.acceleration_std_mps2=1", "target.v_std_mps=0", "target.omega_std_radps=0"},
         "[target] start_std_theta_rad: is not for motion = white_acceleration");
  expect({"robot.motion=white_acceleration", "robot.acceleration_std_mps2=1", "robot.v_std_mps=0",
          "robot.omega_std_radps=0"},
         "[robot] motion: white_acceleration is for targets");
}

TEST(Scenario, WhatIsWrongWithATeamIsSaidWithItsSection)
{
  const auto expect = [](const std::vector<std::string>& changes, const std::string& line)
  {
    std::string said;
    try
    {
      (void)test::team(changes);
    }
    catch (const core::Error& e)
    {
      EXPECT_EQ(e.status(), core::ExitStatus::kConfig);
      said = e.what();
    }
    EXPECT_NE(said.find(line), std::string::npos) << changes[0] << " -> " << said;
    EXPECT_EQ(said.find('\n'), std::string::npos);
  };
  expect({"robot.speed_mps=1"},
         "[robot]: is there beside [robot_0]; name all robots robot_0, robot_1, ...");
  expect({"robot_3.speed_mps=1"},
         "[robot_3]: is there without [robot_2]; number robots from 0 without a gap");
  expect({"robot_x.speed_mps=1"}, "[robot_x]: unknown section");
  expect({"robot_1.following=false"},
         "[robot_1] follow_side_m: is given, but the robot follows nothing; set following = true");
  expect({"robot_1.follow_target=1"}, "[robot_1] follow_target: there is no target 1");
  expect({"robot_1.motion=accelerated", "robot_1.jerk_noise_mps3_per_sqrt_hz=1",
          "robot_1.speed_band_mps=1", "robot_1.direction_cone_deg=1", "robot_1.v_std_mps=0",
          "robot_1.omega_std_radps=0"},
         "[robot_1] motion: accelerated is for targets");
  expect({"robot_1.start_std_acceleration_mps2=1"},
         "[robot_1] start_std_acceleration_mps2: is for motion = accelerated; remove it");
  expect({"target_0.speed_band_mps=2.5"},
         "[target_0] speed_band_mps: lets it stand still or turn back; set it below speed_mps");
  expect({"target_0.direction_cone_deg=90"}, "[target_0] direction_cone_deg: 90 is out of range");
  expect({"target_0.v_std_mps=0.1"}, "[target_0] v_std_mps: is not for motion = accelerated");
  expect({"target_0.jerk_noise_mps3_per_sqrt_hz=9"},
         "[target_0] jerk_noise_mps3_per_sqrt_hz: is too much for its speed's band and its cone");
  expect({"mate_sensor.range=9"}, "[mate_sensor] range: unknown key");
  expect({"mate_sensor.range_std_m=0"}, "[mate_sensor] range_std_m: 0 is out of range");
}

TEST(Scenario, TargetAndTarget1AreOneTooMany)
{
  const std::string said = complaint({"target_1.motion=circle", "target_1.speed_mps=1",
                                      "target_1.v_std_mps=0", "target_1.omega_std_radps=0"});
  EXPECT_NE(said.find("[target_1]: is target 1, as [target] is"), std::string::npos) << said;
}

TEST(Scenario, EveryShippedOneIsWellFormed)
{
  int seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SLAMOT_CONFIG_INI))
  {
    if (entry.path().filename().string().rfind("sim.", 0) != 0) continue;
    core::Config config = core::Config::load(entry.path().string());
    World world(Scenario::from(config), 1);
    EXPECT_NO_THROW(config.requireAllRead()) << entry.path();
    EXPECT_TRUE(world.next().has_value());
    ++seen;
  }
  EXPECT_GE(seen, 9);
}
}  // namespace
}  // namespace slamot::sim
