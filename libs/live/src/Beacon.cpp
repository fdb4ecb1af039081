#include <slamot/live/Beacon.h>

#include <cmath>
#include <limits>

#include "layout.h"

namespace slamot::live
{
namespace
{
constexpr char kLetters[] = "SLT1";
constexpr std::size_t kSize = 4 + 4 + 8 + 8 + 8 + 1 + 4;
}  // namespace

Bytes encode(const Beacon& b)
{
  constexpr double kNone = std::numeric_limits<double>::infinity();
  return Packer(kLetters)
      .add(static_cast<std::int32_t>(b.sender))
      .add(b.session)
      .add(b.speed)
      .add(b.clock.value_or(kNone))
      .add(static_cast<std::uint8_t>(b.hearsAll))
      .close();
}

std::optional<Beacon> decodeBeacon(const Bytes& bytes)
{
  Unpacker in(bytes, kLetters, kSize);
  if (!in.isGood() || bytes.size() != kSize) return {};
  Beacon out;
  out.sender = in.take<std::int32_t>();
  out.session = in.take<std::uint64_t>();
  out.speed = in.take<double>();
  const double clock = in.take<double>();
  out.hearsAll = in.take<std::uint8_t>() != 0;
  if (!std::isfinite(out.speed) || std::isnan(clock)) return {};
  if (std::isfinite(clock)) out.clock = clock;
  return out;
}
}  // namespace slamot::live
