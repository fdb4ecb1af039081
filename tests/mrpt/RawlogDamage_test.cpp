#include "bytes.h"
#include "exampleLog.h"

#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationComment.h>
#include <slamot/core/Error.h>
#include <sys/resource.h>

#include <functional>
#include <limits>
#include <set>

namespace slamot::tests
{
namespace
{
using core::ExitStatus;
using slamot::mrpt::RawlogSource;
using Format = slamot::mrpt::RawlogWriter::Format;

struct Outcome
{
  ExitStatus status = ExitStatus::kDone;
  std::string message;
  std::size_t steps = 0;
};

/// Reads all of a log; what is no core::Error fails the test that called.
Outcome read(const std::string& path, bool salvage = false)
{
  Outcome out;
  try
  {
    RawlogSource::Options options = model();
    options.salvage = salvage;
    RawlogSource source(path, options);
    while (source.next()) ++out.steps;
    out.message = source.truncation();
  }
  catch (const core::Error& e)
  {
    out.status = e.status();
    out.message = e.what();
  }
  return out;
}

bool has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/// Where entries end, by MRPT's own reader.
std::set<std::size_t> boundaries(const std::string& plain)
{
  ::mrpt::io::CMemoryStream memory(plain.data(), plain.size());
  auto archive = ::mrpt::serialization::archiveFrom(memory);
  std::set<std::size_t> out;
  while (memory.getPosition() < plain.size())
  {
    archive.ReadObject();
    out.insert(memory.getPosition());
  }
  return out;
}

class RawlogDamage : public ::testing::TestWithParam<Format>
{
 protected:
  RawlogDamage()
  {
    const std::string path = writeLog(folder_, GetParam(), exampleSteps(), exampleStarts());
    packed_ = rawBytes(path);
    plain_ = unpackedBytes(path);
  }
  Outcome readBytes(const std::string& bytes, bool salvage = false) const
  {
    saveBytes(folder_.file("x.rawlog"), bytes);
    return read(folder_.file("x.rawlog"), salvage);
  }

  const TemporaryFolder folder_;
  std::string packed_, plain_;
};

INSTANTIATE_TEST_SUITE_P(Pairs, RawlogDamage, ::testing::Values(Format::kActionFrames));
INSTANTIATE_TEST_SUITE_P(Observations, RawlogDamage, ::testing::Values(Format::kObservations));

TEST_P(RawlogDamage, PlainLogReadsAsThePackedOne)
{
  EXPECT_EQ(readBytes(plain_).steps, exampleSteps().size());
  EXPECT_EQ(readBytes(packed_).steps, exampleSteps().size());
}

TEST_P(RawlogDamage, PlainLogCutAnywhereIsTruncatedButBetweenEntries)
{
  const auto ends = boundaries(plain_);
  for (std::size_t size = 1; size < plain_.size(); size += 3)
  {
    if (ends.count(size) > 0) continue;  // nothing tells that there was more
    const Outcome o = readBytes(plain_.substr(0, size));
    ASSERT_EQ(o.status, ExitStatus::kTruncated) << size << ": " << o.message;
    ASSERT_TRUE(has(o.message, "entry ")) << o.message;
    ASSERT_TRUE(has(o.message, "byte ")) << o.message;
    ASSERT_TRUE(has(o.message, "--salvage")) << o.message;
  }
}

TEST_P(RawlogDamage, PackedLogCutAnywhereIsTruncated)
{
  for (std::size_t size = 2; size < packed_.size(); ++size)
  {
    const Outcome o = readBytes(packed_.substr(0, size));
    ASSERT_EQ(o.status, ExitStatus::kTruncated) << size << ": " << o.message;
  }
}

TEST_P(RawlogDamage, SalvageDeliversTheIntactFirstPart)
{
  for (const std::string& bytes : {plain_, packed_})
  {
    std::size_t last = 0;
    for (std::size_t size = 2; size < bytes.size(); size += 3)
    {
      const Outcome o = readBytes(bytes.substr(0, size), true);
      ASSERT_TRUE(o.status == ExitStatus::kDone || o.status == ExitStatus::kUnreadable)
          << size << ": " << o.message;
      if (o.message.empty()) continue;   // cut between entries
      ASSERT_GE(o.steps, last) << size;  // more bytes, no fewer steps
      last = o.steps;
    }
    EXPECT_GE(last, exampleSteps().size() - 1);
  }
}

TEST_P(RawlogDamage, SalvageTellsHowMuchThatIs)
{
  const Outcome o = readBytes(plain_.substr(0, plain_.size() - 5), true);
  EXPECT_EQ(o.status, ExitStatus::kDone);
  EXPECT_TRUE(has(o.message, "used its intact first part, " + std::to_string(o.steps) + " steps"))
      << o.message;
}

TEST_P(RawlogDamage, FlippedBitsOfPlainLogsNeverDoMoreThanFail)
{
  for (std::size_t bit = 0; bit < 8 * plain_.size(); bit += 5)
  {
    std::string bytes = plain_;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << bit % 8));
    const Outcome o = readBytes(bytes);
    ASSERT_NE(o.status, ExitStatus::kInternal) << bit;
    ASSERT_TRUE(o.status == ExitStatus::kDone || has(o.message, "x.rawlog")) << o.message;
  }
}

TEST_P(RawlogDamage, FlippedBitsOfPackedLogsAreFound)
{
  // The first ten bytes hold what does not matter to the data, such as the time of packing.
  for (std::size_t bit = 80; bit < 8 * packed_.size(); bit += 3)
  {
    std::string bytes = packed_;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << bit % 8));
    const Outcome o = readBytes(bytes);
    // Some bits of a code table are for symbols that do not occur.
    const bool harmless =
        o.status == ExitStatus::kDone && unpackedBytes(folder_.file("x.rawlog")) == plain_;
    ASSERT_TRUE(harmless || o.status == ExitStatus::kUnreadable ||
                o.status == ExitStatus::kTruncated)
        << bit << ": " << static_cast<int>(o.status) << " " << o.message;
  }
}

TEST_P(RawlogDamage, HugeCountsAnywhereCostNothing)
{
  for (const std::uint32_t huge : {0xffffffffu, 0x7fffffffu, 0x00ffffffu, 0x00010000u})
    for (std::size_t at = 0; at + 4 <= plain_.size(); at += 2)
    {
      std::string bytes = plain_;
      for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(huge >> (8 * i) & 0xff);
      ASSERT_NE(readBytes(bytes).status, ExitStatus::kInternal) << at;
    }
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 1 << 20);  // [kB]
}

TEST(RawlogFault, FilesThatAreNoRawlogsAreUnreadable)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("x.rawlog");
  const auto status = [&](const std::string& bytes)
  {
    saveBytes(path, bytes);
    return read(path).status;
  };
  EXPECT_EQ(read(folder.file("none.rawlog")).status, ExitStatus::kUnreadable);
  EXPECT_EQ(read(folder.path().string()).status, ExitStatus::kUnreadable);
  EXPECT_EQ(status(""), ExitStatus::kUnreadable);
  EXPECT_EQ(status("a text of some length\nwith lines\n"), ExitStatus::kUnreadable);
  EXPECT_EQ(status("\x89PNG\r\n\x1a\n and more"), ExitStatus::kUnreadable);
  EXPECT_EQ(status(std::string(4096, '\0')), ExitStatus::kUnreadable);
  EXPECT_EQ(status(std::string(4096, '\xff')), ExitStatus::kUnreadable);
  savePacked(path, "garbage that is no rawlog");
  EXPECT_EQ(read(path).status, ExitStatus::kUnreadable);
  EXPECT_TRUE(has(read(path).message, "is not a rawlog"));
}

TEST(RawlogFault, FuzzersCorpusIsReadOrRefused)
{
  std::size_t files = 0;
  for (const auto& file : std::filesystem::directory_iterator(SLAMOT_FUZZ_CORPUS))
  {
    for (const bool salvage : {false, true})
    {
      const Outcome o = read(file.path().string(), salvage);
      EXPECT_NE(o.status, ExitStatus::kInternal) << file.path() << ": " << o.message;
    }
    ++files;
  }
  EXPECT_GE(files, 5u);
}

TEST(RawlogFault, UnknownClassNamesItsEntryAndThePluginOption)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("x.rawlog");
  const std::string name = "foo::CObservationBar";
  saveBytes(path, serialized(::mrpt::obs::CObservationComment()) +
                      static_cast<char>(0x80 | name.size()) + name + std::string(20, '\1') +
                      '\x88');
  const Outcome o = read(path);
  EXPECT_EQ(o.status, ExitStatus::kUnreadable);
  EXPECT_TRUE(has(o.message, "x.rawlog entry 1, byte ")) << o.message;
  EXPECT_TRUE(
      has(o.message, ": class 'foo::CObservationBar' is unknown; load its plugin with --plugin"))
      << o.message;
}

TEST(RawlogFault, BombReachesTheLimit)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("x.rawlog");
  ::mrpt::obs::CObservationComment comment;
  comment.text.assign(4000000, ' ');
  savePacked(path, serialized(comment));
  const std::string member = rawBytes(path);  // gz files may follow each other in one
  std::string bytes;
  for (int i = 0; i < 100; ++i) bytes += member;
  saveBytes(path, bytes);
  EXPECT_EQ(read(path).status, ExitStatus::kLimit);
}

TEST(RawlogFault, EntryBeyondTheLimitIsRefused)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("x.rawlog");
  ::mrpt::obs::CObservationComment comment;
  comment.text.assign(5000000, ' ');
  savePacked(path, serialized(comment));
  const Outcome o = read(path);
  EXPECT_EQ(o.status, ExitStatus::kNonsense);
  EXPECT_TRUE(has(o.message, "5000000 bytes of comment")) << o.message;
}

/// One sighting at 1 s, then one at 2 s that `change` has changed.
Outcome readChanged(const std::function<void(::mrpt::obs::CObservationBearingRange&)>& change)
{
  const TemporaryFolder folder;
  ::mrpt::obs::CObservationBearingRange o;
  o.timestamp = ::mrpt::Clock::fromDouble(1);
  o.sensor_std_range = 0.1f, o.sensor_std_yaw = 0.01f;
  o.sensedData.push_back({2, 0.1f, 0, 5, {}});
  std::string bytes = serialized(o);
  o.timestamp = ::mrpt::Clock::fromDouble(2);
  change(o);
  bytes += serialized(o);
  saveBytes(folder.file("x.rawlog"), bytes);
  return read(folder.file("x.rawlog"));
}

TEST(RawlogFault, ValuesThatMakeNoSenseNameTheirEntry)
{
  using O = ::mrpt::obs::CObservationBearingRange;
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(readChanged([](O&) {}).steps, 2u);
  const std::vector<std::pair<const char*, std::function<void(O&)>>> changes = {
      {"range", [&](O& o) { o.sensedData[0].range = nan; }},
      {"bearing", [&](O& o) { o.sensedData[0].yaw = nan; }},
      {"infinite", [&](O& o) { o.sensedData[0].range = std::numeric_limits<float>::infinity(); }},
      {"std", [&](O& o) { o.sensor_std_range = nan; }},
      {"negative", [&](O& o) { o.sensor_std_yaw = -0.1f; }},
      {"zero", [&](O& o) { o.sensor_std_yaw = 0; }},
      {"view", [&](O& o) { o.fieldOfView_yaw = nan; }},
      {"time", [&](O& o) { o.timestamp = ::mrpt::Clock::fromDouble(0.5); }}};
  for (const auto& [name, change] : changes)
  {
    const Outcome o = readChanged(change);
    EXPECT_EQ(o.status, ExitStatus::kNonsense) << name << ": " << o.message;
    EXPECT_TRUE(has(o.message, "x.rawlog entry 1")) << o.message;
  }
}

TEST(RawlogFault, TimeGoingBackwardsTellsBothTimes)
{
  const Outcome o = readChanged([](auto& observation)
                                { observation.timestamp = ::mrpt::Clock::fromDouble(0.5); });
  EXPECT_TRUE(has(o.message, "entry 1: time 0.500000 s follows 1.000000 s; sort it")) << o.message;
}

TEST(RawlogFault, ZeroDeviationTellsTheKeysThatMendIt)
{
  const Outcome o = readChanged([](auto& observation) { observation.sensor_std_range = 0; });
  EXPECT_TRUE(has(o.message, "range_std_m and bearing_std_deg in [sensor]")) << o.message;
}

TEST(RawlogFault, MalformedStartIsAConfigurationError)
{
  const TemporaryFolder folder;
  ::mrpt::obs::CObservationComment comment;
  comment.text = "[start]\nrobot_x_m = one\n";
  const auto log = writeLog(folder, Format::kActionFrames, exampleSteps(), {});
  saveBytes(folder.file("x.rawlog"), serialized(comment) + unpackedBytes(log));
  EXPECT_EQ(read(folder.file("x.rawlog")).status, ExitStatus::kConfig);
  comment.text = "a drive on a sunny day // = [";
  saveBytes(folder.file("x.rawlog"), serialized(comment) + unpackedBytes(log));
  EXPECT_EQ(read(folder.file("x.rawlog")).status, ExitStatus::kDone);
}
}  // namespace
}  // namespace slamot::tests
