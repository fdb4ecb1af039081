#include "referenceKalman.h"

#include <slamot/core/Error.h>

namespace slamot::filters
{
namespace
{
using namespace test;
using models::NoiseLaw;

const NoiseLaw kLaw({0.3, NoiseLaw::Tail::kStudent, 3, 2});

TEST(KalmanTracker, OfPlacesIsTheKalmanFilter)
{
  const GlintRun run("position", 2);
  const auto filter = makeFilter("kalman-tracker", kPlaces, run.context());
  Kalman reference(run.starts.targets.at(1));
  for (const core::Step& step : run.steps)
  {
    reference.predict(1, 0.1);
    reference.updatePlace(step.blobs->blobs.at(0), 100);
    expectNear(filter->process(step).estimate.targets.at(0), reference, 1e-8, 1e-8, 1e-9);
  }
}

TEST(KalmanTracker, OfRangeAndBearingIsTheExtendedKalmanFilter)
{
  const GlintRun run("polar", 2);
  const auto filter = makeFilter("kalman-tracker", kGlintKeys, run.context());
  Kalman reference(run.starts.targets.at(1));
  for (const core::Step& step : run.steps)
  {
    reference.predict(1, 0.1);
    reference.updatePolar(step.blobs->blobs.at(0));
    expectNear(filter->process(step).estimate.targets.at(0), reference, 1e-7, 1e-7, 1e-8);
  }
}

// One step: the mixture's own moments, mixed from exact updates by each of its Gaussians.
TEST(ImmTracker, TakesAPlaceInByAllGaussiansOfTheLaw)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    const GlintRun run("position", seed);
    const auto filter = makeFilter("imm-tracker", kPlaces + glint(0.3), run.context());
    Kalman start(run.starts.targets.at(1));
    for (const core::Step& step : run.steps)
    {
      start.predict(1, 0.1);
      start = merged(split({start}, step.blobs->blobs.at(0), kLaw));
      expectNear(filter->process(step).estimate.targets.at(0), start, 1e-6, 1e-6, 1e-7);
    }
  }
}

// The same by a grid over the plane, with nothing of Kalman's.
TEST(ImmTracker, HasThePosteriorOfOneStep)
{
  const GlintRun run("position", 5);
  const auto filter = makeFilter("imm-tracker", kPlaces + glint(0.3), run.context());
  Kalman prior(run.starts.targets.at(1));
  prior.predict(1, 0.1);
  const Matrix2 information = prior.P.topLeftCorner<2, 2>().inverse();
  core::Step step = run.steps[0];
  // Between prior and outlier: the Gaussians disagree.
  step.blobs->blobs[0].range = *step.blobs->blobs[0].range + 35;
  step.blobs->blobs[0].bearingStd = 10 / *step.blobs->blobs[0].range;
  const core::Blob& b = step.blobs->blobs[0];
  const double a = math::kPi / 4 + b.bearing;
  const Vector2 z(*b.range * std::cos(a), *b.range * std::sin(a));
  double sum = 0;
  Vector2 mean = Vector2::Zero();
  Matrix2 second = Matrix2::Zero();
  for (double dx = -90; dx <= 90; dx += 0.5)
    for (double dy = -90; dy <= 90; dy += 0.5)
    {
      const Vector2 d(dx, dy), w = z - prior.x.head<2>() - d;
      double p = 0;
      for (const auto& c : kLaw.components())
        p += c.weight / c.factor * std::exp(-0.5 * w.squaredNorm() / (100 * c.factor));
      p *= std::exp(-0.5 * d.dot(information * d));
      sum += p;
      mean += p * d;
      second += p * d * d.transpose();
    }
  mean /= sum;
  const Matrix2 cov = second / sum - mean * mean.transpose();
  const auto e = filter->process(step).estimate.targets.at(0);
  EXPECT_NEAR(e.pose.mean.x, prior.x[0] + mean.x(), 1e-3);
  EXPECT_NEAR(e.pose.mean.y, prior.x[1] + mean.y(), 1e-3);
  const Matrix2 got = e.pose.cov.topLeftCorner<2, 2>();
  EXPECT_LE((got - cov).norm(), 1e-3 * cov.norm());
}

TEST(ImmTracker, IsTheKalmanTrackerWithALaw)
{
  const GlintRun run("polar", 3);
  const auto all = [&](const std::string& name, const std::string& keys)
  {
    const auto filter = makeFilter(name, keys, run.context());
    std::string out;
    for (const core::Step& step : run.steps)
    {
      (void)filter->process(step);
      out += bytes(*filter);
    }
    return out;
  };
  const std::string usual = all("imm-tracker", kGlintKeys);
  EXPECT_EQ(usual, all("kalman-tracker", kGlintKeys + glint(0.1)));
  const std::string none = all("kalman-tracker", kGlintKeys);
  EXPECT_NE(usual, none);
  EXPECT_EQ(none, all("imm-tracker", kGlintKeys + glint(0)));
  EXPECT_EQ(none, all("imm-tracker", kGlintKeys + "likelihood = gaussian\n"));
}

// Over seeds, as doubtful as it is wrong; the plain Kalman filter believes far too much.
TEST(ImmTracker, IsConsistentUnderGlint)
{
  double imm = 0, plain = 0;
  constexpr int kRuns = 60;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed)
  {
    const GlintRun run("position", seed);
    const auto nees = [&](const std::string& name, const std::string& keys)
    {
      const auto e = follow(*makeFilter(name, keys, run.context()), run).back();
      const Vector2 d(e.pose.mean.x - run.truth.back().pose.x,
                      e.pose.mean.y - run.truth.back().pose.y);
      const Matrix2 P = e.pose.cov.topLeftCorner<2, 2>();
      return d.dot(P.inverse() * d) / (2 * kRuns);
    };
    imm += nees("imm-tracker", kPlaces + glint(0.3));
    plain += nees("kalman-tracker", kPlaces);
  }
  EXPECT_GT(imm, 0.7);
  EXPECT_LT(imm, 1.35);
  EXPECT_GT(plain, 2);
}

TEST(KalmanTracker, FollowsByEveryModelOfMotion)
{
  const GlintRun run("position", 4);
  const auto filter =
      makeFilter("imm-tracker",
                 "association = known\nobservation = position\ntarget_lost_std_m = 1e6\n"
                 "target_motion = constant-acceleration\ntarget_velocity_std_mps = 10\n"
                 "target_acceleration_std_mps2 = 0.2\ntarget_jerk_noise_mps3_per_sqrt_hz = 0.02\n" +
                     glint(0.3),
                 run.context());
  EXPECT_LT(rmse(follow(*filter, run), run), 10);
}

// Modes of noise and of motion together: a target that turns now left, now right, under glint.
TEST(ImmTracker, FollowsATargetThatManoeuvres)
{
  const std::string keys = "association = known\nobservation = position\n" + glint(0.3) +
                           "target_lost_std_m = 1e6\ntarget_velocity_std_mps = 10\n";
  double bank = 0, single = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    const GlintRun run("position", seed,
                       {"target.motion=manoeuvre", "target.turn_rate_radps=0.1",
                        "target.switch_min_s=10", "target.switch_max_s=20"});
    bank +=
        rmse(follow(*makeFilter("imm-tracker",
                                keys + "target_motion = manoeuvring\n"
                                       "target_modes = constant-velocity, left-turn, right-turn\n"
                                       "target_mode_time_s = 15\n"
                                       "target_turn_rate_deg_per_s = 5.729578\n"
                                       "target_acceleration_std_mps2 = 1\n"
                                       "target_velocity_noise_mps_per_sqrt_hz = 0.1\n"
                                       "target_heading_walk_deg_per_sqrt_s = 0.5\n"
                                       "target_acceleration_noise_mps2_per_sqrt_hz = 0.02\n",
                                run.context()),
                    run),
             run);
    single +=
        rmse(follow(*makeFilter("imm-tracker", keys + "target_step_acceleration_std_mps2 = 0.7\n",
                                run.context()),
                    run),
             run);
  }
  EXPECT_LT(bank, 0.85 * single);
}

TEST(KalmanTracker, ScalesTheNoiseThatTheLogTells)
{
  const GlintRun run("position", 2);
  const auto filter = makeFilter("kalman-tracker", kPlaces + "noise_scale = 2\n", run.context());
  Kalman reference(run.starts.targets.at(1));
  for (const core::Step& step : run.steps)
  {
    reference.predict(1, 0.1);
    reference.updatePlace(step.blobs->blobs.at(0), 400);
    expectNear(filter->process(step).estimate.targets.at(0), reference, 1e-8, 1e-8, 1e-9);
  }
}
}  // namespace
}  // namespace slamot::filters
