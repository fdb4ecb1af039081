#include "LinearSighting.h"
#include "filterRig.h"

#include <slamot/math/random.h>
#include <slamot/math/statistics.h>
#include <slamot/models/RangeBearing.h>

#include <Eigen/LU>

// Where the filter has nothing to guess, its numbers are those of a Kalman filter or of plain
// geometry.
namespace slamot::filters
{
namespace
{
using math::RandomStream;
using models::RangeBearing;
using test::landmarks;
using test::makeFilter;

const std::string kDamped = "target_velocity_std_mps = 1\ntarget_velocity_time_s = 1\n";

/// No gate to speak of: a Kalman filter has none.
std::string keys(const std::string& proposal, int particles = 1)
{
  return "particles = " + std::to_string(particles) + "\nproposal = " + proposal +
         "\nassociation = known\ngate_probability = 0.999999999999\n"
         "new_gate_probability = 0.999999999999\n";
}

core::FilterContext at(const Pose2D& pose)
{
  core::FilterContext c;
  c.starts.time = 0.0;
  c.starts.robot.emplace().value = {pose.x, pose.y, pose.phi};
  return c;
}

Vector2 noisy(const Vector2& z, double rangeStd, double bearingStd, RandomStream& random)
{
  return {z[0] + rangeStd * random.normal(), math::wrapToPi(z[1] + bearingStd * random.normal())};
}

class Proposal : public ::testing::TestWithParam<const char*>
{
};
INSTANTIATE_TEST_SUITE_P(Each, Proposal, ::testing::Values("motion", "informed"));

/// An EKF of one landmark, by the book.
struct LandmarkEkf
{
  Vector2 x;
  Matrix2 P;
  int sightings = 0, near = 0;
  void see(const Pose2D& pose, const Vector2& z, const RangeBearing& model)
  {
    if (sightings++ == 0)
    {
      const Point2D m = RangeBearing::invert(pose, z);
      const Matrix2 J = RangeBearing::invertJacobian(pose, z);
      x << m.x, m.y;
      P = J * model.noise() * J.transpose();
      return;
    }
    const auto l = test::linearise(pose, {x[0], x[1]}, P, z, model);
    const Matrix2 K = P * l.byPoint.transpose() * l.S(P).inverse();
    x += K * l.nu;
    P = ((Matrix2::Identity() - K * l.byPoint) * P).eval();
    near += l.near;
  }
};

/// The target's filter of Wu and Sun 2013, (13) to (18) as corrected: three states, with v and
/// omega known.
struct TargetEkf
{
  Vector3 x;
  Matrix3 P;
  void predict(double v, double w, double stdV, double stdW, double dt)
  {
    const double a = x[2] + w * dt, c = std::cos(a), s = std::sin(a);
    x += Vector3(v * dt * c, v * dt * s, w * dt);
    Matrix3 F;
    F << 1, 0, -v * dt * s, 0, 1, v * dt * c, 0, 0, 1;
    Eigen::Matrix<double, 3, 2> G;
    G << dt * c, -v * dt * dt * s, dt * s, v * dt * dt * c, 0, dt;
    const Matrix2 Q = Vector2(stdV * stdV, stdW * stdW).asDiagonal();
    P = (F * P * F.transpose() + G * Q * G.transpose()).eval();
  }
  [[nodiscard]] Point2D point() const { return {x[0], x[1]}; }
  [[nodiscard]] Matrix2 pointCov() const { return P.topLeftCorner<2, 2>(); }
  void see(const test::LinearSighting& l)
  {
    Eigen::Matrix<double, 2, 3> H = Eigen::Matrix<double, 2, 3>::Zero();
    H.leftCols<2>() = l.byPoint;
    const Eigen::Matrix<double, 3, 2> K = P * H.transpose() * l.S(pointCov()).inverse();
    x += K * l.nu;
    P = ((Matrix3::Identity() - K * H) * P).eval();
  }
};
}  // namespace

TEST_P(Proposal, OneParticleWithExactOdometryIsAnEkfPerLandmark)
{
  RandomStream random{1};
  Pose2D pose{2, -1, 3};
  const auto filter = makeFilter("rbpf-slamot", keys(GetParam()) + kDamped, at(pose));
  std::vector<Point2D> truth;
  // Half of them are close and seen by a coarse range: near, in terms of their deviations.
  for (int i = 0; i < 6; ++i)
  {
    const double reach = i % 2 ? 4 : 8;
    truth.push_back({random.uniform(-reach, reach), random.uniform(-reach, reach)});
  }
  std::vector<LandmarkEkf> ekf(truth.size());
  for (int i = 1; i <= 200; ++i)
  {
    core::Step step;
    step.time = 0.1 * i;
    step.odometry = math::turnThenMove(1.0, 0.3, 0.1, 0, 0);
    pose = math::compose(pose, step.odometry->mean);
    step.landmarks.emplace();
    for (std::size_t k = 0; k < truth.size(); ++k)
    {
      const double rangeStd = k % 2 ? 1.0 : 0.15;
      const Vector2 z = noisy(RangeBearing::predict(pose, truth[k]), rangeStd, 0.03, random);
      if (z[0] < 2 * rangeStd || random.uniform() < 0.3) continue;
      step.landmarks->sightings.push_back({z[0], z[1], rangeStd, 0.03, static_cast<int>(k)});
      ekf[k].see(pose, z, {rangeStd, 0.03});
    }
    const core::Estimate e = filter->process(step).estimate;
    ASSERT_NEAR(e.robot.mean.x, pose.x, 1e-9);
    ASSERT_NEAR(e.robot.mean.y, pose.y, 1e-9);
    ASSERT_LE(e.robot.cov.norm(), 1e-15);
    for (const auto& [id, l] : landmarks(e))
    {
      const LandmarkEkf& expected = ekf[static_cast<std::size_t>(id)];
      ASSERT_NEAR(l.position.mean.x, expected.x[0], 1e-9);
      ASSERT_NEAR(l.position.mean.y, expected.x[1], 1e-9);
      ASSERT_LE((l.position.cov - expected.P).norm(), 1e-9 * expected.P.norm());
      ASSERT_EQ(l.sightings, expected.sightings);
    }
  }
  EXPECT_EQ(landmarks(filter->estimate()).size(), truth.size());
  int seen = 0, near = 0;
  for (const LandmarkEkf& l : ekf) seen += l.sightings, near += l.near;
  EXPECT_GT(near, 100);
  EXPECT_GT(seen - near, 200);
}

// Sightings of a target that is always far, or always near, in terms of its deviations.
static void expectThePapersTargetEkf(const std::string& proposal, const RangeBearing& model,
                                     bool near)
{
  constexpr double v = 1.5, w = 0.4, dt = 0.1, stdV = 0.3, stdW = 0.2;
  RandomStream random{2};
  const double rangeStd = std::sqrt(model.noise()(0, 0)),
               bearingStd = std::sqrt(model.noise()(1, 1));
  core::FilterContext context = at({0, 0, 0});
  core::ObjectStart& start = context.starts.targets[7];
  start.value = {8.0, 1.0, 0.5};
  start.std = {0.1, 0.15, 0.1};
  const auto filter = makeFilter("rbpf-slamot",
                                 keys(proposal) +
                                     "target_motion = differential-drive\ntarget_speed_mps = 1.5\n"
                                     "target_turn_rate_deg_per_s = 22.918311805232928\n"
                                     "target_speed_noise_mps = 0.3\n"
                                     "target_turn_rate_noise_deg_per_s = 11.459155902616464\n",
                                 context);
  Pose2D pose, target{8.1, 0.8, 0.55};
  TargetEkf ekf{{8, 1, 0.5}, Vector3(0.01, 0.0225, 0.01).asDiagonal()};
  for (int i = 1; i <= 100; ++i)
  {
    core::Step step;
    step.time = dt * i;
    step.odometry = math::turnThenMove(1.2, 0.4, dt, 0, 0);
    pose = math::compose(pose, step.odometry->mean);
    target = math::compose(
        target,
        math::turnThenMove(v + stdV * random.normal(), w + stdW * random.normal(), dt, 0, 0).mean);
    ekf.predict(v, w, stdV, stdW, dt);
    const Vector2 z =
        noisy(RangeBearing::predict(pose, {target.x, target.y}), rangeStd, bearingStd, random);
    if (i % 4 == 0 && z[0] > 0)
    {
      step.blobs.emplace().blobs.push_back({"target", z[0], z[1], rangeStd, bearingStd, 7});
      const Point2D m = ekf.point();
      ASSERT_EQ(test::linearise(pose, m, ekf.pointCov(), z, model).near, near);
      ekf.see(near ? test::inRaysFrame(pose, m, z, model) : test::inPolar(pose, m, z, model));
    }
    const core::Estimate e = filter->process(step).estimate;
    ASSERT_EQ(e.targets.size(), 1u);
    const auto& got = e.targets[0].pose;
    ASSERT_NEAR(got.mean.x, ekf.x[0], 1e-9);
    ASSERT_NEAR(got.mean.y, ekf.x[1], 1e-9);
    ASSERT_NEAR(math::wrapToPi(got.mean.phi - ekf.x[2]), 0, 1e-9);
    ASSERT_LE((got.cov - ekf.P).norm(), 1e-9 * ekf.P.norm());
    ASSERT_EQ(e.targets[0].id, 7);
  }
}

TEST_P(Proposal, OneParticleWithExactOdometryIsThePapersTargetEkf)
{
  expectThePapersTargetEkf(GetParam(), {0.1, 0.02}, false);
}

// Equation (18)'s innovation then is the ray's; all else is the paper's.
TEST_P(Proposal, OneParticleWithExactOdometryIsATargetEkfAlongTheRayNearBy)
{
  expectThePapersTargetEkf(GetParam(), {1.3, 0.02}, true);
}

// Sightings far better than odometry leave nothing to chance: the pose is where they say.
TEST(RbpfSlamot, SightingsWithoutNoiseGiveTheExactPose)
{
  RandomStream random{3};
  const std::vector<Point2D> marks{{3, 1}, {-2, 4}, {1, -3}};
  for (const int particles : {1, 20})
    for (int trial = 0; trial < 20; ++trial)
    {
      const auto filter = makeFilter("rbpf-slamot", keys("informed", particles) + kDamped, at({}));
      Pose2D truth;
      for (int i = 0; i < 10; ++i)
      {
        core::Step step;
        step.time = i;
        if (i > 0)
        {
          step.odometry = Gaussian<Pose2D>{{0.1, 0.05, 0.2}, 1e-6 * Matrix3::Identity()};
          truth = math::compose(truth, {0.1 + 1e-3 * random.normal(), 0.05 + 1e-3 * random.normal(),
                                        0.2 + 1e-3 * random.normal()});
        }
        step.landmarks.emplace();
        for (std::size_t k = 0; k < marks.size(); ++k)
        {
          const Vector2 z = RangeBearing::predict(truth, marks[k]);
          step.landmarks->sightings.push_back({z[0], z[1], 1e-6, 1e-6, static_cast<int>(k)});
        }
        const core::Estimate e = filter->process(step).estimate;
        EXPECT_NEAR(e.robot.mean.x, truth.x, 3e-5);
        EXPECT_NEAR(e.robot.mean.y, truth.y, 3e-5);
        EXPECT_NEAR(math::wrapToPi(e.robot.mean.phi - truth.phi), 0, 3e-5);
      }
      for (const auto& [id, l] : landmarks(filter->estimate()))
      {
        EXPECT_NEAR(l.position.mean.x, marks[static_cast<std::size_t>(id)].x, 3e-5);
        EXPECT_NEAR(l.position.mean.y, marks[static_cast<std::size_t>(id)].y, 3e-5);
      }
    }
}

// One landmark tells two of the pose's three numbers; with the heading known it tells the place.
TEST(RbpfSlamot, OneLandmarkGivesThePlaceWhereTheHeadingIsKnown)
{
  const auto filter = makeFilter("rbpf-slamot", keys("informed", 10) + kDamped, at({}));
  const Point2D mark{2, 1};
  for (int i = 0; i < 2; ++i)
  {
    core::Step step;
    step.time = i;
    Matrix3 cov = Vector3(1e-6, 1e-6, 0).asDiagonal();
    step.odometry = Gaussian<Pose2D>{{double(i), 0, 0}, i * cov};
    const Vector2 z = RangeBearing::predict({i * 1.001, i * -0.0005, 0}, mark);
    step.landmarks.emplace().sightings.push_back({z[0], z[1], 1e-6, 1e-6, 0});
    (void)filter->process(step);
  }
  const auto robot = filter->estimate().robot;
  EXPECT_NEAR(robot.mean.x, 1.001, 1e-5);
  EXPECT_NEAR(robot.mean.y, -0.0005, 1e-5);
  EXPECT_EQ(robot.mean.phi, 0);
  EXPECT_LT(robot.cov.norm(), 1e-10);
}

// Motion's proposal only samples odometry: without sightings that is all there is.
TEST_P(Proposal, WithoutSightingsIsOdometry)
{
  constexpr int kParticles = 4000;
  core::FilterContext context = at({1, 2, 0.5});
  context.starts.robot->std = {0.1, 0.2, 0.05};
  const auto filter = makeFilter("rbpf-slamot", keys(GetParam(), kParticles) + kDamped, context);
  Gaussian<Pose2D> expected = context.starts.robotPose();
  EXPECT_NEAR(filter->estimate().robot.cov(1, 1), 0.04, 0.005);
  for (int i = 1; i <= 20; ++i)
  {
    core::Step step;
    step.time = i;
    step.odometry = math::turnThenMove(0.2, 0.05, 1, 0.02, 0.005);
    if (i % 5 == 0) step.landmarks.emplace();  // a scan that saw nothing changes nothing
    expected = math::compose(expected, *step.odometry);
    (void)filter->process(step);
  }
  const auto robot = filter->estimate().robot;
  const Vector3 e(robot.mean.x - expected.mean.x, robot.mean.y - expected.mean.y,
                  robot.mean.phi - expected.mean.phi);
  const bool informed = std::string(GetParam()) == "informed";
  // Samples' mean and spread (but for terms of second order): five deviations of each.
  const double share = informed ? 1e-9 : 1.0 / kParticles;
  EXPECT_LT(math::mahalanobisSquared(e, share * expected.cov),
            informed ? 1 : math::chiSquareQuantile(0.99999, 3) + 5);
  const double tolerance = informed ? 1e-9 : 5 * std::sqrt(2.0 / kParticles) + 0.03;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(robot.cov(i, i) / expected.cov(i, i), 1, tolerance);
}
}  // namespace slamot::filters
