#include "Snapshot.h"
#include "laws.h"

namespace slamot::laws
{
namespace
{
constexpr std::uint64_t kSeed = 1;
const Pose2D kMove{3.0, -5.0, 2.0};

/// Rotated beliefs to rounding, step by step.
Broken rotatesExactly(const Subject& subject)
{
  const Drive d = drive(subject.options.world, kSeed);
  const Drive rotated = drive(subject.options.world, kSeed, kMove);
  const auto filter = subject.make(d.starts, kSeed), other = subject.make(rotated.starts, kSeed);
  for (std::size_t i = 0; i < d.steps.size(); ++i)
  {
    const Snapshot expected = moved(snapshot(filter->process(d.steps[i]).estimate), kMove);
    const Snapshot got = snapshot(other->process(rotated.steps[i]).estimate);
    const std::string what = difference(expected, got, 1e-6);
    if (!what.empty()) return atStep(kSeed, i) + what;
  }
  return {};
}

core::Estimate lastEstimate(const Subject& subject, const Drive& d, std::uint64_t seed)
{
  const auto filter = subject.make(d.starts, seed);
  for (const core::Step& step : d.steps) (void)filter->process(step);
  core::Estimate e = filter->estimate();
  e.landmarks = nullptr;
  return e;
}

/// The mean difference over the runs is no further from zero than chance allows.
Broken rotatesOnAverage(const Subject& subject)
{
  Vector3 sum = Vector3::Zero(), squares = Vector3::Zero();
  const int n = subject.options.runs;
  for (int seed = 1; seed <= n; ++seed)
  {
    const Drive d = drive(subject.options.world, seed);
    const Drive rotated = drive(subject.options.world, seed, kMove);
    const Pose2D expected = math::compose(kMove, lastEstimate(subject, d, seed).robot.mean);
    const Pose2D e = math::between(expected, lastEstimate(subject, rotated, seed).robot.mean);
    const Vector3 difference(e.x, e.y, e.phi);
    sum += difference;
    squares += difference.cwiseAbs2();
  }
  for (int i = 0; i < 3; ++i)
  {
    const double mean = sum[i] / n, variance = squares[i] / n - mean * mean;
    if (!(std::abs(mean) <= 4.5 * std::sqrt(std::max(variance, 0.0) / n) + 1e-9))
      return "coordinate " + std::to_string(i) + " differs by " + std::to_string(mean) +
             " on average";
  }
  return {};
}
}  // namespace

Broken equalSeedsGiveEqualBytes(const Subject& subject)
{
  const Drive d = drive(subject.options.world, kSeed);
  for (const int threads : {1, 2, 3})
  {
    const auto filter = subject.make(d.starts, kSeed),
               other = subject.make(d.starts, kSeed, threads);
    for (std::size_t i = 0; i < d.steps.size(); ++i)
      if (bytes(filter->process(d.steps[i])) != bytes(other->process(d.steps[i])) ||
          bytes(*filter) != bytes(*other))
        return atStep(kSeed, i) + "one thread and " + std::to_string(threads) + " differ";
  }
  return {};
}

Broken rotatesWithTheWorld(const Subject& subject)
{
  return subject.options.rotatesOnlyOnAverage.empty() ? rotatesExactly(subject)
                                                      : rotatesOnAverage(subject);
}
}  // namespace slamot::laws
