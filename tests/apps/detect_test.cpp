#include <mrpt/obs/CObservationBearingRange.h>
#include <slamot/mrpt/CObservationColorBlobs.h>
#include <slamot/mrpt/RawlogSource.h>
#include <slamot/results/TruthFiles.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cameraLog.h"
#include "program.h"

namespace slamot::test
{
namespace
{
namespace fs = std::filesystem;

class SlamotDetect : public ::testing::Test
{
 protected:
  SlamotDetect() { fs::create_directories(folder_); }
  ~SlamotDetect() override { fs::remove_all(folder_); }

  Outcome detect(const std::string& more = {})
  {
    return slamot(
        "detect '" SLAMOT_SOURCE_DIR "/config-ini/detect.ini' in.rawlog -o out.rawlog " + more,
        folder_.string());
  }
  [[nodiscard]] std::string path(const std::string& name) const
  {
    return (folder_ / name).string();
  }
  [[nodiscard]] std::vector<core::Step> steps(const std::string& name) const
  {
    mrpt::RawlogSource::Options options;
    options.odometry.fromLog = false;
    options.odometry.vStd = 0.1;
    options.odometry.omegaStd = 0.1;
    mrpt::RawlogSource source(path(name), options);
    std::vector<core::Step> out;
    while (auto step = source.next()) out.push_back(*step);
    return out;
  }

  [[nodiscard]] nlohmann::json jsonOf(const std::string& name) const
  {
    std::ifstream file(path(name));
    return nlohmann::json::parse(file);
  }

  /// Every look must have seen the target where it was, most of them with its range.
  void expectTarget(const std::vector<core::Step>& all, std::size_t looks) const
  {
    std::size_t seen = 0, ranged = 0;
    for (const core::Step& step : all)
    {
      if (!step.blobs) continue;
      ++seen;
      const Circle target = CameraLog::targetAt(step.time);
      const Pose2D at = math::between(CameraLog::robotAt(step.time), {target.at.x, target.at.y, 0});
      ASSERT_EQ(step.blobs->blobs.size(), 1u) << step.time;
      const core::Blob& b = step.blobs->blobs[0];
      EXPECT_EQ(b.label, "target");
      if (!b.range) continue;
      ++ranged;
      EXPECT_NEAR(*b.range, std::hypot(at.x, at.y), 5 * b.rangeStd) << step.time;
      EXPECT_LT(b.rangeStd, 0.06);
      EXPECT_NEAR(b.bearing, std::atan2(at.y, at.x), 5 * b.bearingStd) << step.time;
      EXPECT_LT(b.bearingStd, 0.02);
    }
    EXPECT_EQ(seen, looks);
    EXPECT_GE(ranged, looks * 9 / 10);
  }
  /// Every sighting must be of a post, and most posts in view be sighted.
  static void expectPosts(const std::vector<core::Step>& all, std::size_t scans)
  {
    std::size_t seen = 0, sightings = 0;
    for (const core::Step& step : all)
    {
      if (!step.landmarks) continue;
      ++seen;
      for (const core::Sighting& s : step.landmarks->sightings)
      {
        ++sightings;
        const Point2D at =
            math::transform(CameraLog::robotAt(step.time),
                            {s.range * std::cos(s.bearing), s.range * std::sin(s.bearing)});
        double nearest = 1e9;
        for (const Circle& c : CameraLog::posts())
          nearest = std::min(nearest, std::hypot(c.at.x - at.x, c.at.y - at.y));
        EXPECT_LT(nearest, 0.15) << step.time;
      }
    }
    EXPECT_EQ(seen, scans);
    EXPECT_GT(sightings, 4 * scans);
  }

  /// Every look must have seen the other robot where it was, and no post be taken where it stood.
  static void expectMate(const std::vector<core::Step>& all, const eval::Trajectory& own,
                         const eval::Trajectory& mate)
  {
    std::size_t ranged = 0;
    for (const core::Step& step : all)
    {
      if (!step.blobs) continue;
      const Pose2D at = math::between(own.at(step.time)->pose, mate.at(step.time)->pose);
      ASSERT_EQ(step.blobs->blobs.size(), 1u) << step.time;
      const core::Blob& b = step.blobs->blobs[0];
      EXPECT_EQ(b.label, "robot");
      EXPECT_NEAR(math::wrapToPi(b.bearing - std::atan2(at.y, at.x)), 0, 5 * b.bearingStd);
      if (b.range)
      {
        EXPECT_NEAR(*b.range, std::hypot(at.x, at.y), 5 * b.rangeStd) << step.time;
      }
      ranged += b.range ? 1 : 0;
      for (const core::Sighting& s : step.landmarks->sightings)
        EXPECT_GT(
            std::hypot(s.range * std::cos(s.bearing) - at.x, s.range * std::sin(s.bearing) - at.y),
            0.3)
            << step.time;
    }
    EXPECT_GE(ranged, 36u);
  }

  const fs::path folder_ =
      fs::temp_directory_path() / ("slamot-detect-" + std::to_string(::getpid()));
};

TEST_F(SlamotDetect, AddsBlobsAndPostsToObservations)
{
  CameraLog::write(path("in.rawlog"));
  const Outcome o = detect();
  ASSERT_EQ(o.status, 0) << o.text;
  EXPECT_NE(o.text.find("40 blobs in 40 images"), std::string::npos) << o.text;
  const auto all = steps("out.rawlog");
  expectTarget(all, 40);
  expectPosts(all, 40);
  const Outcome info = slamot("info out.rawlog", folder_.string());
  for (const char* part : {"CAMERA_BLOBS", "LASER_LANDMARKS", "CObservationImage"})
    EXPECT_NE(info.text.find(part), std::string::npos) << info.text;
}

TEST_F(SlamotDetect, AddsThemToFrames)
{
  CameraLogOptions options;
  options.frames = true;
  options.jpeg = false;
  CameraLog::write(path("in.rawlog"), options);
  const Outcome o = detect();
  ASSERT_EQ(o.status, 0) << o.text;
  const auto all = steps("out.rawlog");
  EXPECT_EQ(all.size(), 40u);
  expectTarget(all, 40);
  expectPosts(all, 40);
}

TEST_F(SlamotDetect, ReadsImagesBesideTheLog)
{
  CameraLogOptions options;
  options.filesBeside = true;
  options.steps = 5;
  CameraLog::write(path("in.rawlog"), options);
  ASSERT_EQ(detect().status, 0);
  expectTarget(steps("out.rawlog"), 5);
  EXPECT_TRUE(fs::exists(path("out_Images/camera_0.png")));  // the new log finds them too
  fs::remove(path("in_Images/camera_2.png"));
  std::ofstream(path("in_Images/camera_3.png")) << "no image";
  const Outcome o =
      slamot("detect '" SLAMOT_SOURCE_DIR "/config-ini/detect.ini' in.rawlog -o other.rawlog",
             folder_.string());
  EXPECT_EQ(o.status, 0);
  EXPECT_NE(o.text.find("2 images can't be read"), std::string::npos) << o.text;
  expectTarget(steps("other.rawlog"), 3);
}

TEST_F(SlamotDetect, ImagesOfAnotherLogAreNotTakenForTheNewOnes)
{
  CameraLogOptions options;
  options.filesBeside = true;
  options.steps = 3;
  CameraLog::write(path("in.rawlog"), options);
  fs::create_directory(path("out_Images"));
  std::ofstream(path("out_Images/camera_0.png")) << "another's";
  const Outcome refused = detect();
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.text,
            "slamot: error: out_Images: is there, and the new log would take its images for its "
            "own; move it away, or give another --output\n");
  EXPECT_FALSE(fs::exists(path("out.rawlog")));
  fs::remove_all(path("out_Images"));
  fs::create_directory(path("old"));
  fs::create_directory_symlink(path("old"), path("out_Images"));  // an older detection's
  ASSERT_EQ(detect().status, 0);
  EXPECT_TRUE(fs::equivalent(path("out_Images"), path("in_Images")));
  ASSERT_EQ(detect().status, 0) << "and again";
  EXPECT_TRUE(fs::exists(path("old")));
}

TEST_F(SlamotDetect, KeepsAllTheRestByteForByte)
{
  CameraLogOptions options;
  options.steps = 5;
  CameraLog::write(path("in.rawlog"), options);
  const Outcome o = detect("--set detect.colors=none --set detect.landmarks=corners");
  ASSERT_EQ(o.status, 0) << o.text;
  // Corners are in none of the scans: taking the empty observations out leaves the log as it was.
  const auto before = steps("in.rawlog"), after = steps("out.rawlog");
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    EXPECT_EQ(before[i].time, after[i].time);
    EXPECT_EQ(before[i].lasers.size(), after[i].lasers.size());
    EXPECT_EQ(after[i].landmarks.has_value(), !after[i].lasers.empty());
  }
}

TEST_F(SlamotDetect, CommentsOfAnotherDayDoNotMatter)
{
  CameraLogOptions options;
  options.steps = 10;
  options.comments = true;
  CameraLog::write(path("in.rawlog"), options);
  const Outcome o = detect();
  ASSERT_EQ(o.status, 0) << o.text;
  expectTarget(steps("out.rawlog"), 10);
  options.frames = true;  // there between an action and its frame too
  CameraLog::write(path("in.rawlog"), options);
  ASSERT_EQ(detect().status, 0);
  expectTarget(steps("out.rawlog"), 10);
}

TEST_F(SlamotDetect, OdometryBesideActionsIsTheSameAgain)
{
  CameraLogOptions options;
  options.steps = 10;
  options.frames = true;
  CameraLog::write(path("in.rawlog"), options);
  ASSERT_EQ(detect().status, 0);
  const auto alone = steps("out.rawlog");
  options.odometryInFrames = true;
  CameraLog::write(path("in.rawlog"), options);
  ASSERT_EQ(detect().status, 0);
  const auto beside = steps("out.rawlog");
  ASSERT_EQ(alone.size(), beside.size());
  for (std::size_t i = 0; i < alone.size(); ++i)
  {
    EXPECT_EQ(alone[i].landmarks->sightings.size(), beside[i].landmarks->sightings.size());
    EXPECT_EQ(*alone[i].blobs->blobs[0].range, *beside[i].blobs->blobs[0].range);
  }
}

TEST_F(SlamotDetect, WhatIsFartherThanBlobsAreSeenKeepsItsBearing)
{
  CameraLogOptions options;
  options.steps = 10;
  CameraLog::write(path("in.rawlog"), options);
  ASSERT_EQ(detect("--set blobs.max_range_m=2").status, 0);  // the target is 3 m off
  std::size_t bearings = 0;
  for (const core::Step& step : steps("out.rawlog"))
    if (step.blobs)
      for (const core::Blob& b : step.blobs->blobs) bearings += b.range ? 0 : 1;
  EXPECT_EQ(bearings, 10u);
}

TEST_F(SlamotDetect, TimeGoingBackIsAnError)
{
  CameraLogOptions options;
  options.steps = 10;
  options.jumpBackAt = 6;
  CameraLog::write(path("in.rawlog"), options);
  const Outcome o = detect();
  EXPECT_EQ(o.status, 4) << o.text;
  EXPECT_NE(o.text.find("follows"), std::string::npos) << o.text;
  EXPECT_FALSE(fs::exists(path("out.rawlog")));
}

TEST_F(SlamotDetect, RefusesWhatItCannotUse)
{
  CameraLogOptions options;
  options.steps = 3;
  CameraLog::write(path("in.rawlog"), options);
  const auto expect = [&](int status, const std::string& more, const std::string& part)
  {
    fs::remove(path("out.rawlog"));
    const Outcome o = detect(more);
    EXPECT_EQ(o.status, status) << more << ": " << o.text;
    EXPECT_NE(o.text.find(part), std::string::npos) << o.text;
    EXPECT_FALSE(fs::exists(path("out.rawlog"))) << more;
  };
  expect(1, "--set detect.landmarks=flowers", "landmark detector 'flowers' is unknown");
  expect(1, "--set detect.colors=none --set detect.landmarks=none", "nothing to detect");
  expect(1, "--set color.target.hue_min_deg=400", "hue_min_deg");
  expect(1, "--set color.target.hue=4", "unknown key");
  expect(1, "--set detect.colors=targt", "has no section [color.targt]");
  const Outcome same =
      slamot("detect '" SLAMOT_SOURCE_DIR "/config-ini/detect.ini' in.rawlog -o in.rawlog",
             folder_.string());
  EXPECT_EQ(same.status, 2) << same.text;
  // Cut short, it is worth nothing.
  fs::resize_file(path("in.rawlog"), fs::file_size(path("in.rawlog")) * 2 / 3);
  expect(3, "", "ends");
  std::ofstream(path("in.rawlog")) << "no log";
  expect(2, "", "is not a rawlog");
}

TEST_F(SlamotDetect, AnyFlippedByteEndsInOneLineOrInALog)
{
  CameraLogOptions options;
  options.steps = 2;
  CameraLog::write(path("in.gz.rawlog"), options);
  // Unpacked, so that a flip reaches the parser.
  ASSERT_EQ(
      std::system(
          ("gzip -dc < '" + path("in.gz.rawlog") + "' > '" + path("whole.rawlog") + "'").c_str()),
      0);
  std::ifstream in(path("whole.rawlog"), std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  math::RandomStream random{5};
  for (int i = 0; i < 25; ++i)
  {
    std::string flipped = whole;
    // Half of them in the first kilobytes, where the headers and the camera are.
    const double reach = i % 2 == 0 ? 4000 : static_cast<double>(whole.size());
    flipped[static_cast<std::size_t>(random.uniform(0, reach))] ^= static_cast<char>(1 << (i % 8));
    std::ofstream(path("in.rawlog"), std::ios::binary) << flipped;
    const Outcome o = detect("-q");
    EXPECT_TRUE(o.status == 0 || (o.status >= 2 && o.status <= 5)) << o.status << o.text;
    if (o.status != 0)
    {
      EXPECT_NE(o.text.find("slamot: error: "), std::string::npos) << o.text;
    }
  }
}

// From raw data to estimates: images and scans alone, of the shipped scenario.
TEST_F(SlamotDetect, TheSimulatedPioneersAreTrackedFromImagesAndScans)
{
  const std::string configs = "'" SLAMOT_SOURCE_DIR "/config-ini/";
  ASSERT_EQ(slamot("simulate " + configs +
                       "sim.pioneers.ini' -o in.rawlog --set world.steps=120 --images beside",
                   folder_.string())
                .status,
            0);
  EXPECT_TRUE(fs::is_directory(path("in_Images")));
  ASSERT_EQ(detect().status, 0);
  fs::copy(path("in.truth"), path("out.truth"));
  const Outcome run =
      slamot("run " + configs + "slamot.ini' out.rawlog -o result", folder_.string());
  ASSERT_EQ(run.status, 0) << run.text;
  const auto summary = jsonOf("result/summary.json");
  EXPECT_LT(summary["robot"]["position_rmse_m"], 0.1);
  ASSERT_EQ(summary["targets"].size(), 1u);
  EXPECT_LT(summary["targets"][0]["position_rmse_m"], 0.2);
  EXPECT_GT(summary["targets"][0]["tracked_fraction"], 0.9);
  EXPECT_GT(summary["landmarks"]["mapped"], 5);
  EXPECT_LT(summary["scan_map"]["mean_map_entropy"],
            summary["scan_map"]["odometry_mean_map_entropy"]);
  for (const char* name : {"grid.png", "map.gridmap", "points.txt", "map.simplemap"})
    EXPECT_TRUE(fs::exists(path(std::string("result/") + name))) << name;
  EXPECT_TRUE(summary["scan_map"]["path_entropy"].is_null()) << "it keeps no path";
  EXPECT_FALSE(fs::exists(path("result/path")));

  // The same from a whole path of one particle, and once more from the folder.
  const Outcome particles = slamot("run " + configs +
                                       "rbpf-slamot.ini' out.rawlog -o particles --set "
                                       "rbpf-slamot.association=nn",
                                   folder_.string());
  ASSERT_EQ(particles.status, 0) << particles.text;
  EXPECT_NE(particles.text.find("; of its final path -"), std::string::npos) << particles.text;
  const auto written = jsonOf("particles/summary.json")["scan_map"];
  EXPECT_LT(written["path_entropy"], written["odometry_mean_map_entropy"]);
  for (const char* name : {"robot.tum", "grid.png", "map.gridmap", "points.txt", "map.simplemap"})
    EXPECT_TRUE(fs::exists(path(std::string("particles/path/") + name))) << name;
  ASSERT_EQ(slamot("evaluate particles -o again.json", folder_.string()).status, 0);
  const auto again = jsonOf("again.json")["scan_map"];
  for (const char* key : {"path_entropy", "mean_map_entropy", "odometry_mean_map_entropy"})
    EXPECT_NEAR(again[key].get<double>(), written[key].get<double>(), 1e-6) << key;
}

// Each sees the other's body in its own raw data, and the team fuses what they tell of it.
TEST_F(SlamotDetect, TwoSimulatedPioneersSeeEachOtherAndAreATeam)
{
  const std::string configs = "'" SLAMOT_SOURCE_DIR "/config-ini/";
  const auto succeed = [&](const std::string& arguments)
  {
    const Outcome o = slamot(arguments, folder_.string());
    EXPECT_EQ(o.status, 0) << o.text;
    return o.text;
  };
  succeed("simulate " + configs + "sim.two-pioneers.ini' -o raw.rawlog --set world.steps=80");
  std::map<int, eval::Truth> truths;
  for (int robot = 0; robot < 2; ++robot)
  {
    const std::string name = ".robot" + std::to_string(robot);
    const std::string text = succeed("detect " + configs + "detect.robots.ini' raw" + name +
                                     ".rawlog -o seen" + name + ".rawlog");
    EXPECT_NE(text.find("40 blobs in 40 images"), std::string::npos) << text;
    fs::copy(path("raw" + name + ".truth"), path("seen" + name + ".truth"));
    truths[robot] = results::loadTruth(path("raw" + name + ".truth"));
  }
  for (int robot = 0; robot < 2; ++robot)
    expectMate(steps("seen.robot" + std::to_string(robot) + ".rawlog"), truths[robot].robot,
               truths[1 - robot].robot);
  succeed("team " + configs + "team-pioneers.ini' seen.robot0.rawlog seen.robot1.rawlog -o team");
  for (const char* robot : {"seen.robot0", "seen.robot1"})
  {
    std::ifstream file(path(std::string("team/") + robot + "/summary.json"));
    const auto summary = nlohmann::json::parse(file);
    EXPECT_LT(summary["robot"]["position_rmse_m"], 0.2) << robot;
    EXPECT_GT(summary["landmarks"]["mapped"], 5) << robot;
    std::ifstream messages(path(std::string("team/") + robot + "/fusions.csv"));
    std::size_t lines = 0;
    for (std::string line; std::getline(messages, line);) ++lines;
    EXPECT_GT(lines, 5u) << robot;
  }
}

TEST_F(SlamotDetect, TakesLandmarksOfAPlugin)
{
  CameraLogOptions options;
  options.steps = 3;
  CameraLog::write(path("in.rawlog"), options);
  const std::string keys =
      "--set detect.landmarks=lamps --set detect.colors=none --plugin '" SLAMOT_LAMPS "'";
  EXPECT_EQ(detect(keys).status, 1);  // its key is missing
  const Outcome o = detect(keys + " --set lamps.max_range_m=100");
  ASSERT_EQ(o.status, 0) << o.text;
  for (const core::Step& step : steps("out.rawlog"))
    if (step.landmarks)
    {
      EXPECT_GT(step.landmarks->sightings.size(), 5u);
    }
}

TEST_F(SlamotDetect, ProposesAColour)
{
  cv::Mat image = perception::test::background();
  perception::test::drawDisc(image, {300, 200}, 40, perception::test::color(25, 0.9, 0.8));
  cv::imwrite(path("photo.png"), image);
  const Outcome o =
      slamot("calibrate-color photo.png --box 260,160,81,81 --label ball", folder_.string());
  ASSERT_EQ(o.status, 0) << o.text;
  std::ofstream(path("ball.ini")) << o.text << "[detect]\ncolors = ball\nlandmarks = none\n";
  CameraLogOptions options;
  options.steps = 3;
  CameraLog::write(path("in.rawlog"), options);
  const Outcome found = slamot("detect ball.ini in.rawlog -o out.rawlog", folder_.string());
  EXPECT_NE(found.text.find("3 blobs in 3 images"), std::string::npos) << found.text;
  EXPECT_EQ(slamot("calibrate-color photo.png --box 600,0,100,100", folder_.string()).status, 1);
  EXPECT_EQ(slamot("calibrate-color photo.png --box 1,2,3", folder_.string()).status, 1);
  EXPECT_EQ(slamot("calibrate-color ball.ini --box 1,2,3,4", folder_.string()).status, 2);
}
}  // namespace
}  // namespace slamot::test
