#include "glintWorld.h"

// w_t = w_(t-1)^alpha p(z | x): Zhu and Jin 2018.
namespace slamot::filters
{
namespace
{
using namespace test;

std::string keys(double alpha, double resampleBelow, const std::string& scheme = "systematic")
{
  return kPlaces + glint(0.3) + "weight_exponent = " + std::to_string(alpha) +
         "\nresample_below_ess = " + std::to_string(resampleBelow) + "\nresampling = " + scheme +
         "\n";
}

/// All that the filter tells, bit by bit, and its weights' figures.
std::string all(const std::string& k, const GlintRun& run)
{
  const auto filter = makeFilter("particle-tracker", k, run.context());
  std::string out;
  for (const core::Step& step : run.steps)
  {
    const auto d = filter->process(step).diagnostics;
    out += bytes(*filter) + std::to_string(*d.ess) + std::to_string(*d.largestWeight);
  }
  return out;
}

TEST(TrackersWeightExponent, HasNoEffectToTheBitWhereEveryScanResamples)
{
  for (const char* world : {"position", "polar"})
  {
    const GlintRun run(world, 3);
    for (const char* scheme : {"systematic", "stratified", "residual", "multinomial"})
    {
      const std::string one = all(keys(1, 1, scheme), run);
      for (const double alpha : {0.0, 0.3, 0.6, 0.95})
        EXPECT_EQ(all(keys(alpha, 1, scheme), run), one) << scheme << ' ' << alpha;
    }
  }
}

TEST(TrackersWeightExponent, ActsWhereWeightsLast)
{
  const GlintRun run("position", 3);
  EXPECT_NE(all(keys(0.9, 0.5), run), all(keys(1, 0.5), run));
  EXPECT_NE(all(keys(0.9, 0), run), all(keys(1, 0), run));
}

// With alpha = 0 and no resampling all that the past says is forgotten.
TEST(TrackersWeightExponent, OfZeroForgetsAllThatWasSeen)
{
  const GlintRun run("position", 3), other("position", 4);
  const auto a = makeFilter("particle-tracker", keys(0, 0), run.context());
  const auto b = makeFilter("particle-tracker", keys(0, 0), run.context());
  for (std::size_t i = 0; i < 20; ++i)
  {
    core::Step differs = run.steps[i];
    if (i < 19) differs.blobs = other.steps[i].blobs;
    (void)a->process(run.steps[i]);
    (void)b->process(differs);
    EXPECT_EQ(bytes(*a) == bytes(*b), i == 19) << i;
  }
}

// Weights w with exponent alpha at the second scan are those of p1^alpha p2.
TEST(TrackersWeightExponent, IsThatOfTheWeightsBefore)
{
  const auto ess = [](double alpha, int repeats)
  {
    GlintRun run("position", 3, {"target.acceleration_std_mps2=0", "world.steps=2"});
    const auto filter =
        makeFilter("particle-tracker",
                   "association = known\nobservation = position\ntarget_velocity_std_mps = 10\n"
                   "target_step_acceleration_std_mps2 = 0\ntarget_lost_std_m = "
                   "1e6\nresample_below_ess = 0\nweight_exponent = " +
                       std::to_string(alpha) + "\n",
                   run.context());
    core::Step step = run.steps[0];
    double out = 0;
    for (int i = 0; i < repeats; ++i)  // the same sighting of the same, standing, samples
      out = filter->process(step).diagnostics.ess.value();
    return out;
  };
  // p, then p^1.5 = p^0.5 p, then p^1.75: more uneven each time, and less than with alpha 1.
  EXPECT_EQ(ess(0.5, 1), ess(1, 1));
  EXPECT_LT(ess(0.5, 2), ess(0.5, 1));
  EXPECT_GT(ess(0.5, 2), ess(1, 2));
  EXPECT_LT(ess(0.5, 3), ess(0.5, 2));
  // Where p^(1 + 1/2 + 1/4 + ...) goes: p², which alpha 1 reaches with two sightings.
  EXPECT_NEAR(ess(0.5, 40), ess(1, 2), 1e-6);
}
}  // namespace
}  // namespace slamot::filters
