#include <mrpt/obs/CObservation2DRangeScan.h>
#include <slamot/mrpt/LaserMaps.h>

#include <algorithm>

#include "BoundedInput.h"
#include "MemoryArchive.h"
#include "objectLayout.h"
#include "readObservation.h"
#include <slamot/mrpt/timestamp.h>

namespace slamot::mrpt
{
namespace
{
using core::Error;
using core::ExitStatus;
using ::mrpt::obs::CObservation2DRangeScan;

std::vector<unsigned char> bytesOf(const std::string& path)
{
  constexpr std::size_t kRead = 1u << 20;
  BoundedInput input(path);
  const BoundedInput::Working working(input);
  std::vector<unsigned char> bytes;
  for (std::size_t got = kRead; got == kRead;)
  {
    bytes.resize(bytes.size() + kRead);
    got = input.read(bytes.data() + bytes.size() - kRead, kRead);
    bytes.resize(bytes.size() - kRead + got);
  }
  if (input.truncated())
    throw Error(ExitStatus::kTruncated, path, "the gz file ends before its end mark",
                "run the filter anew");
  return bytes;
}

/// The scan that begins at the cursor, which moves on behind it.
CObservation2DRangeScan readScan(ByteCursor& cursor, const Entry& entry)
{
  const char* const mend = "run the filter anew";
  try
  {
    const unsigned char* begin = cursor.here();
    walkObject(cursor, readHeader(cursor));
    MemoryArchive archive(begin, static_cast<std::size_t>(cursor.here() - begin));
    CObservation2DRangeScan scan;
    archive.ReadObject(&scan);
    return scan;
  }
  catch (const NeedMore&)
  {
    entry.fail("the file ends inside a scan", mend, ExitStatus::kTruncated);
  }
  catch (const Damage& damage)
  {
    entry.fail(damage.what, mend, damage.status);
  }
  catch (const std::exception&)
  {
    entry.fail("MRPT refuses a scan", mend);
  }
}

void add(std::vector<PosedScans>& all, const CObservation2DRangeScan& scan, const Entry& entry)
{
  const auto time = toSeconds(scan.timestamp);
  if (!time) entry.fail("a scan has no time", "run the filter anew");
  core::Step step;
  addObservation(step, scan, entry, {});
  if (all.empty() || all.back().time != *time) all.push_back({*time, {}, {}});
  all.back().scans.push_back(step.lasers.front());
}
/// Where the next scan's header is, from a place on; else the end.
std::size_t nextScan(const std::vector<unsigned char>& bytes, std::size_t from)
{
  const std::string name = "mrpt::obs::CObservation2DRangeScan";
  const std::string mark = static_cast<char>(0x80 | name.size()) + name;
  const auto same = [](unsigned char a, char b) { return a == static_cast<unsigned char>(b); };
  const auto at = std::search(bytes.begin() + static_cast<std::ptrdiff_t>(from), bytes.end(),
                              mark.begin(), mark.end(), same);
  return static_cast<std::size_t>(at - bytes.begin());
}
}  // namespace

std::vector<PosedScans> loadScans(const std::string& path)
{
  // Poses and frames between the scans are skipped: MRPT's parser sees only what was walked over.
  std::vector<unsigned char> bytes = bytesOf(path);
  Entry entry;
  entry.path = path;
  std::vector<PosedScans> all;
  for (std::size_t at = nextScan(bytes, 0); at < bytes.size(); ++entry.number)
  {
    ByteCursor cursor(bytes.data(), bytes.size(), at);
    add(all, readScan(cursor, entry), entry);
    at = nextScan(bytes, cursor.at());
  }
  if (all.empty())
    throw Error(ExitStatus::kUnreadable, path, "holds no laser scans", "run the filter anew");
  return all;
}
}  // namespace slamot::mrpt
