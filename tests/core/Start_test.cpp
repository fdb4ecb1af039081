#include "expectError.h"

#include "commaLocale.h"

#include <slamot/core/Params.h>
#include <slamot/core/Start.h>
#include <slamot/math/random.h>

namespace slamot::core
{
namespace
{
using test::expectConfigError;

Starts read(const std::string& text)
{
  Config c = Config::parse(text, "x.ini");
  const Starts s = Starts::from(c);
  c.requireAllRead();
  return s;
}

void expectSame(const Starts& a, const Starts& b)
{
  EXPECT_EQ(a.time, b.time);
  ASSERT_EQ(a.robot.has_value(), b.robot.has_value());
  if (a.robot)
  {
    EXPECT_EQ(a.robot->value, b.robot->value);
    EXPECT_EQ(a.robot->std, b.robot->std);
  }
  ASSERT_EQ(a.targets.size(), b.targets.size());
  for (const auto& [id, start] : a.targets)
  {
    EXPECT_EQ(start.value, b.targets.at(id).value);
    EXPECT_EQ(start.std, b.targets.at(id).std);
  }
}

ObjectStart draw(math::RandomStream& random)
{
  ObjectStart s;
  const auto number = [&] { return random.normal() * std::pow(10, random.uniform(-20, 20)); };
  for (std::size_t i = 0; i < ObjectStart::kCount; ++i)
  {
    if (random.uniform() < 0.7) s.value[i] = number();
    if (random.uniform() < 0.7) s.std[i] = std::abs(number());
  }
  s.value[ObjectStart::kX] = number();
  return s;
}
}  // namespace

TEST(Starts, AreReadBackWithoutLoss)
{
  math::RandomStream random{1};
  for (int trial = 0; trial < 50; ++trial)
  {
    Starts s;
    if (trial % 2) s.time = 1.6e9 + random.uniform();
    if (trial % 3) s.robot = draw(random);
    for (int id = 0; id < trial % 5; ++id) s.targets[id * 7] = draw(random);
    expectSame(s, read(s.toIni()));
  }
}

TEST(Starts, AreReadBackWithoutLossInALocaleWithDecimalCommas)
{
  const test::CommaLocale locale;
  if (!test::CommaLocale::active()) GTEST_SKIP() << "no such locale here";
  math::RandomStream random{2};
  Starts s;
  s.time = 0.5;
  s.robot = draw(random);
  s.targets[3] = draw(random);
  EXPECT_EQ(s.toIni().find(','), std::string::npos) << s.toIni();
  expectSame(s, read(s.toIni()));
}

TEST(Starts, WithoutASectionAreTheOriginExactly)
{
  const Starts s = read("");
  EXPECT_EQ(s.toIni(), "");
  EXPECT_FALSE(s.robot);
  EXPECT_EQ(s.robotPose().mean, Pose2D());
  EXPECT_TRUE(s.robotPose().cov.isZero());
}

TEST(Starts, ReadTheirKeys)
{
  const Starts s = read(
      "[start]\ntime_s = 2.5\nrobot_x_m = 1\nrobot_theta_rad = 7\nrobot_std_y_m = 0.5\n"
      "target_12_x_m = 3\ntarget_12_vx_mps = -1\ntarget_12_std_ay_mps2 = 0.25\n");
  EXPECT_EQ(s.time, 2.5);
  const Gaussian<Pose2D> pose = s.robotPose();
  EXPECT_EQ(pose.mean.x, 1);
  EXPECT_EQ(pose.mean.y, 0);
  EXPECT_DOUBLE_EQ(pose.mean.phi, 7 - math::kTwoPi);
  EXPECT_EQ(pose.cov, Matrix3(Vector3(0, 0.25, 0).asDiagonal()));
  ASSERT_EQ(s.targets.size(), 1u);
  const ObjectStart& t = s.targets.at(12);
  EXPECT_EQ(t.get(ObjectStart::kVx), -1);
  EXPECT_FALSE(t.value[ObjectStart::kVy]);
  EXPECT_EQ(t.getStd(ObjectStart::kAy), 0.25);
}

TEST(Starts, RefuseWrongKeysAndValues)
{
  const auto refused = [](const std::string& line, const std::vector<std::string>& parts)
  {
    SCOPED_TRACE(line);
    expectConfigError([&] { (void)read("[start]\n" + line + "\n"); }, parts);
  };
  refused("robot_x = 1", {"robot_x: unknown key", "robot_x_m"});
  refused("robot_x_m = nan", {"robot_x_m", "no number"});
  refused("robot_std_x_m = -1", {"robot_std_x_m", "out of range", ">= 0"});
  refused("target_x_m = 1", {"target_x_m", "unknown key"});
  refused("target_-1_x_m = 1", {"target_-1_x_m", "unknown key"});
  refused("target_99999999999999999999_x_m = 1", {"unknown key"});
  refused("target_1_z_m = 1", {"target_1_z_m", "unknown key"});
  refused("time_s = abc", {"time_s", "no number"});
}
}  // namespace slamot::core
