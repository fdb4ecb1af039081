#include <gtest/gtest.h>
#include <slamot/core/Error.h>
#include <slamot/sim/World.h>

#include <cmath>

namespace slamot::sim
{
namespace
{
/// One robot at the origin of its world that stands still; posts, walls and a target given.
Scenario scenario(const std::string& world, const std::string& more = {})
{
  core::Config config = core::Config::parse(
      "[world]\nwidth_m = 40\nheight_m = 40\ndt_s = 0.1\nsteps = 6\n"
      "sightings = false\n" +
          world +
          "[robot]\nmotion = circle\nspeed_mps = 0\nradius_m = 1\n"
          "start = given\nstart_x_m = 10\nstart_y_m = 10\nstart_theta_deg = 0\n"
          "v_std_mps = 0\nomega_std_radps = 0\n"
          "[landmark_sensor]\nrange_max_m = 10\nrange_std_m = 0.1\nbearing_std_rad = 0.01\n" +
          more,
      "test");
  const Scenario out = Scenario::from(config);
  config.requireAllRead();
  return out;
}

/// Two robots that stand still, 4 m apart: the second is ahead of the first, looks back, and is
/// red.
Scenario twoRobots(const std::string& more)
{
  const std::string still =
      "motion = waypoints\nwaypoint_reached_m = 0.1\nspeed_mps = 0\nstart = given\n"
      "v_std_mps = 0\nomega_std_radps = 0\nstart_theta_deg = 0\n";
  core::Config config = core::Config::parse(
      "[world]\nwidth_m = 40\nheight_m = 40\ndt_s = 0.1\nsteps = 6\nsightings = false\n"
      "walls_m = 18, 0, 18, 40,  2, 0, 2, 40\n"
      "[robot_0]\nstart_x_m = 10\nstart_y_m = 10\nwaypoints_m = 30, 10, 31, 10\n" +
          still + "radius_m = 0.25\nheight_m = 0.6\nhue_deg = 240\n" +
          "[robot_1]\nstart_x_m = 14\nstart_y_m = 10.5\nwaypoints_m = 30, 10.5, 31, 10.5\n" +
          still +
          "[landmark_sensor]\nrange_max_m = 10\nrange_std_m = 0.1\nbearing_std_rad = 0.01\n" + more,
      "test");
  const Scenario out = Scenario::from(config);
  config.requireAllRead();
  return out;
}

const std::string kLaser = "[laser]\nx_m = 0.5\nbeams = 361\nrange_max_m = 20\nrange_std_m = 0\n";
const std::string kCamera = "[camera]\nz_m = 0.5\npixel_noise = 0\n";
const std::string kTarget =
    "[target]\nmotion = circle\nspeed_mps = 0\nradius_m = 0.2\nstart = given\nstart_x_m = 14\n"
    "start_y_m = 10.5\nstart_theta_deg = 0\nv_std_mps = 0\nomega_std_radps = 0\n"
    "[target_sensor]\nrange_max_m = 10\nrange_std_m = 0.1\nbearing_std_rad = 0.01\n";

core::LaserScan scanOf(const Scenario& s)
{
  World world(s, 1);
  const auto step = world.next();
  EXPECT_EQ(step->lasers.size(), 1u);
  return *step->lasers.at(0);
}

/// Where the reddish or bluish pixels of an image are, and how many.
struct Orange
{
  double u = 0, v = 0;
  int n = 0;
  int brightest = 0;
};
Orange orangeOf(const Picture& p, bool blue = false)
{
  Orange out;
  for (int v = 0; v < p.height; ++v)
    for (int u = 0; u < p.width; ++u)
    {
      const auto* c = &p.bgr[3 * static_cast<std::size_t>(v * p.width + u)];
      if (blue ? c[0] < c[2] + 60 : c[2] < c[0] + 60) continue;
      ++out.n;
      out.u += u, out.v += v;
      out.brightest = std::max<int>(out.brightest, c[2]);
    }
  out.u /= std::max(1, out.n), out.v /= std::max(1, out.n);
  return out;
}
}  // namespace

TEST(RawSensors, TheLaserMeasuresPostsAndWalls)
{
  const auto scan =
      scanOf(scenario("landmark_positions_m = 14, 10\nwalls_m = 18, 0, 18, 40\n", kLaser));
  ASSERT_EQ(scan.ranges.size(), 361u);
  EXPECT_FLOAT_EQ(scan.ranges[180], 3.4f);  // 4 m less the laser's place and the post's radius
  for (int i = 100; i < 261; ++i)
  {
    const double a = scan.angleMin + i * scan.angleStep;
    const bool post = std::abs(3.5 * std::sin(a)) < 0.1;
    const double wall = 7.5 / std::cos(a);
    const double range = scan.ranges[std::size_t(i)];
    EXPECT_NEAR(range, post ? 3.45 : wall, post ? 0.06 : 1e-4) << i;
  }
  EXPECT_TRUE(std::isinf(scan.ranges[0]));  // along the wall, beyond the range
}

TEST(RawSensors, MixedPixelsLieBetweenEdgesOnly)
{
  const std::string world = "landmark_positions_m = 14, 10\nwalls_m = 18, 0, 18, 40\n";
  const auto clean = scanOf(scenario(world, kLaser));
  const auto mixed = scanOf(scenario(world, kLaser + "mixed_pixel_probability = 1\n"));
  int changed = 0;
  for (std::size_t i = 100; i < 261; ++i)  // not where the beams graze the wall
  {
    if (std::isinf(clean.ranges[i]) || std::abs(mixed.ranges[i] - clean.ranges[i]) < 1e-3) continue;
    ++changed;
    EXPECT_GT(mixed.ranges[i], 3.3);
    EXPECT_LT(mixed.ranges[i], 7.7);
  }
  EXPECT_GE(changed, 1);
  EXPECT_LE(changed, 4);  // two beams at most on each side of the post
}

TEST(RawSensors, TheCameraSeesTheTargetWhereItIs)
{
  World world(scenario("", kTarget + kCamera), 1);
  ASSERT_TRUE(world.next());
  const auto picture = world.picture();
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->bgr.size(), std::size_t{3} * 640 * 480);
  const Orange seen = orangeOf(*picture);
  const double bearing = std::atan2(0.5, 4), distance = std::hypot(4, 0.5);
  const double half = std::asin(0.2 / distance);
  EXPECT_NEAR(seen.u, 319.5 - 250 * (std::tan(bearing + half) + std::tan(bearing - half)),
              0.5);  // its foot is round
  const double width = 2 * 0.2 / distance * 500, height = 0.5 / 3.8 * 500;
  EXPECT_NEAR(seen.n, width * height, 0.1 * width * height);
  EXPECT_NEAR(seen.v, 239.5 + 500 * 0.25 / 3.8, 2);  // its middle is 0.25 m below the camera
}

TEST(RawSensors, APostHidesWhatIsBehind)
{
  World hidden(
      scenario("landmark_positions_m = 12, 10.25\nlandmark_radius_m = 0.3\n", kTarget + kCamera),
      1);
  ASSERT_TRUE(hidden.next());
  EXPECT_EQ(orangeOf(*hidden.picture()).n, 0);
}

TEST(RawSensors, LightSwingsAndNoiseIsAsWide)
{
  World steady(scenario("", kTarget + kCamera), 1);
  World swinging(scenario("", kTarget + kCamera + "light_swing = 0.5\nlight_period_s = 0.8\n"), 1);
  World noisy(scenario("", kTarget + "[camera]\nz_m = 0.5\npixel_noise = 10\n"), 1);
  for (int i = 0; i < 2; ++i)
    steady.next(), swinging.next(), noisy.next();  // a quarter of its period
  const Picture a = *steady.picture(), c = *noisy.picture();
  EXPECT_NEAR(orangeOf(*swinging.picture()).brightest, std::min(255.0, 1.5 * orangeOf(a).brightest),
              3);
  double sum = 0;
  for (std::size_t i = 0; i < a.bgr.size(); ++i) sum += std::pow(double(c.bgr[i]) - a.bgr[i], 2);
  EXPECT_NEAR(std::sqrt(sum / double(a.bgr.size())), 10, 0.3);
}

TEST(RawSensors, ReportAtTheirOwnRatesAndAlone)
{
  const Scenario s =
      scenario("landmark_positions_m = 14, 10\n",
               kTarget + kLaser + "scan_every = 2\n" + kCamera + "image_every = 3\n");
  World world(s, 1), again(s, 1);
  EXPECT_FALSE(world.picture());
  for (int i = 1; i <= 6; ++i)
  {
    const auto step = world.next(), same = again.next();
    EXPECT_FALSE(step->landmarks || step->blobs);
    EXPECT_EQ(step->lasers.size(), i % 2 == 0 ? 1u : 0u);
    EXPECT_EQ(world.picture().has_value(), i % 3 == 0);
    for (std::size_t k = 0; k < step->lasers.size(); ++k)
      EXPECT_EQ(step->lasers[k]->ranges, same->lasers[k]->ranges);
    if (const auto picture = world.picture())
    {
      EXPECT_EQ(picture->bgr, again.picture()->bgr);
    }
  }
}

TEST(RawSensors, ARobotsScanHasTheOthersBody)
{
  const Scenario s = twoRobots(kLaser + "[laser_1]\nx_m = -0.5\nyaw_deg = 180\nbeams = 361\n" +
                               "range_max_m = 20\nrange_std_m = 0\n");
  for (int robot = 0; robot < 2; ++robot)
  {
    World world(s, 1, World::Sightings::kAsRead, robot);
    const auto step = world.next();
    ASSERT_EQ(step->lasers.size(), 1u);
    const core::LaserScan& scan = *step->lasers[0];
    // From the laser, half a metre towards the other: 3.5 m along its axis, and half a metre left.
    const double distance = std::hypot(3.5, 0.5), radius = robot == 0 ? 0.2 : 0.25;
    int beams = 0;
    for (std::size_t i = 0; i < scan.ranges.size(); ++i)
    {
      const double a = scan.angleMin + double(i) * scan.angleStep - std::atan2(0.5, 3.5);
      if (std::abs(distance * std::sin(a)) >= radius - 1e-6 || std::cos(a) < 0) continue;
      ++beams;
      const double across = distance * std::sin(a);
      EXPECT_NEAR(scan.ranges[i],
                  distance * std::cos(a) - std::sqrt(radius * radius - across * across), 1e-4)
          << robot << " " << i;
    }
    EXPECT_GE(beams, 13);
    EXPECT_NEAR(scan.ranges[180], robot == 0 ? 7.5 : 11.5, 1e-4) << "the wall beside it";
  }
}

TEST(RawSensors, ARobotsPictureHasTheOthersBodyInItsColour)
{
  const Scenario s = twoRobots(kCamera + "[camera_1]\nz_m = 0.5\nyaw_deg = 180\npixel_noise = 0\n");
  for (int robot = 0; robot < 2; ++robot)
  {
    World world(s, 1, World::Sightings::kAsRead, robot);
    ASSERT_TRUE(world.next());
    const bool blue = robot == 1;  // what robot 1 sees is robot 0
    EXPECT_EQ(orangeOf(*world.picture(), !blue).n, 0);
    const Orange seen = orangeOf(*world.picture(), blue);
    const double radius = blue ? 0.25 : 0.2, height = blue ? 0.6 : 0.4;
    const double bearing = std::atan2(0.5, 4), distance = std::hypot(4, 0.5);
    const double half = std::asin(radius / distance);
    EXPECT_NEAR(seen.u, 319.5 - 250 * (std::tan(bearing + half) + std::tan(bearing - half)), 1);
    const double area = 2 * radius / distance * 500 * height / (4 - radius) * 500;
    EXPECT_NEAR(seen.n, area, 0.1 * area);
  }
}

// One section for all, unless a robot has its own.
TEST(RawSensors, AreTheTeamsOrARobotsOwn)
{
  const Scenario s = twoRobots(kLaser + "[camera_1]\nz_m = 0.5\n");
  EXPECT_EQ(s.robots[0].laser->pose, s.robots[1].laser->pose);
  EXPECT_FALSE(s.robots[0].camera);
  EXPECT_TRUE(s.robots[1].camera);
  EXPECT_THROW(twoRobots("[camera_2]\nz_m = 0.5\n"), core::Error);
  EXPECT_THROW(scenario("", "[laser_0]\nbeams = 3\n"), core::Error);  // there is no team
}

TEST(RawSensors, WrongKeysAreErrors)
{
  EXPECT_THROW(scenario("walls_m = 1, 2, 3\n"), core::Error);
  EXPECT_THROW(scenario("", "[laser]\nbeams = 1\n"), core::Error);
  EXPECT_THROW(scenario("", "[camera]\nfocal_length_px = 0\n"), core::Error);
  EXPECT_THROW(scenario("", "[camera]\nfocal = 5\n"), core::Error);
}
}  // namespace slamot::sim
