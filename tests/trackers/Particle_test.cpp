#include "referenceKalman.h"

namespace slamot::filters
{
namespace
{
using namespace test;
using models::NoiseLaw;

std::string particles(int n, double resampleBelow)
{
  return "particles = " + std::to_string(n) +
         "\nresample_below_ess = " + std::to_string(resampleBelow) + "\n";
}

// Linear and normal: the Kalman filter is exact.  A mean over N samples scatters by P / N, times
// what weights and resampling lose; five deviations of that.
TEST(ParticleTracker, ConvergesToTheKalmanFilter)
{
  constexpr int kSamples = 40000;
  const GlintRun run("position", 3, {"target_sensor.glint_probability=0", "world.steps=12"});
  for (const double resampleBelow : {0.0, 0.5, 1.0})
  {
    const auto filter =
        makeFilter("particle-tracker", kPlaces + particles(kSamples, resampleBelow), run.context());
    Kalman exact(run.starts.targets.at(1));
    for (const core::Step& step : run.steps)
    {
      exact.predict(1, 0.1);
      exact.updatePlace(step.blobs->blobs.at(0), 100);
      const auto update = filter->process(step);
      const double lost = std::sqrt(10.0 / kSamples);
      expectNear(update.estimate.targets.at(0), exact, 5 * lost * std::sqrt(exact.P(0, 0)),
                 5 * lost * std::sqrt(exact.P(2, 2)), 5 * lost);
    }
  }
}

// With glint the posterior of three steps is a sum of 8³ Gaussians, each a Kalman filter's.
TEST(ParticleTracker, ConvergesToThePosteriorUnderGlint)
{
  constexpr int kSamples = 40000;
  const NoiseLaw law({0.3, NoiseLaw::Tail::kStudent, 3, 2});
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
  {
    const GlintRun run("position", seed, {"world.steps=3", "target_sensor.glint_probability=0.9"});
    const auto filter = makeFilter("particle-tracker",
                                   kPlaces + glint(0.3) + particles(kSamples, 0.5), run.context());
    std::vector<Kalman> exact = {Kalman(run.starts.targets.at(1))};
    for (const core::Step& step : run.steps)
    {
      for (Kalman& k : exact) k.predict(1, 0.1);
      exact = split(exact, step.blobs->blobs.at(0), law);
      const Kalman whole = merged(exact);
      const double lost = std::sqrt(10.0 / kSamples);
      expectNear(filter->process(step).estimate.targets.at(0), whole,
                 5 * lost * std::sqrt(whole.P(0, 0)), 5 * lost * std::sqrt(whole.P(2, 2)),
                 5 * lost);
    }
  }
}

TEST(ParticleTracker, IsTheSameWithAnyNumberOfThreads)
{
  const GlintRun run("polar", 2);
  std::string first;
  for (const int threads : {1, 2})
  {
    const auto filter =
        makeFilter("particle-tracker", kGlintKeys + glint(0.3), run.context(7, threads));
    std::string all;
    for (const core::Step& step : run.steps)
    {
      (void)filter->process(step);
      all += bytes(*filter);
    }
    if (first.empty()) first = all;
    EXPECT_EQ(all, first);
  }
}

TEST(ParticleTracker, TellsItsWeights)
{
  const GlintRun run("position", 2);
  const auto filter =
      makeFilter("particle-tracker", kPlaces + glint(0.3) + particles(300, 0.5), run.context());
  int resampled = 0;
  for (const core::Step& step : run.steps)
  {
    const core::Diagnostics d = filter->process(step).diagnostics;
    EXPECT_EQ(d.particles, 300);
    ASSERT_TRUE(d.ess && d.largestWeight);
    EXPECT_GE(*d.ess, 1);
    EXPECT_LE(*d.ess, 300);
    EXPECT_GE(*d.largestWeight, 1.0 / 300);
    EXPECT_LE(*d.largestWeight, 1);
    EXPECT_LE(*d.largestWeight, 1 / std::sqrt(*d.ess) + 1e-12);  // its square is one of the sum's
    EXPECT_EQ(d.resampled, *d.ess < 150);
    resampled += d.resampled;
  }
  EXPECT_GT(resampled, 10);
  EXPECT_LT(resampled, 90);
  // A step without blobs weighs nothing.
  core::Step empty;
  empty.time = run.steps.back().time + 1;
  const core::Diagnostics d = filter->process(empty).diagnostics;
  EXPECT_FALSE(d.ess || d.largestWeight || d.resampled);
}

// A bearing alone tells nothing along the ray, and much across it.
TEST(ParticleTracker, WeighsBearings)
{
  const GlintRun run(
      "polar", 2,
      {"world.steps=1", "target_sensor.glint_probability=0", "target_sensor.bearing_only=true"});
  const auto filter =
      makeFilter("particle-tracker", kPlaces + particles(20000, 0.5), run.context());
  const auto e = filter->process(run.steps.at(0)).estimate.targets.at(0);
  const Matrix2 P = e.pose.cov.topLeftCorner<2, 2>();
  const double along = 0.5 * (P(0, 0) + P(1, 1)) + P(0, 1);  // the target is at 45 degrees
  const double across = 0.5 * (P(0, 0) + P(1, 1)) - P(0, 1);
  EXPECT_NEAR(along, 101, 8);
  EXPECT_NEAR(across, 1 / (1 / 101.0 + 1 / std::pow(0.01 * 717, 2)), 3);
}

// A first blob may be an outlier: samples know.
TEST(ParticleTracker, IsBornAsWideAsTheLaw)
{
  const GlintRun run("position", 1, {"target.start_known=false"});
  const auto narrow = makeFilter("particle-tracker", kPlaces + particles(5000, 0.5), run.context());
  const auto wide =
      makeFilter("particle-tracker", kPlaces + glint(0.3) + particles(5000, 0.5), run.context());
  const auto a = narrow->process(run.steps[0]).estimate.targets.at(0);
  const auto b = wide->process(run.steps[0]).estimate.targets.at(0);
  EXPECT_NEAR(a.pose.cov(0, 0), 100, 10);
  EXPECT_GT(b.pose.cov(0, 0), 300);
  EXPECT_NEAR(a.velocityCov(0, 0), 100, 10);
}

TEST(ParticleTracker, HoldsOutAgainstGlintWhereANormalLikelihoodDoesNot)
{
  double robust = 0, normal = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    const GlintRun run("position", seed);
    robust += rmse(
        follow(*makeFilter("particle-tracker", kPlaces + glint(0.3), run.context()), run), run);
    normal += rmse(follow(*makeFilter("particle-tracker", kPlaces, run.context()), run), run);
  }
  EXPECT_LT(1.3 * robust, normal);
}
}  // namespace
}  // namespace slamot::filters
