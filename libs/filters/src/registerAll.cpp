#include <slamot/filters/Baselines.h>
#include <slamot/filters/DeadReckoning.h>
#include <slamot/filters/EkfSlamot.h>
#include <slamot/filters/RbpfSlamot.h>
#include <slamot/filters/Trackers.h>
#include <slamot/filters/registerAll.h>

namespace slamot::filters
{
namespace
{
template <class F>
void add(const char* name)
{
  core::FilterRegistry::instance().add(name, [](core::Params& p, const core::FilterContext& c)
                                       { return std::make_unique<F>(p, c); });
}
}  // namespace

void registerAll()
{
  static const bool once = []
  {
    add<DeadReckoning>("dead-reckoning");
    add<RbpfSlamot>("rbpf-slamot");
    for (const char* family : {"fastslam1", "fastslam2", "ufastslam", "gmphd-ufastslam"})
      add<RbpfSlamot>(family);
    for (const char* core : {"slamot", "ekf-slamot"}) add<EkfSlamot>(core);
    add<Independent>("independent");
    add<OdometryTarget>("odometry");
    add<TruePoseTarget>("true-pose-target");
    add<ParticleTracker>("particle-tracker");
    for (const char* tracker : {"kalman-tracker", "imm-tracker"}) add<KalmanTracker>(tracker);
    return true;
  }();
  (void)once;
}
}  // namespace slamot::filters
