#pragma once

#include <slamot/study/execute.h>
#include <slamot/study/results.h>
#include <slamot/study/tables.h>

#include "../results/TemporaryFolder.h"

namespace slamot::study::test
{
/// A study of 16 runs that takes a second: two numbers of landmarks, two methods, four seeds.
class TinyStudy
{
 public:
  explicit TinyStudy(const std::string& study = kStudy)
  {
    folder_.write("world.ini", kWorld);
    folder_.write("filter.ini", kFilter);
    folder_.write("odometry.ini", "[dead-reckoning]\n");
    folder_.write("study.ini", study);
  }

  [[nodiscard]] StudySpec spec(const std::vector<std::string>& set = {}) const
  {
    return StudySpec::load(folder_.file("study.ini"), set);
  }
  [[nodiscard]] Plan plan(const std::vector<std::string>& set = {}) const
  {
    return Plan(spec(set));
  }
  [[nodiscard]] const slamot::test::TemporaryFolder& folder() const { return folder_; }
  [[nodiscard]] std::string out(const std::string& name) const { return folder_.file(name); }

  static constexpr const char* kStudy = R"([study]
title     = Tiny
scenario  = world.ini
methods   = joint, odometry
reference = joint
seeds     = 4
vary      = landmarks
tables    = errors, ratios

[table.errors]
columns = robot_mean_m, target_mean_m

[table.ratios]
columns = robot_mean_m
ratios  = true

[method.joint]
config = filter.ini
rbpf-slamot.particles = 6

[method.odometry]
label  = Odometry
config = odometry.ini

[vary.landmarks]
keys   = world.landmarks
values = 3, 8

[plot.errors]
y = robot_mean_m

[published.paper]
label        = Print
robot_mean_m = 0.01 (0.002)
)";

  static constexpr const char* kWorld = R"([world]
width_m = 10
height_m = 10
landmarks = 5
dt_s = 0.1
steps = 24
scan_every = 4
[robot]
following = true
motion = command
speed_mps = 1
start = near_target
v_std_mps = 0.2
omega_std_radps = 0.05
[target]
motion = circle
speed_mps = 1
circle_radius_m = 3
v_std_mps = 0.2
omega_std_radps = 0.2
start_std_x_m = 0.1
start_std_y_m = 0.1
start_std_theta_rad = 0.1
[landmark_sensor]
range_max_m = 8
range_std_m = 0.1
bearing_std_rad = 0.01
[target_sensor]
range_max_m = 8
range_std_m = 0.1
bearing_std_rad = 0.01
)";

  static constexpr const char* kFilter = R"([rbpf-slamot]
particles = 5
proposal = motion
association = known
target_motion = differential-drive
target_speed_mps = 1
target_turn_rate_deg_per_s = 19.0986
target_speed_noise_mps = 0.2
target_turn_rate_noise_deg_per_s = 11.46
)";

 private:
  slamot::test::TemporaryFolder folder_;
};

/// All texts that must not depend on how a study was run.
inline std::string texts(const Plan& plan, const std::vector<std::string>& folders)
{
  const Outcome outcome = collect(plan, folders);
  return tableMarkdown(plan, outcome) + tableCsv(plan, outcome) + runsCsv(plan, outcome);
}
}  // namespace slamot::study::test
