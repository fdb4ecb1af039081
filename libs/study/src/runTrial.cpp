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

Values runTeam(Trial& trial, const BoundFigures* bound)
{
  team::Team& team = *trial.team;
  std::vector<std::unique_ptr<eval::Recorder>> recorders;
  std::vector<std::vector<core::Sink*>> sinks;
  for (std::size_t r = 0; r < team.size(); ++r)
  {
    recorders.push_back(std::make_unique<eval::Recorder>(team.filter(r)));
    sinks.push_back({recorders.back().get()});
  }
  team.run(sinks);
  std::vector<eval::RunWithTruth> runs;
  std::map<int, const eval::Truth*> truths;
  for (std::size_t r = 0; r < team.size(); ++r)
  {
    runs.push_back({&recorders[r]->record(), &trial.robots[r].truth()});
    truths[static_cast<int>(r)] = runs.back().truth;
  }
  const auto evaluations = eval::evaluateTogether(runs, trial.evaluation);
  std::vector<Values> robots;
  for (std::size_t r = 0; r < team.size(); ++r)
  {
    MessageFigures figures;
    if (team.member(r)) figures = figuresOf(team, r, *runs[r].truth, truths);
    robots.push_back(
        measure(*runs[r].record, evaluations[r], team.member(r) ? &figures : nullptr, bound));
  }
  return meanOf(robots);
}
}  // namespace

Values runTrial(Trial& trial, const std::optional<BoundFigures>& known)
{
  const BoundFigures* bound = known ? &*known : nullptr;
  if (trial.team) return runTeam(trial, bound);
  eval::Recorder recorder(*trial.filter);
  core::run(*trial.robots[0].source, *trial.filter, {&recorder});
  const auto evaluation =
      eval::evaluate(recorder.record(), trial.robots[0].truth(), trial.evaluation);
  return measure(recorder.record(), evaluation, nullptr, bound);
}
}  // namespace slamot::study
