#pragma once

#include <slamot/live/Beacon.h>

#include <map>
#include <set>

namespace slamot::live
{
/// Who of the team is there, by their beacons.
class Peers
{
 public:
  enum class News
  {
    kNone,
    kCame,       ///< heard for the first time, or again after a silence
    kRestarted,  ///< heard with a new session
    kDouble,     ///< another robot has this one's number
    kStranger    ///< not of this team; once for each
  };
  static constexpr double kSilent = 3;  ///< [s] without a beacon

  /// \param team numbers of all, this robot's too.
  Peers(int self, std::set<int> team) : self_(self), team_(std::move(team)) {}

  News hear(const Beacon& beacon, double wall);
  /// Those who fell silent since the last call.
  [[nodiscard]] std::vector<int> fallSilent(double wall);
  /// Whether all others have been heard.
  [[nodiscard]] bool areAllHeard() const { return sessions().size() + 1 == team_.size(); }
  /// How many sessions, that is starts, of each other robot were heard.
  [[nodiscard]] std::map<int, int> sessions() const;

 private:
  struct Peer
  {
    std::uint64_t session = 0;
    int sessions = 0;
    double heardAt = 0;
    bool isSilent = false;
  };
  int self_;
  std::set<int> team_, strangers_;
  bool isDouble_ = false;
  std::map<int, Peer> peers_;
};
}  // namespace slamot::live
