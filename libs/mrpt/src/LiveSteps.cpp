#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <slamot/mrpt/LiveSteps.h>

#include <deque>
#include <exception>
#include <utility>

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
  std::vector<core::Step> complete;  // not handed out yet
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
  void assemble()
  {
    const std::size_t before = complete.size();
    try
    {
      while (auto step = assembler.next()) complete.push_back(std::move(*step));
    }
    catch (...)
    {
      waiting.clear();  // what is wrong is dropped whole
      throw;
    }
    if (!lacksCovariance(assembler.facts()) || !fromLog) return;
    complete.resize(before);
    throw core::Error(core::ExitStatus::kConfig, "CObservationOdometry", "comes without covariance",
                      "set [odometer] noise = model, v_std_mps and omega_std_deg_per_s");
  }
  void assembleGroup()
  {
    for (Entry& entry : group) waiting.push_back(std::move(entry));
    group.clear();
    assemble();
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
  std::exception_ptr failure;
  try
  {
    parts_->assembleGroup();
  }
  catch (...)
  {
    failure = std::current_exception();  // of what came before: the pair is not to blame
  }
  Entry motion = parts_->entryOf(Entry::Kind::kActions);
  for (const auto& action : actions) motion.parts.push_back(partOf(action.get_ptr()));
  Entry sightings = parts_->entryOf(Entry::Kind::kFrame);
  for (const CObservation::Ptr& o : frame) sightings.parts.push_back(partOf(o));
  parts_->waiting.push_back(std::move(motion));
  parts_->waiting.push_back(std::move(sightings));
  parts_->assemble();
  if (failure) std::rethrow_exception(failure);
  return complete();
}

std::vector<core::Step> LiveSteps::add(const CObservation::Ptr& observation)
{
  const auto& group = parts_->group;
  const bool ends =
      !group.empty() && group.front().as<CObservation>()->timestamp != observation->timestamp;
  std::deque<Entry> ended;
  if (ends) ended.swap(parts_->group);
  Entry entry = parts_->entryOf(Entry::Kind::kObservation);
  entry.parts.push_back(partOf(observation));
  parts_->group.push_back(std::move(entry));
  for (Entry& e : ended) parts_->waiting.push_back(std::move(e));
  if (ends) parts_->assemble();
  return complete();
}

std::vector<core::Step> LiveSteps::flush()
{
  parts_->assembleGroup();
  return complete();
}

std::vector<core::Step> LiveSteps::complete()
{
  return std::exchange(parts_->complete, {});
}
}  // namespace slamot::mrpt
