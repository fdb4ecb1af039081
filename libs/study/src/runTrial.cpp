#include <slamot/eval/Alignment.h>
#include <slamot/eval/Recorder.h>
#include <slamot/study/Metrics.h>
#include <slamot/study/Trial.h>
#include <slamot/team/teamResults.h>

namespace slamot::study
{
namespace
{
using Values = std::vector<std::optional<double>>;

MessageFigures figuresOf(const team::Team& team, std::size_t robot, const eval::Truth& own,
                         const std::map<int, const eval::Truth*>& truths)
{
  const fusion::Member& member = *team.member(robot);
  const team::FusionSummary fusion = team::summarise(team.events(robot), own, truths);
  MessageFigures out;
  out.sent = static_cast<double>(member.sent());
  out.bytes = static_cast<double>(member.bytesSent());
  out.fused = static_cast<double>(fusion.fused);
  out.candidates = static_cast<double>(fusion.candidates);
  if (fusion.wrongCandidates) out.wrong = static_cast<double>(*fusion.wrongCandidates);
  return out;
}

Values measureTeam(const team::Team& team, const FinishedTrial& done, const BoundFigures* bound)
{
  std::map<int, const eval::Truth*> truths;
  for (std::size_t r = 0; r < team.size(); ++r) truths[static_cast<int>(r)] = done.truths[r];
  std::vector<Values> robots;
  for (std::size_t r = 0; r < team.size(); ++r)
  {
    MessageFigures figures;
    if (team.member(r)) figures = figuresOf(team, r, *done.truths[r], truths);
    robots.push_back(
        measure(done.records[r], done.evaluations[r], team.member(r) ? &figures : nullptr, bound));
  }
  return meanOf(robots);
}

void runTeam(team::Team& team, const eval::Recorder::Options& options, FinishedTrial& done)
{
  std::vector<std::unique_ptr<eval::Recorder>> recorders;
  std::vector<std::vector<core::Sink*>> sinks;
  for (std::size_t r = 0; r < team.size(); ++r)
  {
    recorders.push_back(std::make_unique<eval::Recorder>(team.filter(r), options));
    sinks.push_back({recorders.back().get()});
  }
  team.run(sinks);
  for (const auto& recorder : recorders) done.records.push_back(recorder->takeRecord());
}

void runAlone(Trial& trial, const eval::Recorder::Options& options, FinishedTrial& done)
{
  eval::Recorder recorder(*trial.filter, options);
  core::run(*trial.robots[0].source, *trial.filter, {&recorder});
  done.records.push_back(recorder.takeRecord());
}
}  // namespace

std::vector<eval::RunWithTruth> FinishedTrial::runs() const
{
  std::vector<eval::RunWithTruth> out;
  for (std::size_t r = 0; r < records.size(); ++r) out.push_back({&records[r], truths[r]});
  return out;
}

FinishedTrial finish(Trial& trial, bool keepLasers)
{
  eval::Recorder::Options options;
  options.keepLasers = keepLasers;
  FinishedTrial done;
  if (trial.team)
    runTeam(*trial.team, options, done);
  else
    runAlone(trial, options, done);
  for (std::size_t r = 0; r < done.records.size(); ++r)
    done.truths.push_back(&trial.robots[r].truth());
  if (trial.team)
    done.evaluations = eval::evaluateTogether(done.runs(), trial.evaluation);
  else
    done.evaluations = {eval::evaluate(done.records[0], *done.truths[0], trial.evaluation)};
  return done;
}

TrialResult runTrial(Trial& trial, const std::optional<BoundFigures>& known)
{
  const BoundFigures* bound = known ? &*known : nullptr;
  const FinishedTrial done = finish(trial);
  TrialResult out;
  out.metrics = trial.team ? measureTeam(*trial.team, done, bound)
                           : measure(done.records[0], done.evaluations[0], nullptr, bound);
  if (trial.timeBins > 0) out.curves = errorCurves(done.runs(), done.evaluations, trial.timeBins);
  return out;
}
}  // namespace slamot::study
