#include "scanLog.h"

#include <slamot/core/Error.h>
#include <slamot/mrpt/RawlogSource.h>

#include <cstdio>

namespace slamot::mrpt
{
namespace
{
constexpr double kShortestPeriod = 1e-6;  // [s]: result files print nanoseconds
}

struct RawlogSource::Impl
{
  Impl(const std::string& p, const Options& o) : path(p), options(o) {}

  void scan();
  [[nodiscard]] std::string describe(const core::Error& error) const;

  std::string path;
  Options options;
  LogFacts facts;
  core::Starts starts;
  std::string truncation;
  std::size_t steps = 0, dropped = 0;
  std::unique_ptr<StepAssembler> assembler;
};

RawlogSource::SensorDeviations RawlogSource::SensorDeviations::from(core::Params& p)
{
  SensorDeviations out;
  if (!p.optionalNumber("range_std_m", 0.0) && !p.optionalNumber("bearing_std_deg", 0.0))
    return out;
  out.range = p.positive("range_std_m");
  out.bearing = p.positive("bearing_std_deg");
  return out;
}

RawlogSource::Options RawlogSource::Options::from(core::Config& config)
{
  core::Params odometryParams(config, "odometer"), sensorParams(config, "sensor");
  core::Params logParams(config, "log");
  Options out;
  out.odometry = core::OdometryModel::from(odometryParams);
  out.sensor = SensorDeviations::from(sensorParams);
  out.stepPeriod = logParams.inRange("step_period_s", 0, 1e6, 0.0);
  if (out.stepPeriod > 0 && out.stepPeriod < kShortestPeriod)
    logParams.fail("step_period_s", "is below 1e-6 s", "set it to 0 for the log's own times");
  out.useFirstFrame = logParams.choice("first_frame", {"skip", "use"}, "skip") == "use";
  return out;
}

// "WHERE: WHAT; HOW TO MEND", with what was done in place of how to mend it.
std::string RawlogSource::Impl::describe(const core::Error& error) const
{
  const std::string text = error.what();
  char used[96];
  std::snprintf(used, sizeof used, "; used its intact first part, %zu steps to %.6f s", facts.steps,
                facts.lastTime.value_or(0));
  return text.substr(0, text.rfind("; ")) + used;
}

void RawlogSource::Impl::scan()
{
  const LogScan scan = scanLog(path, options);
  if (scan.error && (scan.error->status() != core::ExitStatus::kTruncated || !options.salvage))
    throw *scan.error;
  facts = scan.facts;
  if (scan.error) truncation = describe(*scan.error);
  if (facts.steps == 0 && !scan.error)
    throw core::Error(core::ExitStatus::kUnreadable, path,
                      "holds no odometry, landmark sighting, blob or laser scan",
                      "see what it holds with slamot info");
  if (lacksCovariance(facts) && options.odometry.fromLog)
    throw core::Error(core::ExitStatus::kConfig, path,
                      "its odometry (CObservationOdometry) comes without covariance",
                      "set [odometer] noise = model, v_std_mps and omega_std_deg_per_s");
  starts = startsOf(facts, path);
}

RawlogSource::RawlogSource(const std::string& path, const Options& options)
    : impl_(std::make_unique<Impl>(path, options))
{
  impl_->scan();
  if (!impl_->facts.restTime) impl_->facts.restTime = impl_->starts.time;
  impl_->assembler = std::make_unique<StepAssembler>(path, options, &impl_->facts);
}

RawlogSource::~RawlogSource() = default;

std::optional<core::Step> RawlogSource::next()
{
  // A log that ends early is read no further than its last whole step.
  if (impl_->steps >= impl_->facts.steps) return std::nullopt;
  auto step = impl_->assembler->next();
  if (!step) return std::nullopt;
  ++impl_->steps;
  impl_->dropped += static_cast<std::size_t>(step->dropped);
  return step;
}

double RawlogSource::progress() const
{
  // Not by bytes: the whole of a small log is read ahead at once.
  const std::size_t all = impl_->facts.steps;
  return all == 0 ? 1.0 : static_cast<double>(impl_->steps) / static_cast<double>(all);
}
const core::Starts& RawlogSource::starts() const
{
  return impl_->starts;
}
const std::string& RawlogSource::truncation() const
{
  return impl_->truncation;
}
std::size_t RawlogSource::dropped() const
{
  return impl_->dropped;
}
}  // namespace slamot::mrpt
