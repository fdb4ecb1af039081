#include <slamot/mrpt/RawlogWriter.h>

#include <filesystem>
#include <fstream>

#include "program.h"

namespace slamot::test
{
namespace
{
namespace fs = std::filesystem;

core::Blob blob(const std::string& label, int id, std::optional<double> range)
{
  core::Blob out;
  out.label = label, out.id = id, out.range = range;
  out.rangeStd = 0.1, out.bearingStd = 0.01;
  return out;
}

class SlamotInfo : public ::testing::Test
{
 protected:
  SlamotInfo()
  {
    fs::create_directories(folder_);
    core::Starts starts;
    starts.time = 0;
    starts.targets[3].value[core::ObjectStart::kX] = 2.5;
    mrpt::RawlogWriter writer(path_, mrpt::RawlogWriter::Format::kActionFrames, starts);
    for (int i = 1; i <= 20; ++i)
    {
      core::Step step;
      step.time = 0.1 * i;
      step.odometry = math::turnThenMove(1, 0.2, 0.1, 0.1, 0.05);
      if (i % 4 == 0)
        step.landmarks.emplace().sightings.push_back({2, 0.1, 0.1, 0.01, core::kNoId});
      if (i == 10 || i == 20) step.blobs.emplace();
      if (i == 20) step.blobs->blobs = {blob("mate", core::kNoId, 2.0), blob("target", 3, {})};
      writer.write(step);
    }
    writer.close();
  }
  ~SlamotInfo() override { fs::remove_all(folder_); }

  const fs::path folder_ =
      fs::temp_directory_path() / ("slamot-info-" + std::to_string(::getpid()));
  const std::string path_ = (folder_ / "drive.rawlog").string();
};

bool has(const Outcome& o, const std::string& part)
{
  return o.text.find(part) != std::string::npos;
}

TEST_F(SlamotInfo, TellsSensorsRatesDurationAndStart)
{
  const Outcome o = slamot("info '" + path_ + "'");
  EXPECT_EQ(o.status, 0) << o.text;
  EXPECT_TRUE(has(o, "pairs of actions and sensory frames")) << o.text;
  EXPECT_TRUE(has(o, "which make 20 steps")) << o.text;
  EXPECT_TRUE(has(o, "duration  1.900 s, from 0.100 s to 2.000 s")) << o.text;
  EXPECT_TRUE(has(o, "mrpt::obs::CObservationBearingRange      LANDMARKS            5      2.50"))
      << o.text;
  EXPECT_TRUE(
      has(o, "landmarks 5 sightings in 5 scans, of which 0 saw nothing; none with identity\n"))
      << o.text;
  EXPECT_TRUE(has(o,
                  "targets   2 blobs in 2 scans, of which 1 saw nothing; 1 with identity, 1 with "
                  "range; labelled mate, target\n"))
      << o.text;
  EXPECT_TRUE(has(o, "start     target 3 at x 2.500 m")) << o.text;
  EXPECT_TRUE(has(o, "problems  none found")) << o.text;
}

TEST_F(SlamotInfo, TruncatedLogHasItsStatusAndOneErrorLine)
{
  fs::resize_file(path_, fs::file_size(path_) / 2);
  const Outcome o = slamot("info '" + path_ + "'");
  EXPECT_EQ(o.status, 3) << o.text;
  EXPECT_TRUE(has(o, "INCOMPLETE")) << o.text;
  EXPECT_TRUE(has(o, "slamot: error: " + path_ + " entry ")) << o.text;
}

TEST_F(SlamotInfo, OtherFilesAreUnreadable)
{
  std::ofstream(path_) << "no rawlog";
  for (const std::string& path : {path_, folder_.string(), std::string("/nonexistent.rawlog")})
  {
    const Outcome o = slamot("info '" + path + "'");
    EXPECT_EQ(o.status, 2) << o.text;
    EXPECT_EQ(o.text.rfind("slamot: error: " + path + ": ", 0), 0u) << o.text;
  }
}

TEST_F(SlamotInfo, NamesAPluginThatCanNotBeLoaded)
{
  const Outcome o = slamot("info '" + path_ + "' -p ./none.so");
  EXPECT_EQ(o.status, 1) << o.text;
  EXPECT_TRUE(has(o, "--plugin ./none.so: can't be loaded")) << o.text;
}
}  // namespace
}  // namespace slamot::test
