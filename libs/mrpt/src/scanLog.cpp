#include "scanLog.h"

#include <slamot/core/Error.h>

namespace slamot::mrpt
{
LogScan scanLog(const std::string& path, const RawlogSource::Options& options,
                const std::function<void(const Entry&)>& onEntry,
                const std::function<void(const core::Step&)>& onStep)
{
  LogScan out;
  std::optional<StepAssembler> pass;
  try
  {
    pass.emplace(path, options, nullptr, onEntry);
    while (const auto step = pass->next())
      if (onStep) onStep(*step);
  }
  catch (const core::Error& e)
  {
    out.error = e;
  }
  if (!pass) return out;
  out.facts = pass->facts();
  // By a clock of our own the start is at zero; else what is untimed at first is at the first time.
  if (!out.facts.firstTime)
    out.facts.restTime = 0;
  else if (out.facts.beginsAtRest && !out.facts.restTime)
    out.facts.restTime = out.facts.firstTime;
  return out;
}

bool lacksCovariance(const LogFacts& facts)
{
  return facts.odometryFromPoses && (facts.moves || facts.hasVelocities);
}

core::Starts startsOf(const LogFacts& facts, const std::string& path)
{
  core::Config comment;
  // Others' comments are no ini files: only one with the section is held to its rules.
  if (facts.comment.find("[start]") != std::string::npos)
    comment = core::Config::parse(facts.comment, path + " comment text");
  core::Starts starts = core::Starts::from(comment);
  std::vector<std::string> others;
  for (const std::string& section : comment.sections())
    if (section != "start") others.push_back(section);
  comment.requireAllRead(others);
  if (!starts.time || !facts.firstTime) starts.time = facts.restTime;
  return starts;
}
}  // namespace slamot::mrpt
