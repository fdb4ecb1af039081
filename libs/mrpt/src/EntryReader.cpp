#include "EntryReader.h"

#include "MemoryArchive.h"
#include "readImage.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>

namespace slamot::mrpt
{
using core::Error;
using core::ExitStatus;

namespace
{
constexpr std::size_t kRead = 1u << 17;  // [byte] at a time, or more where an entry is larger
}

std::optional<Entry> EntryReader::next()
{
  const BoundedInput::Working working(input_);  // what a filter does between entries is not reading
  if (begin_ == end_ && !grow())
  {
    if (input_.truncated())
      throw Error(ExitStatus::kTruncated, where(0), "the gz file ends before its end mark",
                  "use the intact first part with --salvage");
    return std::nullopt;
  }
  for (;;)
  {
    ByteCursor cursor(window_.data() + begin_, end_ - begin_);
    try
    {
      const Walked walked = walk(cursor);
      Entry entry = parse(walked, cursor.at());
      begin_ += cursor.at();
      offset_ += cursor.at();
      ++count_;
      return entry;
    }
    catch (const NeedMore&)
    {
      if (!grow()) failAtEnd();
    }
    catch (const Damage& damage)
    {
      fail(damage);
    }
  }
}

bool EntryReader::grow()
{
  if (atEnd_) return false;
  const std::size_t held = end_ - begin_;
  if (held >= kLargestEntry)
    throw Error(ExitStatus::kLimit, where(0),
                "an entry of over " + std::to_string(kLargestEntry >> 20) + " MB",
                "take it out with rawlog-edit --cut");
  std::copy(window_.begin() + static_cast<std::ptrdiff_t>(begin_),
            window_.begin() + static_cast<std::ptrdiff_t>(end_), window_.begin());
  begin_ = 0, end_ = held;
  const std::size_t wanted = std::max(kRead, held);
  if (window_.size() < held + wanted) window_.resize(held + wanted);
  const std::size_t got = input_.read(window_.data() + held, wanted);
  end_ += got;
  atEnd_ = got < wanted;
  return got > 0;
}

bool EntryReader::reads(const ObjectHeader& header) const
{
  return hasLayout(header) &&
         (purpose_ == For::kEditing || header.id != classId<::mrpt::obs::CObservationImage>());
}

EntryReader::Walked EntryReader::walk(ByteCursor& cursor) const
{
  Walked out;
  const ByteCursor start = cursor;
  const ObjectHeader header = readHeader(cursor);
  const bool isFrame = header.id == classId<::mrpt::obs::CSensoryFrame>();
  if (!isFrameOrActions(header))
  {
    cursor = start;
    out.parts.push_back(walkPart(cursor, Level::kLog, true));
    out.kind = header.id == classId<::mrpt::obs::CObservationComment>() ? Entry::Kind::kComment
                                                                        : Entry::Kind::kObservation;
    return out;
  }
  requireVersion(cursor, header, isFrame ? 1 : 0, isFrame ? 2 : 0);
  if (isFrame && header.version == 1) cursor.skip(sizeof(std::uint32_t));
  out.countAt = cursor.at();
  const std::uint32_t n = cursor.count(kMostParts, 1, isFrame ? "observations" : "actions");
  for (std::uint32_t i = 0; i < n; ++i)
    out.parts.push_back(walkPart(cursor, isFrame ? Level::kFrame : Level::kActions, i + 1 == n));
  requireEndFlag(cursor, header.name);
  out.kind = isFrame ? Entry::Kind::kFrame : Entry::Kind::kActions;
  return out;
}

EntryReader::Extent EntryReader::walkPart(ByteCursor& cursor, Level level, bool last) const
{
  const ByteCursor start = cursor;
  Extent part{readHeader(cursor), start.at(), 0};
  if (part.header.id == nullptr && !part.header.isNull())
    start.damage("class '" + part.header.name + "' is unknown", "load its plugin with --plugin",
                 ExitStatus::kUnreadable);
  if (!belongs(part.header, level))
    start.damage("a " + part.header.name + " does not belong there", "give a rawlog",
                 ExitStatus::kUnreadable);
  if (part.header.isNull())
    requireEndFlag(cursor, part.header.name);
  else if (reads(part.header))
    walkObject(cursor, part.header);
  else
    skipUnknown(cursor, level, last, atEnd_);
  part.end = cursor.at();
  return part;
}

Entry EntryReader::parse(const Walked& walked, std::size_t size)
{
  Entry entry;
  entry.path = path_;
  entry.number = count_;
  entry.offset = offset_;
  entry.kind = walked.kind;
  entry.countAt = walked.countAt;
  if (purpose_ == For::kEditing)
  {
    const unsigned char* const first = window_.data() + begin_;
    entry.bytes.assign(first, first + size);
  }
  for (const Extent& part : walked.parts) entry.parts.push_back(parsePart(part));
  return entry;
}

Entry::Part EntryReader::parsePart(const Extent& extent)
{
  Entry::Part part;
  part.className = extent.header.id != nullptr ? extent.header.id->className : extent.header.name;
  if (!reads(extent.header)) return part;
  unsigned char* const first = window_.data() + begin_ + extent.begin;
  const std::size_t size = extent.end - extent.begin;
  bool whole = false;
  try
  {
    if (extent.header.id == classId<::mrpt::obs::CObservationImage>())
    {
      part.object = readImage(first, size);
      part.pictureAt = extent.begin + pictureIn(ByteCursor(first, size)).begin;
      whole = part.object != nullptr;
    }
    else
    {
      MemoryArchive archive(first, size);
      part.object = archive.ReadObject();
      whole = part.object != nullptr && archive.left() == 0;
    }
  }
  catch (const std::bad_alloc&)
  {
    throw;
  }
  catch (const std::exception&)
  {
    // MRPT says "due to EOF" whatever the cause.
  }
  if (!whole)
    throw Damage{extent.begin, "MRPT refuses a " + part.className,
                 "look for an identity that comes twice, or record the file anew",
                 ExitStatus::kNonsense};
  return part;
}

std::string EntryReader::where(std::size_t at) const
{
  return path_ + " entry " + std::to_string(count_) + ", byte " + std::to_string(offset_ + at) +
         (input_.packed() ? " unpacked" : "");
}

// The entry does not end with the file.  If others follow it, then it is its length that is wrong.
void EntryReader::failAtEnd()
{
  ByteCursor cursor(window_.data() + begin_, end_ - begin_);
  std::string name = "an entry's first bytes";
  bool othersFollow = false;
  try
  {
    const ObjectHeader header = readHeader(cursor);
    name = "a " + header.name;
    othersFollow = entryFollows(cursor, isFrameOrActions(header));
  }
  catch (const NeedMore&)
  {
  }
  if (othersFollow)
    fail({0, "a length or count in " + name + " goes beyond the end of the file",
          "fetch or record the file anew", ExitStatus::kNonsense});
  throw Error(ExitStatus::kTruncated, where(0), "the file ends inside " + name,
              "use the intact first part with --salvage");
}

void EntryReader::fail(const Damage& damage)
{
  if (count_ == 0 && damage.at == 0 && damage.what == kNoObject)
    throw Error(ExitStatus::kUnreadable, path_, "is not a rawlog", "give the path of a rawlog");
  input_.drain();  // damaged gz data is the cause, and what came out of it only the consequence
  throw Error(damage.status, where(damage.at), damage.what, damage.mend);
}
}  // namespace slamot::mrpt
