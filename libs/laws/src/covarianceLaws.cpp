#include "Snapshot.h"
#include "laws.h"

namespace slamot::laws
{
namespace
{
constexpr std::uint64_t kSeed = 1;

Broken unsound(const Eigen::Ref<const Eigen::MatrixXd>& P)
{
  if (!P.allFinite()) return "is not finite";
  if (math::asymmetry(P) > 1e-9 * P.cwiseAbs().maxCoeff()) return "is not symmetric";
  if (math::smallestEigenvalue(P) < -1e-9 * std::max(P.trace(), 0.0)) return "is not positive";
  return {};
}

Broken unsound(const Snapshot& s)
{
  const auto check = [](const std::string& of, const auto& P) -> Broken
  {
    if (const Broken how = unsound(P)) return "the covariance of " + of + " " + *how;
    return {};
  };
  if (const Broken how = check("the robot", s.estimate.robot.cov)) return how;
  const core::TargetEstimate* last = nullptr;
  for (const core::TargetEstimate& t : s.estimate.targets)
  {
    const std::string name = "target " + std::to_string(t.id);
    if (const Broken how = check(name, t.pose.cov)) return how;
    if (const Broken how = check(name + "'s velocity", t.velocityCov)) return how;
    if (last && t.id <= last->id) return "the ids of targets do not rise at " + name;
    last = &t;
  }
  for (std::size_t i = 0; i < s.landmarks.size(); ++i)
  {
    const std::string name = "landmark " + std::to_string(s.landmarks[i].id);
    if (const Broken how = check(name, s.landmarks[i].position.cov)) return how;
    if (i > 0 && s.landmarks[i].id <= s.landmarks[i - 1].id)
      return "the ids of landmarks do not rise at " + name;
  }
  return {};
}

/// How far below `before` a variance may fall: a particle filter's is that of a finite sample.
double slack(const core::Update& update)
{
  const int n = update.diagnostics.particles;
  return n > 0 ? std::min(0.9, 5.0 / std::sqrt(n)) : 1e-9;
}

struct Spread
{
  double place, heading;
};
Spread spread(const core::Estimate& e)
{
  return {e.robot.cov.topLeftCorner<2, 2>().trace(), e.robot.cov(2, 2)};
}

/// Steps without news, each odometry's share of uncertainty or none at all.
Broken losesUncertainty(core::Filter& filter, core::Step step, double dt, bool nothingAtAll)
{
  step = core::Step{step.time, {}, {}, {}, {}, 0};
  if (!nothingAtAll) step.odometry = math::turnThenMove(0, 0, dt, 0.1, 0.05);
  // The first may still show a resampling that the last news led to.
  step.time += dt;
  Spread before = spread(filter.process(step).estimate);
  for (int i = 0; i < 20; ++i)
  {
    step.time += dt;
    const core::Update update = filter.process(step);
    const Spread now = spread(update.estimate);
    const double kept = 1 - (nothingAtAll ? 1e-9 : slack(update));
    if (!(now.place >= kept * before.place)) return "the robot's place becomes more certain";
    if (!(now.heading >= kept * before.heading)) return "the robot's heading becomes more certain";
    if (update.diagnostics.particles == 0) before = now;
  }
  return {};
}
}  // namespace

Broken covariancesAreSound(const Subject& subject)
{
  const Drive d = drive(subject.options.world, kSeed);
  const auto filter = subject.make(d.starts, kSeed);
  if (const Broken how = unsound(snapshot(filter->estimate()))) return "at the start, " + *how;
  for (std::size_t i = 0; i < d.steps.size(); ++i)
    if (const Broken how = unsound(snapshot(filter->process(d.steps[i]).estimate)))
      return atStep(kSeed, i) + *how;
  return {};
}

Broken emptyStepsOnlyAddUncertainty(const Subject& subject)
{
  const double dt = subject.options.world.dt;
  const Drive d = drive(subject.options.world, kSeed);
  for (const bool nothingAtAll : {true, false})
  {
    const auto filter = subject.make(d.starts, kSeed);
    for (const core::Step& step : d.steps) (void)filter->process(step);
    if (const Broken how = losesUncertainty(*filter, d.steps.back(), dt, nothingAtAll))
      return (nothingAtAll ? "steps with nothing: " : "steps with odometry only: ") + *how;
  }
  return {};
}
}  // namespace slamot::laws
