#include "worlds.h"

#include <slamot/math/statistics.h>

namespace slamot::sim
{
namespace
{
using test::scenario;

// Standard normal deviates, tested with fixed seeds against bounds that one set in 5000 would miss.
class Deviates
{
 public:
  void add(double d) { sum_ += d, squares_ += d * d, ++n_; }
  void expectStandardNormal(int atLeast) const
  {
    EXPECT_GE(n_, atLeast);
    EXPECT_LT(std::abs(sum_) / std::sqrt(double(n_)), 3.9);
    EXPECT_GT(squares_, math::chiSquareQuantile(5e-5, n_));
    EXPECT_LT(squares_, math::chiSquareQuantile(1 - 5e-5, n_));
  }

 private:
  double sum_ = 0, squares_ = 0;
  int n_ = 0;
};

// Speed and turn rate between two true poses 0.025 s apart.
Vector2 executed(const Pose2D& a, const Pose2D& b)
{
  const Pose2D d = math::between(a, b);
  return {(d.x * std::cos(d.phi) + d.y * std::sin(d.phi)) / 0.025, d.phi / 0.025};
}

TEST(Noise, OfMotionHasTheScenariosDeviations)
{
  World world(scenario({"world.steps=4000"}), 11);
  Deviates robotV, robotOmega, targetV, targetOmega;
  for (int i = 0; i < 4000; ++i)
  {
    const auto step = world.next();
    const auto& robot = world.truth().robot.poses;
    const auto& target = world.truth().targets.at(1).poses;
    const std::size_t k = robot.size() - 1;
    const Vector2 told = executed({}, step->odometry->mean);
    const Vector2 r = executed(robot[k - 1].pose, robot[k].pose) - told;
    const Vector2 t = executed(target[k - 1].pose, target[k].pose) - Vector2(2, 2.0 / 3);
    robotV.add(r[0] / 0.4);
    robotOmega.add(r[1] / 0.0872);
    targetV.add(t[0] / 0.8);
    targetOmega.add(t[1] / 0.6);
  }
  robotV.expectStandardNormal(4000);
  robotOmega.expectStandardNormal(4000);
  targetV.expectStandardNormal(4000);
  targetOmega.expectStandardNormal(4000);
}

TEST(Noise, OfMotionIsWhatOdometrysCovarianceSays)
{
  // The executed increment, seen from the command, in the two directions that have any variance.
  World world(scenario({"world.steps=4000"}), 12);
  double sum = 0;
  for (int i = 0; i < 4000; ++i)
  {
    const auto step = world.next();
    const auto& robot = world.truth().robot.poses;
    const Pose2D d = math::between(robot[robot.size() - 2].pose, robot.back().pose);
    const Pose2D& m = step->odometry->mean;
    const double c = std::cos(m.phi), s = std::sin(m.phi);
    const Vector2 e{c * (d.x - m.x) + s * (d.y - m.y), d.phi - m.phi};  // along, turn
    Eigen::Matrix<double, 2, 3> A;
    A << c, s, 0, 0, 0, 1;
    const Matrix2 P = A * step->odometry->cov * A.transpose();
    sum += math::mahalanobisSquared(e, P);
  }
  EXPECT_GT(sum, math::chiSquareQuantile(1e-4, 8000));
  EXPECT_LT(sum, math::chiSquareQuantile(1 - 1e-4, 8000));
}

TEST(Noise, OfSightingsHasTheScenariosDeviations)
{
  // A range that nothing leaves, so that nothing is dropped.
  World world(scenario({"landmark_sensor.range_max_m=100", "target_sensor.range_max_m=100",
                        "world.landmarks=50", "world.steps=800"}),
              13);
  Deviates range, bearing, blobRange, blobBearing;
  while (const auto step = world.next())
  {
    if (!step->landmarks) continue;
    const Pose2D robot = world.truth().robot.poses.back().pose;
    const Pose2D target = world.truth().targets.at(1).poses.back().pose;
    for (const core::Sighting& s : step->landmarks->sightings)
    {
      const auto z = models::RangeBearing::predict(robot, world.truth().landmarks.at(s.id));
      range.add((s.range - z[0]) / s.rangeStd);
      bearing.add(math::wrapToPi(s.bearing - z[1]) / s.bearingStd);
      EXPECT_EQ(s.rangeStd, 0.1);
      EXPECT_EQ(s.bearingStd, 0.008);
    }
    const core::Blob& blob = step->blobs->blobs.at(0);
    const auto z = models::RangeBearing::predict(robot, {target.x, target.y});
    blobRange.add((*blob.range - z[0]) / 0.1);
    blobBearing.add(math::wrapToPi(blob.bearing - z[1]) / 0.008);
  }
  range.expectStandardNormal(4990);
  bearing.expectStandardNormal(4990);
  blobRange.expectStandardNormal(100);
  blobBearing.expectStandardNormal(100);
}

TEST(Noise, OfStartsHasTheScenariosDeviations)
{
  const Scenario s =
      scenario({"target.start_std_velocity_mps=0.2", "robot.start_std_theta_rad=0.3"});
  using Start = core::ObjectStart;
  Deviates x, y, theta, vx, robotTheta;
  for (std::uint64_t seed = 1; seed <= 500; ++seed)
  {
    World world(s, seed);
    const Pose2D truth = world.truth().targets.at(1).poses[0].pose;
    const Pose2D robot = world.truth().robot.poses[0].pose;
    const Start& told = world.starts().targets.at(1);
    EXPECT_EQ(told.getStd(Start::kX), 0.1);
    x.add((told.get(Start::kX) - truth.x) / 0.1);
    y.add((told.get(Start::kY) - truth.y) / 0.1);
    theta.add(math::wrapToPi(told.get(Start::kTheta) - truth.phi) / 0.1);
    vx.add((told.get(Start::kVx) - 2 * std::cos(truth.phi)) / 0.2);
    EXPECT_EQ(world.starts().robotPose().mean.x, robot.x);
    robotTheta.add(math::wrapToPi(world.starts().robotPose().mean.phi - robot.phi) / 0.3);
  }
  for (const Deviates& d : {x, y, theta, vx, robotTheta}) d.expectStandardNormal(500);
}

TEST(Noise, DetectionAndClutterHaveTheScenariosRates)
{
  World world(
      scenario({"landmark_sensor.range_max_m=100", "landmark_sensor.detection_probability=0.7",
                "landmark_sensor.clutter_per_scan=3", "target_sensor.clutter_per_scan=0.5",
                "target_sensor.detection_probability=0.4", "target_sensor.range_max_m=50",
                "world.landmarks=10", "world.steps=2000", "world.scan_every=1"}),
      14);
  const int scans = 2000;
  double seen = 0, clutter = 0, ranges = 0, bearings = 0, blobs = 0, falseBlobs = 0;
  while (const auto step = world.next())
  {
    for (const core::Sighting& s : step->landmarks->sightings)
    {
      if (s.id >= 0)
      {
        ++seen;
        continue;
      }
      ++clutter;
      ranges += s.range;
      bearings += s.bearing;
    }
    for (const core::Blob& b : step->blobs->blobs) ++(b.id >= 0 ? blobs : falseBlobs);
  }
  // Within 4 deviations of binomial, Poisson and uniform means.
  EXPECT_NEAR(seen, scans * 7, 4 * std::sqrt(scans * 10 * 0.7 * 0.3));
  EXPECT_NEAR(blobs, scans * 0.4, 4 * std::sqrt(scans * 0.4 * 0.6));
  EXPECT_NEAR(clutter, scans * 3, 4 * std::sqrt(scans * 3));
  EXPECT_NEAR(falseBlobs, scans * 0.5, 4 * std::sqrt(scans * 0.5));
  EXPECT_NEAR(ranges / clutter, 50, 4 * 100 / std::sqrt(12 * clutter));
  EXPECT_NEAR(bearings / clutter, 0, 4 * math::kTwoPi / std::sqrt(12 * clutter));
}

TEST(Noise, LandmarksAreUniformAndKeepTheirDistance)
{
  const World world(scenario({"world.landmarks=2000"}), 15);
  double x = 0, y = 0;
  for (const auto& [id, p] : world.truth().landmarks)
  {
    EXPECT_TRUE(Area{}.contains(p));
    x += p.x / 2000;
    y += p.y / 2000;
  }
  EXPECT_NEAR(x, 5, 4 * 10 / std::sqrt(12.0 * 2000));
  EXPECT_NEAR(y, 5, 4 * 10 / std::sqrt(12.0 * 2000));

  const World spaced(scenario({"world.landmarks=30", "world.landmark_spacing_min_m=1"}), 15);
  const auto& all = spaced.truth().landmarks;
  for (const auto& [i, p] : all)
    for (const auto& [j, q] : all) EXPECT_TRUE(i >= j || std::hypot(p.x - q.x, p.y - q.y) >= 1);
}
}  // namespace
}  // namespace slamot::sim
