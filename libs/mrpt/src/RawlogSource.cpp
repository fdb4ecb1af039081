#include "StepAssembler.h"

#include <slamot/core/Error.h>
#include <slamot/mrpt/RawlogSource.h>

namespace slamot::mrpt
{
struct RawlogSource::Impl
{
  Impl(const std::string& p, const Options& o) : path(p), options(o) {}

  void scan();
  void readStarts();

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
  core::Params odometryParams(config, "odometry"), sensorParams(config, "sensor");
  Options out;
  out.odometry = core::OdometryModel::from(odometryParams);
  out.sensor = SensorDeviations::from(sensorParams);
  return out;
}

void RawlogSource::Impl::scan()
{
  StepAssembler pass(path, options, nullptr);
  try
  {
    while (pass.next())
    {
    }
  }
  catch (const core::Error& e)
  {
    if (e.status() != core::ExitStatus::kTruncated || !options.salvage) throw;
    truncation = e.what();
  }
  facts = pass.facts();
  if (facts.steps == 0 && truncation.empty())
    throw core::Error(core::ExitStatus::kUnreadable, path,
                      "holds no odometry, landmark sighting, blob or laser scan",
                      "see what it holds with slamot info");
  const bool moves = facts.odometryPoseMoves || facts.odometryHasVelocities;
  if (!facts.hasFrames && moves && options.odometry.fromLog)
    throw core::Error(core::ExitStatus::kConfig, path,
                      "its odometry (observations only) comes without covariance",
                      "set [odometry] noise = model, v_std_mps and omega_std_deg_per_s");
}

void RawlogSource::Impl::readStarts()
{
  core::Config comment;
  // Others' comments are no ini files: only one with the section is held to its rules.
  if (facts.comment.find("[start]") != std::string::npos)
    comment = core::Config::parse(facts.comment, path + " comment text");
  starts = core::Starts::from(comment);
  if (comment.has("start"))
  {
    for (const std::string& section : comment.sections())
      if (section != "start") comment.erase(section);
    comment.requireAllRead();
  }
  if (!starts.time) starts.time = facts.restTime;
}

RawlogSource::RawlogSource(const std::string& path, const Options& options)
    : impl_(std::make_unique<Impl>(path, options))
{
  impl_->scan();
  impl_->readStarts();
  if (!impl_->facts.restTime) impl_->facts.restTime = impl_->starts.time;
  impl_->assembler = std::make_unique<StepAssembler>(path, options, &impl_->facts);
}

RawlogSource::~RawlogSource() = default;

std::optional<core::Step> RawlogSource::next()
{
  if (impl_->steps >= impl_->facts.steps) return std::nullopt;
  auto step = impl_->assembler->next();
  if (!step) return std::nullopt;
  ++impl_->steps;
  impl_->dropped += static_cast<std::size_t>(step->dropped);
  return step;
}

double RawlogSource::progress() const
{
  return impl_->assembler->progress();
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
