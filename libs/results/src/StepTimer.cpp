#include <slamot/math/statistics.h>
#include <slamot/results/StepTimer.h>
#include <sys/resource.h>

namespace slamot::results
{
namespace
{
double cpuSeconds()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double peakRssMb()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) * 1024 / 1e6;  // Linux counts in kibibytes
}
}  // namespace

StepTimer::StepTimer(core::Source& source)
    : source_(&source), start_(Clock::now()), stepStart_(start_), cpuAtStart_(cpuSeconds())
{
}

std::optional<core::Step> StepTimer::next()
{
  auto step = source_->next();
  stepStart_ = Clock::now();
  return step;
}

void StepTimer::accept(const core::Step&, const core::Update&)
{
  stepsUs_.push_back(std::chrono::duration<float, std::micro>(Clock::now() - stepStart_).count());
}

Timing StepTimer::timing() const
{
  Timing out;
  out.wallS = std::chrono::duration<double>(Clock::now() - start_).count();
  out.cpuS = cpuSeconds() - cpuAtStart_;
  if (!stepsUs_.empty())
  {
    const std::vector<double> us(stepsUs_.begin(), stepsUs_.end());
    out.stepMedianUs = math::quantile(us, 0.5);
    out.stepP99Us = math::quantile(us, 0.99);
  }
  out.peakRssMb = peakRssMb();
  return out;
}
}  // namespace slamot::results
