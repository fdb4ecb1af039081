#include <slamot/importers/ScaledCars.h>
#include <slamot/moving/MovingObjects.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "scene.h"

using namespace slamot;
using namespace slamot::moving;

namespace
{
constexpr double kLength = 0.7, kWidth = 0.35, kStep = 0.08;  // [m, m, s]
using Path = std::function<Pose2D(double time)>;

/// A room of 10 m by 8 m with a pillar, a crate and a car in it.
struct Room
{
  Path robot = [](double t) { return Pose2D{-3 + 0.3 * t, -2, 0.05 * t}; };
  Path car;

  [[nodiscard]] moving::test::World at(double t) const
  {
    moving::test::World world;
    moving::test::addBox(world, {0, 0, 0}, 10, 8);
    moving::test::addBox(world, {2.5, -3.0, 0.4}, 0.4, 0.4);
    world.circles.push_back({{-1, 2.5}, 0.15});
    if (car) moving::test::addBox(world, car(t), kLength, kWidth);
    return world;
  }
};

struct Moment
{
  double time;
  Pose2D robot;
  std::vector<core::TargetEstimate> targets;
  std::vector<bool> moving;
  core::LaserScan scan;
};

std::vector<Moment> watch(const Room& room, double seconds, const MovingOptions& options,
                          const core::Starts& starts = {}, std::uint64_t seed = 1)
{
  core::Starts all = starts;
  core::ObjectStart& robot = all.robot.emplace();
  const Pose2D first = room.robot(0);
  robot.value[core::ObjectStart::kX] = first.x;
  robot.value[core::ObjectStart::kY] = first.y;
  robot.value[core::ObjectStart::kTheta] = first.phi;
  MovingObjects objects(options, all);
  std::vector<Moment> out;
  Pose2D before = first;
  for (int i = 0; i * kStep <= seconds; ++i)
  {
    const double t = i * kStep;
    const Pose2D now = room.robot(t);
    Gaussian<Pose2D> increment{math::between(before, now), {}};
    increment.cov = Vector3(1e-6, 1e-6, 1e-6).asDiagonal();
    objects.move(increment, i == 0 ? 0 : kStep);
    before = now;
    Moment& m = out.emplace_back();
    m.time = t;
    m.robot = now;
    m.scan = moving::test::lookRound(room.at(t), now, 0.01, seed * 1000 + i);
    m.moving = objects.see(t, m.scan);
    m.targets = objects.targets({now, Matrix3::Zero()});
  }
  return out;
}

/// Drives by at 1 m/s, then turns away, after standing for a second.
Pose2D drive(double t)
{
  const double s = std::max(0.0, t - 1.0);
  if (s < 3) return {-2 + s, -0.5, 0};
  const double a = std::min((s - 3) / 1.2, 1.2), rest = std::max(0.0, s - 3 - 1.44);
  return {1 + 1.2 * std::sin(a) + rest * std::cos(1.2),
          0.7 - 1.2 * std::cos(a) + rest * std::sin(1.2), a};
}
}  // namespace

TEST(MovingObjects, NothingMovesWhereNothingMoves)
{
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const Moment& m : watch(Room{}, 8, {}, {}, seed))
    {
      EXPECT_TRUE(m.targets.empty()) << "seed " << seed << ", " << m.time << " s";
      EXPECT_EQ(std::count(m.moving.begin(), m.moving.end(), true), 0);
    }
}

TEST(MovingObjects, FollowsACarItsHeadingAndItsSpeed)
{
  Room room;
  room.car = drive;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
  {
    double squared = 0, heading = 0, speed = 0;
    int seen = 0, late = 0;
    for (const Moment& m : watch(room, 6, {}, {}, seed))
    {
      ASSERT_LE(m.targets.size(), 1u) << "seed " << seed << ", " << m.time << " s";
      if (m.time > 2.0) ++late;
      if (m.targets.empty() || m.time <= 2.0) continue;
      ++seen;
      const Pose2D truth = drive(m.time);
      const auto& t = m.targets[0];
      EXPECT_EQ(t.id, 0);
      squared += std::pow(t.pose.mean.x - truth.x, 2) + std::pow(t.pose.mean.y - truth.y, 2);
      heading += std::pow(math::wrapToPi(t.pose.mean.phi - truth.phi), 2);
      speed += std::pow(t.velocity.norm() - 1, 2);
      EXPECT_GT(math::smallestEigenvalue(t.pose.cov), 0);
    }
    EXPECT_EQ(seen, late) << "seed " << seed;
    EXPECT_LT(std::sqrt(squared / seen), 0.12) << "seed " << seed;
    EXPECT_LT(std::sqrt(heading / seen), 0.25) << "seed " << seed;
    EXPECT_LT(std::sqrt(speed / seen), 0.3) << "seed " << seed;
  }
}

TEST(MovingObjects, TheMiddleOfWhatIsSeenIsOffWhereTheBoxIsNot)
{
  Room room;
  room.car = drive;
  const auto error = [&](Shape shape)
  {
    MovingOptions options;
    options.shape = shape;
    options.length = {kLength, 0.02}, options.width = {kWidth, 0.02};
    double squared = 0;
    int seen = 0;
    for (const Moment& m : watch(room, 4, options))
      for (const auto& t : m.targets)
      {
        const Pose2D truth = drive(m.time);
        squared += std::pow(t.pose.mean.x - truth.x, 2) + std::pow(t.pose.mean.y - truth.y, 2);
        ++seen;
      }
    return std::sqrt(squared / std::max(seen, 1));
  };
  const double rectangle = error(Shape::kRectangle), centre = error(Shape::kCentre);
  EXPECT_LT(rectangle, 0.06);
  EXPECT_GT(centre, 0.12);
}

TEST(MovingObjects, TellsWhichBeamsMetTheCar)
{
  Room room;
  room.car = drive;
  const Moment last = watch(room, 3, {}).back();
  for (std::size_t i = 0; i < last.scan.ranges.size(); ++i)
  {
    const double a =
        last.robot.phi + last.scan.angleMin + static_cast<double>(i) * last.scan.angleStep;
    const Point2D at{last.robot.x + last.scan.ranges[i] * std::cos(a),
                     last.robot.y + last.scan.ranges[i] * std::sin(a)};
    const Pose2D car = drive(last.time);
    const Point2D local = math::transform(math::between(car, {0, 0, 0}), at);
    const bool onCar =
        std::abs(local.x) < 0.5 * kLength + 0.05 && std::abs(local.y) < 0.5 * kWidth + 0.05;
    EXPECT_EQ(last.moving[i], onCar) << "beam " << i;
  }
}

// A config's [start] may know the places and not the time, which counts from an epoch.
TEST(MovingObjects, FollowsAKnownTargetFromTheStartByItsIdentity)
{
  Room room;
  room.car = drive;
  core::Starts starts;
  starts.time = -1e9;
  core::ObjectStart& car = starts.targets[7];
  const Pose2D at = drive(0);
  car.value[core::ObjectStart::kX] = at.x;
  car.value[core::ObjectStart::kY] = at.y;
  car.value[core::ObjectStart::kTheta] = at.phi;
  for (const Moment& m : watch(room, 5, {}, starts))
  {
    ASSERT_EQ(m.targets.size(), 1u) << m.time;
    EXPECT_EQ(m.targets[0].id, 7);
    EXPECT_TRUE(m.targets[0].identified);
    const Pose2D truth = drive(m.time);
    EXPECT_LT(std::hypot(m.targets[0].pose.mean.x - truth.x, m.targets[0].pose.mean.y - truth.y),
              0.25)
        << m.time;
  }
}

TEST(MovingObjects, AKnownStartWithoutHeadingBecomesABoxOnceItMoves)
{
  Room room;
  room.car = drive;
  core::Starts starts;
  starts.time = 0;
  starts.targets[7].value[core::ObjectStart::kX] = drive(0).x;
  starts.targets[7].value[core::ObjectStart::kY] = drive(0).y;
  const auto moments = watch(room, 4, {}, starts);
  ASSERT_EQ(moments.back().targets.size(), 1u);
  EXPECT_EQ(moments.back().targets[0].id, 7);
  EXPECT_NEAR(math::wrapToPi(moments.back().targets[0].pose.mean.phi - drive(4).phi), 0, 0.3);
}

TEST(MovingObjects, GoesOnBehindAnObstacleAndIsTheSameAfterwards)
{
  Room room;
  room.robot = [](double) { return Pose2D{-1, -3, 0}; };
  room.car = [](double t) { return Pose2D{-4 + t, 1.5, 0}; };
  const auto screened = [&](double t)
  {
    moving::test::World world = Room{room.robot, room.car}.at(t);
    world.walls.push_back({{-1.3, -1}, {-0.6, -1}});  // hides the car for half a second
    return world;
  };
  MovingObjects objects(MovingOptions{}, {});
  objects.move({room.robot(0), Matrix3::Zero()}, 0);
  std::vector<int> ids;
  for (int i = 0; i * kStep <= 5.5; ++i)
  {
    objects.move({{}, 1e-8 * Matrix3::Identity()}, i == 0 ? 0 : kStep);
    objects.see(i * kStep, moving::test::lookRound(screened(i * kStep), room.robot(0), 0.01, i));
    for (const auto& t : objects.targets({room.robot(0), Matrix3::Zero()})) ids.push_back(t.id);
  }
  ASSERT_GT(ids.size(), 45u);
  EXPECT_EQ(std::count(ids.begin(), ids.end(), 0), static_cast<std::ptrdiff_t>(ids.size()));
}

TEST(MovingObjects, ATargetThatVanishesInPlainViewIsDropped)
{
  Room room;
  room.car = [](double t) { return t < 3 ? Pose2D{-2 + t, -0.5, 0} : Pose2D{100, 100, 0}; };
  const auto moments = watch(room, 4, {});
  const auto before = moments[static_cast<std::size_t>(2.9 / kStep)];
  EXPECT_EQ(before.targets.size(), 1u);
  EXPECT_TRUE(moments.back().targets.empty());
}

TEST(MovingObjects, ATargetIsDroppedAlsoWhereNoScanComesAnyMore)
{
  core::Starts starts;
  starts.targets[3].value[core::ObjectStart::kX] = 1;
  MovingObjects objects(MovingOptions{}, starts);
  objects.move({{}, Matrix3::Zero()}, 10);  // before the first scan it waits
  EXPECT_EQ(objects.targets({}).size(), 1u);
  objects.see(10, moving::test::lookRound(Room{}.at(0), {}, 0.01, 1));
  objects.move({{}, Matrix3::Zero()}, 1);
  EXPECT_EQ(objects.targets({}).size(), 1u);
  objects.move({{}, Matrix3::Zero()}, 1.5);
  EXPECT_TRUE(objects.targets({}).empty());
}

TEST(MovingObjects, TheRobotsUncertaintyIsItsTargetsToo)
{
  Room room;
  room.car = drive;
  MovingObjects objects(MovingOptions{}, {});
  objects.move({room.robot(0), Matrix3::Zero()}, 0);
  Pose2D before = room.robot(0);
  for (int i = 0; i * kStep <= 3; ++i)
  {
    const Pose2D now = room.robot(i * kStep);
    objects.move({math::between(before, now), 1e-6 * Matrix3::Identity()}, i == 0 ? 0 : kStep);
    before = now;
    objects.see(i * kStep, moving::test::lookRound(room.at(i * kStep), now, 0.01, i));
  }
  const auto sharp = objects.targets({before, Matrix3::Zero()});
  const Matrix3 robotCov = Vector3(0.04, 0.09, 0.01).asDiagonal();
  const auto blurred = objects.targets({before, robotCov});
  ASSERT_EQ(sharp.size(), 1u);
  const Matrix3 more = blurred[0].pose.cov - sharp[0].pose.cov;
  const double dx = sharp[0].pose.mean.x - before.x, dy = sharp[0].pose.mean.y - before.y;
  EXPECT_NEAR(more(0, 0), 0.04 + 0.01 * dy * dy, 1e-12);
  EXPECT_NEAR(more(1, 1), 0.09 + 0.01 * dx * dx, 1e-12);
  EXPECT_NEAR(more(2, 2), 0.01, 1e-12);
}

TEST(MovingObjects, EmptyAndStrangeScansAreTaken)
{
  MovingObjects objects(MovingOptions{}, {});
  core::LaserScan scan;
  EXPECT_TRUE(objects.see(0, scan).empty());
  scan.angleStep = 0.1, scan.rangeMax = 10;
  scan.ranges.assign(20, 0.0F);
  objects.move({{}, Matrix3::Zero()}, 0.1);
  EXPECT_EQ(objects.see(0.1, scan).size(), 20u);
  scan.ranges.assign(20, 1e9F);
  objects.move({{}, Matrix3::Zero()}, 1e6);
  EXPECT_EQ(objects.see(1e6, scan).size(), 20u);
}

// Measured: 0.05, 0.03, 0.07 and 0.11 m, no false track; see doc/moving-targets.md.
TEST(MovingObjects, FollowsRealCarsByLaserAlone)
{
  const std::filesystem::path data = std::filesystem::path(SLAMOT_REAL_DATA) / "scaled_cars";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no real data at " << data;
  for (const char* run : {"overtakes", "parallel_a", "two_robots"})
  {
    const auto import = importers::openScaledCars((data / run).string(), {});
    MovingOptions options;
    options.laser.maxRange = 8;
    options.length = {0.46, 0.03}, options.width = {0.22, 0.03};
    options.axleBehind = 0.16, options.reportAhead = -0.07;
    MovingObjects objects(options, import->starts());
    Gaussian<Pose2D> robot = import->starts().robotPose();
    std::size_t ids = 0, estimates = 0;
    double time = *import->starts().time, squared = 0;
    while (const auto step = import->next())
    {
      const auto increment = step->odometry.value_or(Gaussian<Pose2D>{});
      robot = math::compose(robot, increment);
      objects.move(increment, step->time - time);
      time = step->time;
      for (const auto& laser : step->lasers) objects.see(time, *laser);
      const auto truth = import->truth().robot.at(time, 0.1);
      for (const auto& t : objects.targets(robot))
      {
        ids = std::max(ids, static_cast<std::size_t>(t.id) + 1);
        if (!truth) continue;
        const Pose2D seen = math::between(robot.mean, t.pose.mean);
        double nearest = 1e9;
        for (const auto& [_, path] : import->truth().targets)
          if (const auto at = path.at(time, 0.1))
          {
            const Pose2D truly = math::between(truth->pose, at->pose);
            nearest = std::min(nearest, std::hypot(seen.x - truly.x, seen.y - truly.y));
          }
        if (nearest > 1e8) continue;
        squared += nearest * nearest;
        ++estimates;
      }
    }
    EXPECT_EQ(ids, import->truth().targets.size()) << run;
    EXPECT_LT(std::sqrt(squared / static_cast<double>(estimates)), 0.12) << run;
  }
}
