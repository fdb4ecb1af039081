#pragma once

#include <slamot/core/Params.h>
#include <slamot/fusion/Message.h>

#include <map>

namespace slamot::fusion
{
/// A simulated radio that loses, delays, doubles and reorders messages, each link on its own.  What
/// happens to a message depends on the seed, the link and the message's number on it alone.
class Radio
{
 public:
  /// What the air does to messages.
  struct Options
  {
    double loss = 0;         ///< chance that a message is lost
    double delay = 0;        ///< [s]
    double delaySpread = 0;  ///< [s]: up to so much more, uniform; messages overtake each other
    double duplication = 0;  ///< chance that a message that arrives does so twice
    std::uint64_t seed = 1;  ///< fixes which messages are lost, late or doubled
    /// Keys message_loss, message_delay_s, message_delay_spread_s, message_duplication.
    static Options from(core::Params& p, std::uint64_t seed);
  };

  /// Nothing is on the way yet.
  explicit Radio(const Options& options) : options_(options) {}

  /// Sends at time `now` [s]; what is lost and when it arrives is drawn at once.
  void send(int from, int to, double now, const Bytes& bytes);
  /// What has arrived at a robot by now, in order of arrival.
  [[nodiscard]] std::vector<Bytes> receive(int to, double now);

 private:
  struct Flight
  {
    double arrival;
    int from;
    std::uint64_t number;
    Bytes bytes;
  };

  Options options_;
  std::map<std::pair<int, int>, std::uint64_t> sent_;  // on each link
  std::map<int, std::vector<Flight>> flights_;         // by receiver
};
}  // namespace slamot::fusion
