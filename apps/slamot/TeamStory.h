#pragma once

#include "Story.h"

namespace slamot::apps
{
/// A team's run: each robot, and what it tracks, in a colour of its own, in the frame that all
/// share.  A row is an instant at which any of them has one.  Landmarks of all, as RobotStory has
/// each one's; of those with identities, the surest of those that have been seen.
class TeamStory : public Story
{
 public:
  /// \param team must outlive it.
  explicit TeamStory(const SavedTeam& team);

  [[nodiscard]] const mrpt::SceneData& whole() const override { return whole_; }
  [[nodiscard]] double duration() const override { return times_.back() - times_.front(); }
  [[nodiscard]] std::size_t rowAt(double time) const override;
  [[nodiscard]] mrpt::Moment at(std::size_t row) const override;

 private:
  [[nodiscard]] mrpt::SceneData combined(std::vector<mrpt::SceneData> scenes) const;

  const SavedTeam& team_;
  std::vector<std::unique_ptr<RobotStory>> members_;
  std::vector<double> times_;  // [s], rising
  mrpt::SceneData whole_;
};
}  // namespace slamot::apps
