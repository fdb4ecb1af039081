#include <slamot/results/Figures.h>

#include <algorithm>

namespace slamot::results
{
namespace
{
std::string labelOf(const eval::TargetTrack& track)
{
  return track.label.empty() ? "target" : track.label;
}

/// A true target with the tracks that stand for it, in order of time.
TargetGroup groupOf(const eval::Record& record, const eval::Evaluation& evaluation,
                    const eval::TargetEvaluation& truth)
{
  TargetGroup group;
  group.truthId = truth.id;
  group.evaluation = &truth;
  for (std::size_t i = 0; i < record.targets.size() && i < evaluation.targets.size(); ++i)
    if (evaluation.targets[i].truthId == truth.id && !record.targets[i].rows.empty())
      group.tracks.push_back(i);
  const auto firstRow = [&](std::size_t i) { return record.targets[i].rows.front().row; };
  std::stable_sort(group.tracks.begin(), group.tracks.end(),
                   [&](std::size_t a, std::size_t b) { return firstRow(a) < firstRow(b); });
  const std::string label =
      group.tracks.empty() ? "target" : labelOf(record.targets[group.tracks.front()]);
  group.name = label + " " + std::to_string(truth.id);
  return group;
}
}  // namespace

std::string nameOf(const eval::TargetTrack& track)
{
  return labelOf(track) + " " + std::to_string(track.id) +
         (track.identified ? "" : " (no identity)");
}

std::vector<TargetGroup> targetGroups(const eval::Record& record,
                                      const eval::Evaluation& evaluation)
{
  std::vector<TargetGroup> groups;
  std::vector<char> grouped(record.targets.size(), 0);
  for (const eval::TargetEvaluation& truth : evaluation.trueTargets)
  {
    groups.push_back(groupOf(record, evaluation, truth));
    for (const std::size_t i : groups.back().tracks) grouped[i] = 1;
  }
  TargetGroup rest;
  rest.name = "of no true target";
  for (std::size_t i = 0; i < record.targets.size(); ++i)
  {
    if (grouped[i]) continue;
    if (!evaluation.trueTargets.empty())
      rest.tracks.push_back(i);
    else
      groups.push_back({nameOf(record.targets[i]), std::nullopt, {i}, nullptr});
  }
  if (!rest.tracks.empty()) groups.push_back(rest);
  return groups;
}

std::string trackNames(const eval::Record& record, const TargetGroup& group)
{
  std::string text;
  for (const std::size_t i : group.tracks)
    text += (text.empty() ? "" : ", ") + std::to_string(record.targets[i].id);
  return (group.tracks.size() == 1 ? "track " : "tracks ") + text;
}
}  // namespace slamot::results
