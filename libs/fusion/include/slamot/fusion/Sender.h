#pragma once

#include <slamot/fusion/Message.h>

namespace slamot::fusion
{
/// Makes the messages of one robot.
class Sender
{
 public:
  /// What this robot tells.
  struct Options
  {
    std::string frame = "map";           ///< the map frame that all robots share
    int target = core::kNoId;            ///< the target to tell of
    std::string mateLabel = "robot";     ///< label of blobs that may be a team mate
    int maxCandidates = kMaxCandidates;  ///< sightings in a message, 0 to kMaxCandidates
    bool tellIdentities = true;          ///< false: as if the sensor couldn't tell mates apart
    std::uint64_t session = 0;           ///< higher after each start of this robot
  };

  /// \throws core::Error (kConfig) if an option is out of range.
  Sender(int self, Options options);

  /// What the filter believes after `step` and what that step showed that may be a team mate:
  /// blobs with the label and a range; the first ones, if there are more than fit.
  [[nodiscard]] Message make(const core::TeamFilter& filter, const core::Step& step,
                             int receiver = kAll);

 private:
  int self_;
  Options options_;
  std::uint64_t sequence_ = 0;
};
}  // namespace slamot::fusion
