#include <slamot/live/Announcement.h>

#include <cmath>

#include "layout.h"

namespace slamot::live
{
namespace
{
constexpr char kLetters[] = "SLS1";
constexpr std::size_t kSizeWithoutMessage = 4 + 1 + 4 + 8 + 8 + 8 + 8 + 4;
}  // namespace

Bytes encode(const Announcement& a)
{
  return Packer(kLetters)
      .add(static_cast<std::uint8_t>(a.kind))
      .add(static_cast<std::int32_t>(a.sender))
      .add(a.session)
      .add(a.sequence)
      .add(a.time)
      .add(a.next)
      .add(a.message)
      .close();
}

std::optional<Announcement> decodeAnnouncement(const Bytes& bytes)
{
  Unpacker in(bytes, kLetters, kSizeWithoutMessage);
  if (!in.isGood()) return {};
  Announcement out;
  const auto kind = in.take<std::uint8_t>();
  if (kind > static_cast<std::uint8_t>(Announcement::Kind::kLeft)) return {};
  out.kind = static_cast<Announcement::Kind>(kind);
  out.sender = in.take<std::int32_t>();
  out.session = in.take<std::uint64_t>();
  out.sequence = in.take<std::uint64_t>();
  out.time = in.take<double>();
  out.next = in.take<double>();
  out.message = in.rest();
  if (!std::isfinite(out.time) || std::isnan(out.next)) return {};
  return out;
}
}  // namespace slamot::live
