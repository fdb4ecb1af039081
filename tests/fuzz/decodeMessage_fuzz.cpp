#include <slamot/fusion/Receiver.h>

#include <cstdint>

#include "../fusion/FakeTeamFilter.h"

namespace
{
using namespace slamot::fusion;

void require(bool ok)
{
  if (!ok) __builtin_trap();
}

// With a new checksum, so that the bytes behind it are reached.
Bytes sign(Bytes bytes)
{
  const std::uint32_t sum = checksum(bytes);
  for (std::size_t i = 0; i < 4 && bytes.size() >= 4; ++i)
    bytes[bytes.size() - 4 + i] = static_cast<std::uint8_t>(sum >> (8 * i));
  return bytes;
}

void receive(const Bytes& bytes)
{
  Receiver::Options options;
  options.frame = "field";
  options.senders = {2};
  options.identity = 11;
  options.fusion.omega = 0.5;
  Receiver receiver(1, options);
  FakeTeamFilter filter(someEstimate(6));
  const auto before = filter.bytes();
  const Receipt receipt = receiver.receive(bytes, 10, filter);
  require(receiver.counts().messages() == 1);
  require(receiver.counts().of(receipt.outcome) == 1);
  require(receipt.outcome == Outcome::kFused || filter.bytes() == before);
  const auto after = filter.robotAndTarget(7);
  require(after.mean.allFinite() && after.cov.allFinite());
  require(slamot::math::smallestEigenvalue(after.cov) > -1e-9);
}
}  // namespace

/// Whatever the bytes: a message that is encoded to what it is decoded from, or a reason; and a
/// filter that is as before, or has a proper estimate.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const Bytes raw(data, data + size);
  receive(raw);
  const Bytes bytes = sign(raw);
  receive(bytes);
  const auto decoded = decode(bytes);
  const auto* message = std::get_if<Message>(&decoded);
  if (message == nullptr) return 0;
  const auto again = decode(encode(*message));
  require(std::holds_alternative<Message>(again));
  require(encode(std::get<Message>(again)) == encode(*message));
  return 0;
}
