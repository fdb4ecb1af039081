#include "Snapshot.h"
#include "laws.h"

#include <slamot/core/Error.h>

#include <functional>
#include <limits>

namespace slamot::laws
{
namespace
{
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kSeed = 1;

struct Fault
{
  const char* what;
  std::function<void(core::Step&)> spoil;  // of a step that has a sighting and a blob
};

const std::vector<Fault>& infiniteValues()
{
  static const std::vector<Fault> faults = {
      {"time NaN", [](core::Step& s) { s.time = kNan; }},
      {"odometry NaN", [](core::Step& s) { s.odometry->mean.x = kNan; }},
      {"odometry's turn infinite", [](core::Step& s) { s.odometry->mean.phi = kInf; }},
      {"odometry's covariance NaN", [](core::Step& s) { s.odometry->cov(1, 1) = kNan; }},
      {"range NaN", [](core::Step& s) { s.landmarks->sightings.back().range = kNan; }},
      {"bearing infinite", [](core::Step& s) { s.landmarks->sightings.back().bearing = kInf; }},
      {"deviation NaN", [](core::Step& s) { s.landmarks->sightings.back().rangeStd = kNan; }},
      {"blob's bearing NaN", [](core::Step& s) { s.blobs->blobs.back().bearing = kNan; }},
      {"blob's range infinite", [](core::Step& s) { s.blobs->blobs.back().range = kInf; }},
  };
  return faults;
}

core::Step withEverything(core::Step step)
{
  if (!step.landmarks) step.landmarks.emplace();
  if (!step.blobs) step.blobs.emplace();
  step.landmarks->sightings.push_back({2.0, 0.3, 0.1, 0.02, core::kNoId});
  step.blobs->blobs.push_back({"target", 2.0, -0.3, 0.1, 0.02, core::kNoId});
  return step;
}

/// How the filter takes a step that is at fault, if not by throwing Error (kNonsense) untouched.
Broken refuses(core::Filter& filter, const core::Step& step)
{
  const std::string before = bytes(filter);
  try
  {
    (void)filter.process(step);
    return "was taken";
  }
  catch (const core::Error& e)
  {
    if (e.status() != core::ExitStatus::kNonsense) return "threw another status than kNonsense";
  }
  catch (const std::exception& e)
  {
    return std::string("threw no core::Error: ") + e.what();
  }
  if (bytes(filter) != before) return "changed the estimate";
  return {};
}

/// One filter gets faults in between, its twin does not: both must tell the same ever after.
Broken survives(const Subject& subject, const std::vector<Fault>& faults)
{
  const Drive d = drive(subject.options.world, kSeed);
  const auto filter = subject.make(d.starts, kSeed), twin = subject.make(d.starts, kSeed);
  for (std::size_t i = 0; i < d.steps.size(); ++i)
  {
    if (i == d.steps.size() / 2)
      for (const Fault& fault : faults)
      {
        core::Step step = withEverything(d.steps[i]);
        fault.spoil(step);
        if (const Broken how = refuses(*filter, step))
          return atStep(kSeed, i) + fault.what + " " + *how;
      }
    if (bytes(filter->process(d.steps[i])) != bytes(twin->process(d.steps[i])))
      return atStep(kSeed, i) + "the belief is not that of a filter that never saw the fault";
  }
  return {};
}
}  // namespace

Broken timeNeverGoesBack(const Subject& subject)
{
  return survives(subject, {{"time before the last step's", [](core::Step& s) { s.time -= 1e3; }}});
}

Broken valuesAreFinite(const Subject& subject)
{
  return survives(subject, infiniteValues());
}
}  // namespace slamot::laws
