#include "laws.h"

#include <slamot/math/statistics.h>

#include <cstdio>

namespace slamot::laws
{
namespace
{
/// The chance that a consistent filter's mean lies outside the band.
constexpr double kChance = 1e-3;

struct Nees
{
  double sum = 0;
  int count = 0, dof = 0;
};

double neesOf(const Pose2D& truth, const Gaussian<Pose2D>& believed)
{
  const Pose2D& m = believed.mean;
  const Vector3 e(truth.x - m.x, truth.y - m.y, math::wrapToPi(truth.phi - m.phi));
  return math::mahalanobisSquared(e, believed.cov);
}

double placeNeesOf(const Pose2D& truth, const Gaussian<Pose2D>& believed)
{
  const Vector2 e(truth.x - believed.mean.x, truth.y - believed.mean.y);
  return math::mahalanobisSquared(e, believed.cov.topLeftCorner<2, 2>());
}

/// Calls `add` with the belief and the truth at the end of every run: runs are independent, the
/// steps of one are not.
template <class Add>
void atEndOfRuns(const Subject& subject, Add add)
{
  for (int seed = 1; seed <= subject.options.runs; ++seed)
  {
    const Drive d = drive(subject.options.world, seed);
    const auto filter = subject.make(d.starts, seed);
    for (const core::Step& step : d.steps) (void)filter->process(step);
    add(filter->estimate(), d);
  }
}

Broken outside(const Nees& nees, const std::optional<NeesBand>& band)
{
  if (nees.count == 0) return {};
  const double n = nees.count * nees.dof, mean = nees.sum / n;
  const double low = band ? band->low : math::chiSquareQuantile(kChance / 2, n) / n;
  const double high = band ? band->high : math::chiSquareQuantile(1 - kChance / 2, n) / n;
  if (mean >= low && mean <= high) return {};
  char text[160];
  std::snprintf(text, sizeof text,
                "mean NEES per degree of freedom is %.3f over %d samples, expected %.3f to %.3f%s",
                mean, nees.count, low, high,
                mean > high ? ": over-confident" : ": under-confident");
  return text;
}
}  // namespace

Broken robotIsConsistent(const Subject& subject)
{
  Nees nees{0, 0, 3};
  atEndOfRuns(subject, [&](const core::Estimate& e, const Drive& d)
              { nees.sum += neesOf(d.robot.back(), e.robot), ++nees.count; });
  return outside(nees, subject.options.robotNees);
}

Broken targetsAreConsistent(const Subject& subject)
{
  Nees nees{0, 0, 2};
  atEndOfRuns(subject,
              [&](const core::Estimate& e, const Drive& d)
              {
                const std::vector<Pose2D>& truth = d.targets.back();
                for (const core::TargetEstimate& t : e.targets)
                {
                  if (!t.identified || t.id < 0 || t.id >= static_cast<int>(truth.size())) continue;
                  nees.sum += placeNeesOf(truth[t.id], t.pose), ++nees.count;
                }
              });
  return outside(nees, subject.options.targetNees);
}
}  // namespace slamot::laws
