#pragma once

#include <slamot/fusion/Message.h>

#include <memory>
#include <string>
#include <vector>

namespace slamot::live
{
using fusion::Bytes;

/// How packets of a topic reach the others.
enum class Delivery
{
  kNewest,  ///< best effort; of each sender, the newest that was not yet taken
  kAll      ///< all, in their sender's order, those of before a receiver was there too
};

/// What robots tell each other under one name.
class Topic
{
 public:
  virtual ~Topic() = default;
  /// To all who listen. \throws core::Error (kLimit) if the network does not take it.
  virtual void publish(const Bytes& packet) = 0;
  /// What has come from others since the last call, each sender's in its order.
  [[nodiscard]] virtual std::vector<Bytes> take() = 0;
  /// Waits until all who listen have everything that was published, at most so long [s].
  virtual bool flush(double seconds) = 0;
};

/// What carries packets between the robots of a team.  Topics must not outlive it.
class Network
{
 public:
  virtual ~Network() = default;
  /// The topic of this name; all robots of a team give it the same delivery.
  [[nodiscard]] virtual std::unique_ptr<Topic> open(const std::string& name, Delivery delivery) = 0;
  /// Waits until something may have come, at most so long [s].
  virtual void wait(double seconds) = 0;
};
}  // namespace slamot::live
