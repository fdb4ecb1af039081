#include "objectHeader.h"

#include <mrpt/obs/CAction.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/rtti/CObject.h>

#include <algorithm>

namespace slamot::mrpt
{
namespace
{
constexpr std::uint8_t kNewFormat = 0x80;
constexpr std::size_t kShortestName = 3, kLongestName = 120;  // MRPT's own limit

bool isNameByte(unsigned char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= ':') || c == '_';
}

// Behind the next end flag; false if there is none.
bool toNextEndFlag(ByteCursor& cursor)
{
  const void* flag = std::memchr(cursor.here(), kEndFlag, cursor.left());
  if (flag == nullptr) return false;
  cursor.skip(static_cast<std::size_t>(static_cast<const unsigned char*>(flag) - cursor.here()) +
              1);
  return true;
}

// The header at the cursor, if there is a whole one.
std::optional<ObjectHeader> peekHeader(ByteCursor cursor)
{
  try
  {
    return readHeader(cursor);
  }
  catch (const Damage&)
  {
  }
  catch (const NeedMore&)
  {
  }
  return std::nullopt;
}

// An object that belongs there, or looks like one of a missing plugin.
bool beginsAt(const ByteCursor& cursor, Level level)
{
  const auto header = peekHeader(cursor);
  if (!header || belongs(*header, level)) return header.has_value();
  // MRPT's convention for the classes of plugins; what observations hold is named otherwise.
  const char* kind = level == Level::kActions ? "CAction" : "CObservation";
  return header->id == nullptr && !header->isNull() && header->name.find(kind) != std::string::npos;
}

bool pairBeginsAt(const ByteCursor& cursor)
{
  const auto header = peekHeader(cursor);
  return header && isFrameOrActions(*header);
}
}  // namespace

ObjectHeader readHeader(ByteCursor& cursor)
{
  const ByteCursor start = cursor;
  const auto notHere = [&]
  { start.damage(kNoObject, "fetch or record the file anew", core::ExitStatus::kUnreadable); };
  const auto length = cursor.read<std::uint8_t>();
  const std::size_t n = length & ~kNewFormat;
  if ((length & kNewFormat) == 0 || n < kShortestName || n > kLongestName) notHere();
  const unsigned char* name = cursor.here();
  if (!std::all_of(name, name + std::min(n, cursor.left()), isNameByte)) notHere();
  cursor.skip(n);
  ObjectHeader out;
  out.name.assign(reinterpret_cast<const char*>(name), n);
  if (out.isNull()) return out;
  out.version = cursor.read<std::uint8_t>();
  out.id = ::mrpt::rtti::findRegisteredClass(out.name);
  return out;
}

bool isFrameOrActions(const ObjectHeader& header)
{
  return header.id != nullptr && (header.id == classId<::mrpt::obs::CActionCollection>() ||
                                  header.id == classId<::mrpt::obs::CSensoryFrame>());
}

bool belongs(const ObjectHeader& header, Level level)
{
  if (header.id == nullptr) return header.isNull() && level != Level::kLog;
  if (level == Level::kActions) return header.id->derivedFrom(classId<::mrpt::obs::CAction>());
  return header.id->derivedFrom(classId<::mrpt::obs::CObservation>()) ||
         (level == Level::kLog && isFrameOrActions(header));
}

void skipUnknown(ByteCursor& cursor, Level level, bool last, bool atEnd)
{
  while (toNextEndFlag(cursor))
  {
    ByteCursor next = cursor;
    const bool hasHolder = level != Level::kLog;
    // The last in a holder comes before the holder's own end flag, and behind that the next entry.
    if (hasHolder && last && (next.left() == 0 || next.read<std::uint8_t>() != kEndFlag)) continue;
    if ((atEnd && last && next.left() == 0) || beginsAt(next, last ? Level::kLog : level)) return;
  }
  throw NeedMore{};
}

bool entryFollows(ByteCursor cursor, bool inFrameOrActions)
{
  while (toNextEndFlag(cursor))
    if (inFrameOrActions ? pairBeginsAt(cursor) : beginsAt(cursor, Level::kLog)) return true;
  return false;
}
}  // namespace slamot::mrpt
