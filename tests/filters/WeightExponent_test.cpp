#include "filterRig.h"

#include <slamot/laws/Drive.h>

// w_t = w_(t-1)^alpha p(z | x): Zhu and Jin 2018.
namespace slamot::filters
{
namespace
{
struct Path
{
  std::vector<Pose2D> poses;
  std::vector<double> ess;
};

Path run(double exponent, double resampleBelow)
{
  laws::World world;
  const laws::Drive drive = laws::drive(world, 3);
  core::FilterContext context;
  context.starts = drive.starts;
  const auto filter = test::makeFilter(
      "rbpf-slamot",
      "particles = 50\nproposal = motion\nassociation = known\ntarget_velocity_std_mps = 1\n"
      "target_velocity_time_s = 2\nweight_exponent = " +
          std::to_string(exponent) + "\nresample_below_ess = " + std::to_string(resampleBelow),
      context);
  Path out;
  for (const core::Step& step : drive.steps)
  {
    const core::Update u = filter->process(step);
    out.poses.push_back(u.estimate.robot.mean);
    const core::Diagnostics& d = u.diagnostics;
    EXPECT_EQ(d.ess.has_value(), d.largestWeight.has_value());
    if (!d.ess) continue;
    out.ess.push_back(*d.ess);
    EXPECT_GE(*d.largestWeight, 1 / *d.ess - 1e-12);  // the mean of weights, by themselves
    EXPECT_LE(*d.largestWeight, 1 / std::sqrt(*d.ess) + 1e-12);  // its square is one of the sum's
  }
  return out;
}

bool same(const Path& a, const Path& b)
{
  for (std::size_t i = 0; i < a.poses.size(); ++i)
    if (a.poses[i].x != b.poses[i].x || a.poses[i].y != b.poses[i].y ||
        a.poses[i].phi != b.poses[i].phi)
      return false;
  return a.ess == b.ess;
}

double mean(const std::vector<double>& v)
{
  double sum = 0;
  for (const double x : v) sum += x;
  return sum / static_cast<double>(v.size());
}
}  // namespace

TEST(WeightExponent, HasNoEffectToTheBitWhereEveryScanResamples)
{
  const Path one = run(1, 1);
  for (const double alpha : {0.0, 0.3, 0.95}) EXPECT_TRUE(same(run(alpha, 1), one)) << alpha;
}

TEST(WeightExponent, KeepsMoreParticlesAliveWhereNoneResample)
{
  const double forgetful = mean(run(0.5, 0).ess), one = mean(run(1, 0).ess);
  EXPECT_GT(forgetful, one);
}

TEST(WeightExponent, ZeroWeighsByTheLastScanAlone)
{
  // With no past, what is left of the weights is that of one scan: as if it had just resampled.
  EXPECT_GT(mean(run(0, 0).ess), mean(run(1, 0).ess));
  EXPECT_FALSE(same(run(0, 0), run(1, 0)));
}
}  // namespace slamot::filters
