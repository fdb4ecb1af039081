// How sharp a map any path makes of a log's scans: slamot evaluate --scans.
#include "../results/TemporaryFolder.h"
#include "program.h"

#include <nlohmann/json.hpp>

namespace slamot
{
namespace
{
using nlohmann::json;
using test::Outcome;
using test::TemporaryFolder;

const std::string kConfigs = SLAMOT_SOURCE_DIR "/config-ini/";

/// A drive between walls and posts, with a laser alone: log, truth, and dead reckoning in out/.
class EvaluateScans : public ::testing::Test
{
 protected:
  EvaluateScans()
  {
    succeed("simulate '" + kConfigs +
            "sim.pioneers.ini' -o log.rawlog -q --set world.steps=120 "
            "--set camera.image_every=1000000");
    succeed("run '" + kConfigs + "dead-reckoning.ini' log.rawlog -q -o out");
  }

  std::string succeed(const std::string& arguments)
  {
    const Outcome o = test::slamot(arguments, folder_.file(""));
    EXPECT_EQ(o.status, 0) << o.text;
    return o.text;
  }
  json evaluation(const std::string& arguments)
  {
    return json::parse(succeed("evaluate " + arguments + " --json"));
  }
  void expectError(const std::string& arguments, int status, const std::string& text)
  {
    const Outcome o = test::slamot("evaluate " + arguments, folder_.file(""));
    EXPECT_EQ(o.status, status) << o.text;
    EXPECT_EQ(o.text, "slamot: error: " + text + "\n");
  }

  const TemporaryFolder folder_;
};

TEST_F(EvaluateScans, OfAResultFolderAreThoseOfItsRun)
{
  const json run = json::parse(folder_.read("out/summary.json"))["scan_map"];
  ASSERT_GT(run["points"], 1000);
  EXPECT_EQ(evaluation("out")["scan_map"]["points"], run["points"]);  // the folder keeps them
  const json again = evaluation("out --scans log.rawlog")["scan_map"];
  EXPECT_EQ(again["points"], run["points"]);
  EXPECT_NEAR(again["mean_map_entropy"].get<double>(), run["mean_map_entropy"].get<double>(), 1e-3);
  EXPECT_NEAR(again["odometry_mean_map_entropy"].get<double>(),
              run["odometry_mean_map_entropy"].get<double>(), 1e-3);
}

// A foreign program's path, here the truth: sharper than odometry by far, and needing no truth.
TEST_F(EvaluateScans, OfAPathAreDrawnFromIt)
{
  const json known = evaluation("log.truth/robot.tum --scans log.rawlog");
  EXPECT_LT(known["scan_map"]["mean_map_entropy"].get<double>(),
            known["scan_map"]["odometry_mean_map_entropy"].get<double>() - 0.5);
  EXPECT_EQ(known["robot"]["all"]["position_rmse_m"], 0);  // the truth that goes with the log
  ASSERT_EQ(
      std::rename(folder_.file("log.truth/robot.tum").c_str(), folder_.file("path.tum").c_str()),
      0);
  std::filesystem::remove_all(folder_.file("log.truth"));
  EXPECT_EQ(evaluation("path.tum --scans log.rawlog")["scan_map"], known["scan_map"]);
  const std::string text = succeed("evaluate path.tum --scans log.rawlog");
  EXPECT_NE(text.find("\nscan map                  mean entropy -"), std::string::npos) << text;
}

TEST_F(EvaluateScans, WithoutAPoseAreLeftOut)
{
  folder_.write("two.tum", "2.0 3 6 0 0 0 0 1\n3.5 4 6 0 0 0 0 1\n");
  const std::string text = succeed("evaluate two.tum --scans log.rawlog");
  EXPECT_NE(text.find("slamot: warning: log.rawlog: 52 laser scans left out, where the path has no "
                      "pose\n"),
            std::string::npos)
      << text;
  folder_.write("other.tum", "2000 3 6 0 0 0 0 1\n2001 4 6 0 0 0 0 1\n");
  expectError(
      "other.tum --scans log.rawlog", 4,
      "log.rawlog: at no scan's time the path has a pose; give the log that the path is of");
}

TEST_F(EvaluateScans, WhatIsWrongIsOneLine)
{
  expectError("out --scans absent.rawlog", 2,
              "absent.rawlog: No such file or directory; give the path of a rawlog");
  expectError("out --scans '" SLAMOT_SOURCE_DIR "/share/datasets/experiment1.rawlog'", 4,
              SLAMOT_SOURCE_DIR
              "/share/datasets/experiment1.rawlog: has no laser scan; give the log that the path "
              "is of");
}
}  // namespace
}  // namespace slamot
