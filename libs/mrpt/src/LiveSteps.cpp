#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <slamot/mrpt/LiveSteps.h>

#include <deque>

#include "scanLog.h"

namespace slamot::mrpt
{
namespace
{
using ::mrpt::obs::CObservation;

LogFacts factsOf(std::optional<double> startTime)
{
  LogFacts facts;
  facts.restTime = startTime;
  return facts;
}

Entry::Part partOf(const ::mrpt::serialization::CSerializable::Ptr& object)
{
  return {object->GetRuntimeClass()->className, object};
}
}  // namespace

struct LiveSteps::Parts
{
  LogFacts facts;
  bool fromLog;               // the odometry's covariance
  std::deque<Entry> waiting;  // not seen by the assembler
  std::deque<Entry> group;    // observations of one timestamp
  std::size_t count = 0;
  StepAssembler assembler;

  Parts(const RawlogSource::Options& options, std::optional<double> startTime)
      : facts(factsOf(startTime)),
        fromLog(options.odometry.fromLog),
        assembler([this] { return pop(); }, options, &facts)
  {
  }

  std::optional<Entry> pop()
  {
    if (waiting.empty()) return std::nullopt;
    Entry entry = std::move(waiting.front());
    waiting.pop_front();
    return entry;
  }
  Entry entryOf(Entry::Kind kind)
  {
    Entry entry;
    entry.path = "live";
    entry.number = count++;
    entry.kind = kind;
    return entry;
  }
  std::vector<core::Step> assemble()
  {
    std::vector<core::Step> steps;
    try
    {
      while (auto step = assembler.next()) steps.push_back(std::move(*step));
      if (lacksCovariance(assembler.facts()) && fromLog)
        throw core::Error(core::ExitStatus::kConfig, "CObservationOdometry",
                          "comes without covariance",
                          "set [odometer] noise = model, v_std_mps and omega_std_deg_per_s");
    }
    catch (...)
    {
      waiting.clear();  // what is wrong is dropped whole
      throw;
    }
    return steps;
  }
};

LiveSteps::LiveSteps(const RawlogSource::Options& options, std::optional<double> startTime)
    : parts_(std::make_unique<Parts>(options, startTime))
{
}

LiveSteps::~LiveSteps() = default;

std::vector<core::Step> LiveSteps::add(const ::mrpt::obs::CActionCollection& actions,
                                       const ::mrpt::obs::CSensoryFrame& frame)
{
  std::vector<core::Step> steps = flush();
  Entry motion = parts_->entryOf(Entry::Kind::kActions);
  for (const auto& action : actions) motion.parts.push_back(partOf(action.get_ptr()));
  Entry sightings = parts_->entryOf(Entry::Kind::kFrame);
  for (const CObservation::Ptr& o : frame) sightings.parts.push_back(partOf(o));
  parts_->waiting.push_back(std::move(motion));
  parts_->waiting.push_back(std::move(sightings));
  for (core::Step& step : parts_->assemble()) steps.push_back(std::move(step));
  return steps;
}

std::vector<core::Step> LiveSteps::add(const CObservation::Ptr& observation)
{
  std::vector<core::Step> steps;
  const auto& group = parts_->group;
  if (!group.empty() && group.front().as<CObservation>()->timestamp != observation->timestamp)
    steps = flush();
  Entry entry = parts_->entryOf(Entry::Kind::kObservation);
  entry.parts.push_back(partOf(observation));
  parts_->group.push_back(std::move(entry));
  return steps;
}

std::vector<core::Step> LiveSteps::flush()
{
  for (Entry& entry : parts_->group) parts_->waiting.push_back(std::move(entry));
  parts_->group.clear();
  return parts_->assemble();
}
}  // namespace slamot::mrpt
