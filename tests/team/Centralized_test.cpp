#include <gtest/gtest.h>
#include <slamot/core/Error.h>
#include <slamot/filters/registerAll.h>
#include <slamot/math/random.h>
#include <slamot/team/Team.h>

namespace slamot::team
{
namespace
{
constexpr double kDt = 0.2, kSpeed = 2.5, kApart = 10;

/// Drives straight on beside the other robot, which it sees well; knows its motion badly.
class Drive : public core::Source
{
 public:
  explicit Drive(int robot) : robot_(robot) {}

  std::optional<core::Step> next() override
  {
    if (++steps_ > 50) return std::nullopt;
    math::RandomStream random{7, static_cast<std::uint64_t>(robot_),
                              static_cast<std::uint64_t>(steps_)};
    core::Step out;
    out.time = kDt * steps_;
    out.odometry = math::turnThenMove(kSpeed, 0, kDt, 0.5, 1e-4);
    out.odometry->mean.x += 0.5 * kDt * random.normal();
    core::Blob mate;
    mate.label = "robot";
    mate.range = kApart + 0.02 * random.normal();
    mate.bearing = (robot_ == 0 ? 1 : -1) * math::kPi / 2 + 0.002 * random.normal();
    mate.rangeStd = 0.02;
    mate.bearingStd = 0.002;
    out.blobs.emplace().blobs = {mate};
    return out;
  }

 private:
  int robot_, steps_ = 0;
};

core::Starts startOf(int robot)
{
  core::Starts out;
  out.time = 0;
  core::ObjectStart& s = out.robot.emplace();
  s.value[s.kX] = 0, s.value[s.kY] = kApart * robot, s.value[s.kTheta] = 0;
  s.std[s.kX] = s.std[s.kY] = 0.1;
  return out;
}

core::Config configOf(const std::string& more = {})
{
  return core::Config::parse("[team]\nrule=centralized\n" + more +
                                 "[ekf-slamot]\ntarget_velocity_std_mps=1\n"
                                 "target_acceleration_std_mps2=1\n"
                                 "target_jerk_noise_mps3_per_sqrt_hz=1\n",
                             "test");
}
}  // namespace

// A robot that looks must find its mate where it is now, not where it was a step ago: half a metre.
TEST(Centralized, AllRobotsMoveBeforeOneLooks)
{
  filters::registerAll();
  Drive first(0), second(1);
  core::Config config = configOf();
  Team team(config, {{0, &first, startOf(0)}, {1, &second, startOf(1)}}, 1, 1);
  team.run({{}, {}});
  const auto a = team.filter(0).estimate().robot, b = team.filter(1).estimate().robot;
  // Seen so well, they are beside each other to a few of the sensor's deviations.
  EXPECT_NEAR(b.mean.x - a.mean.x, 0, 0.06);
  EXPECT_NEAR(b.mean.y - a.mean.y, kApart, 0.06);
}

TEST(Centralized, RefusesTwoRobotsOfOneNumber)
{
  filters::registerAll();
  Drive first(0), second(1);
  core::Config config = configOf();
  EXPECT_THROW(Team(config, {{3, &first, startOf(0)}, {3, &second, startOf(1)}}, 1, 1),
               core::Error);
}
}  // namespace slamot::team
