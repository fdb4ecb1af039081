#include <array>
#include <cstdio>

#include "bytes.h"
#include "exampleLog.h"

// slamot-mrpt as the plugin of MRPT's own programs.
namespace slamot::tests
{
namespace
{
/// What `rawlog-edit -p <plugin> -i log.rawlog <operation>` says in a folder.
std::string rawlogEdit(const std::filesystem::path& folder, const std::string& operation)
{
  const std::string command = "cd '" + folder.string() +
                              "' && " RAWLOG_EDIT " -p '" SLAMOT_PLUGIN "' -i log.rawlog " +
                              operation + " </dev/null 2>&1";
  std::string out;
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return out;
  std::array<char, 4096> part{};
  while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe))
    out.append(part.data(), n);
  ::pclose(pipe);
  return out;
}

class Plugin : public ::testing::TestWithParam<mrpt::RawlogWriter::Format>
{
 protected:
  void SetUp() override
  {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "MRPT's own program does not load what is built with a sanitizer";
#endif
    if (std::string(RAWLOG_EDIT).empty())
      GTEST_SKIP() << "rawlog-edit (mrpt-apps) is not installed";
    writeLog(folder_, GetParam(), exampleSteps(), exampleStarts());
  }
  const TemporaryFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Pairs, Plugin,
                         ::testing::Values(mrpt::RawlogWriter::Format::kActionFrames));
INSTANTIATE_TEST_SUITE_P(Observations, Plugin,
                         ::testing::Values(mrpt::RawlogWriter::Format::kObservations));

TEST_P(Plugin, RawlogEditCountsTheBlobs)
{
  const std::string info = rawlogEdit(folder_.path(), "--info");
  EXPECT_NE(info.find("BLOBS /      2 /"), std::string::npos) << info;
}

TEST_P(Plugin, RawlogEditExportsTheBlobsAsText)
{
  const std::string said = rawlogEdit(folder_.path(), "--export-txt");
  const std::string text = rawBytes(folder_.file("log_BLOBS.txt"));
  EXPECT_NE(text.find("BEARING_RAD"), std::string::npos) << said;
  EXPECT_NE(text.find("2 target 4 "), std::string::npos) << text;
  EXPECT_NE(text.find(" robot -1 "), std::string::npos) << text;
}

TEST_P(Plugin, RawlogEditDescribesEveryObject)
{
  const std::string text = rawlogEdit(folder_.path(), "--describe");
  EXPECT_NE(text.find("Blobs: 2"), std::string::npos) << text;
}
}  // namespace
}  // namespace slamot::tests
