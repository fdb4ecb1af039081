#include "TeamStory.h"

#include <algorithm>
#include <cstdio>

#include "teamScene.h"

namespace slamot::apps
{
namespace
{
template <class T>
void append(std::vector<T>& to, std::vector<T>&& from)
{
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

/// All that a robot tracks as one: it has one colour.
mrpt::SceneTrack joined(std::vector<mrpt::SceneTrack>&& tracks)
{
  mrpt::SceneTrack out;
  for (mrpt::SceneTrack& t : tracks)
  {
    append(out.path, std::move(t.path));
    append(out.truth, std::move(t.truth));
    if (t.now) out.now = t.now;
  }
  return out;
}
}  // namespace

TeamStory::TeamStory(const SavedTeam& team) : team_(team)
{
  std::vector<mrpt::SceneData> wholes;
  for (const SavedRun& run : team.runs)
  {
    members_.push_back(std::make_unique<RobotStory>(run));
    wholes.push_back(members_.back()->whole());
    for (const eval::RobotRow& row : run.record.rows) times_.push_back(row.time);
  }
  std::sort(times_.begin(), times_.end());
  times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
  whole_ = combined(std::move(wholes));
}

std::size_t TeamStory::rowAt(double time) const
{
  const auto after = std::upper_bound(times_.begin(), times_.end(), times_.front() + time + 1e-9);
  return after == times_.begin() ? 0 : static_cast<std::size_t>(after - times_.begin()) - 1;
}

mrpt::Moment TeamStory::at(std::size_t row) const
{
  std::vector<mrpt::SceneData> scenes;
  std::string errors;
  for (std::size_t r = 0; r < members_.size(); ++r)
  {
    const double since = times_[row] - team_.runs[r].record.rows.front().time;
    if (since < 0)  // it has not started yet
    {
      scenes.emplace_back();
      continue;
    }
    const std::size_t own = members_[r]->rowAt(since);
    scenes.push_back(members_[r]->at(own).scene);
    char text[40];
    if (const auto error = members_[r]->errorAt(own))
      std::snprintf(text, sizeof text, "%.2f", *error);
    else
      std::snprintf(text, sizeof text, "?");
    errors += (errors.empty() ? "" : ", ") + std::string(text);
  }
  mrpt::Moment moment;
  moment.scene = combined(std::move(scenes));
  char text[64];
  std::snprintf(text, sizeof text, "t = %.1f s", times_[row] - times_.front());
  moment.caption = text;
  if (errors.find_first_of("0123456789") != std::string::npos)
    moment.caption += "   position errors " + errors + " m";
  return moment;
}

mrpt::SceneData TeamStory::combined(std::vector<mrpt::SceneData> scenes) const
{
  mrpt::SceneData out;
  out.title = team_.title;
  out.ofMoments = true;
  std::vector<TeamLandmarks> maps;
  for (std::size_t r = 0; r < scenes.size(); ++r)
  {
    mrpt::SceneData& one = scenes[r];
    maps.push_back({std::move(one.landmarks), team_.runs[r].record.landmarksIdentified()});
    if (out.trueLandmarks.empty()) out.trueLandmarks = std::move(one.trueLandmarks);
    append(out.laserPoints, std::move(one.laserPoints));
    append(out.scanPoints, std::move(one.scanPoints));
    append(out.sightings, std::move(one.sightings));
    mrpt::SceneMember member;
    member.robot = std::move(one.robot);
    member.robot.name = team_.names[r];
    member.target = joined(std::move(one.targets));
    member.target.name = team_.names[r] + " target";
    out.team.push_back(std::move(member));
  }
  out.landmarks = landmarksOfAll(maps);
  return out;
}
}  // namespace slamot::apps
