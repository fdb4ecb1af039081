#include "../results/TemporaryFolder.h"
#include "program.h"

#include <slamot/mrpt/RawlogWriter.h>
#include <slamot/results/TruthFiles.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace slamot
{
namespace
{
namespace fs = std::filesystem;
using test::Outcome;
using test::TemporaryFolder;

constexpr int kSteps = 20;
const std::string kRbpf = SLAMOT_SOURCE_DIR "/config-ini/rbpf-slamot.experiment1.ini";

/// A folder with a small log, its truth and configurations.
class Workplace : public TemporaryFolder
{
 public:
  Workplace()
  {
    write("dr.ini", "[dead-reckoning]\n");
    write("rbpf.ini", "[rbpf-slamot]\nparticles = 30\nproposal = informed\nassociation = known\n");
    writeLog("log.rawlog", kSteps);
    eval::Truth truth;
    for (int i = 0; i <= kSteps; ++i) truth.robot.poses.push_back({0.1 * i, {0.1 * i, 0, 0}});
    truth.landmarks = {{3, {2, 1}}};
    results::saveTruth(file("log.truth"), truth);
  }

  void writeLog(const std::string& name, int steps, bool lasers = false) const
  {
    core::Starts starts;
    starts.time = 0;
    starts.robot.emplace();
    starts.robot->value[core::ObjectStart::kX] = 0.0;
    mrpt::RawlogWriter writer(file(name), mrpt::RawlogWriter::Format::kActionFrames, starts);
    for (int i = 1; i <= steps; ++i)
    {
      core::Step s = step(i);
      if (lasers) s.lasers = {wallAround()};
      writer.write(s);
    }
    writer.close();
  }

  [[nodiscard]] Outcome slamot(const std::string& arguments) const
  {
    return test::slamot(arguments, file(""));
  }
  [[nodiscard]] nlohmann::json summary(const std::string& folder) const
  {
    return nlohmann::json::parse(read(folder + "/summary.json"));
  }
  [[nodiscard]] bool has(const std::string& name) const { return fs::exists(file(name)); }

 private:
  static std::shared_ptr<const core::LaserScan> wallAround()
  {
    auto scan = std::make_shared<core::LaserScan>();
    scan->angleMin = -1.5;
    scan->angleStep = 0.1;
    scan->rangeMax = 20;
    scan->ranges.assign(31, 4.0F);
    return scan;
  }

  // Along x at 1 m/s, a landmark at (2, 1) in sight at every second step.
  static core::Step step(int i)
  {
    core::Step out;
    out.time = 0.1 * i;
    out.odometry = math::turnThenMove(1.0, 0.0, 0.1, 0.1, 0.05);
    if (i % 2 != 0) return out;
    const double dx = 2 - 0.1 * i;
    out.landmarks.emplace();
    out.landmarks->fov.rangeMax = 10;
    out.landmarks->sightings = {{std::hypot(dx, 1), std::atan2(1, dx), 0.05, 0.01, 3}};
    return out;
  }
};

std::size_t lines(const std::string& text)
{
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

// All files of a folder as one text, but for what was measured.
std::string contents(const TemporaryFolder& folder, const std::string& name)
{
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder.file(name)))
    if (entry.is_regular_file()) names.push_back(fs::relative(entry, folder.file("")).string());
  std::sort(names.begin(), names.end());
  std::string out;
  for (const std::string& n : names)
  {
    std::string text = folder.read(n);
    if (fs::path(n).filename() == "summary.json")
    {
      auto json = nlohmann::ordered_json::parse(text);
      json.erase("timing");
      text = json.dump();
    }
    out += fs::path(n).filename().string() + "\n" + text;
  }
  return out;
}

void expectOneErrorLine(const Outcome& o, int status, const std::string& about)
{
  EXPECT_EQ(o.status, status) << o.text;
  EXPECT_EQ(o.text.rfind("slamot: error: ", 0), 0u) << o.text;
  EXPECT_EQ(lines(o.text), 1u) << o.text;
  EXPECT_NE(o.text.find(about), std::string::npos) << o.text;
}
}  // namespace

TEST(SlamotRun, MapsMrptsDemoOfKfSlam)
{
  const std::string log = "/usr/share/mrpt/datasets/kf-slam_demo.rawlog";
  if (!fs::exists(log)) GTEST_SKIP() << "mrpt-common is not installed";
  const Workplace place;
  const Outcome o = place.slamot(
      "run '" SLAMOT_SOURCE_DIR "/config-ini/rbpf-slamot.kf-slam-demo.ini' " + log + " -o demo");
  ASSERT_EQ(o.status, 0) << o.text;
  const auto summary = place.summary("demo");
  EXPECT_EQ(summary["landmarks"]["mapped"], 70);
  EXPECT_EQ(summary["association"]["correct"], 3607 - 70);
  EXPECT_EQ(summary["association"]["wrong"], 0);
  const std::string path = place.read("demo/robot.tum");
  EXPECT_EQ(lines(path), 250u);
  EXPECT_EQ(path.rfind("0.000000000 ", 0), 0u);
  EXPECT_NE(path.find("\n24.900000000 "), std::string::npos);
}

TEST(SlamotRun, WritesAWholeResultFolderWhereItSays)
{
  const Workplace place;
  const Outcome o = place.slamot("run dr.ini log.rawlog");
  ASSERT_EQ(o.status, 0) << o.text;
  EXPECT_NE(o.text.find("report: slamot-out/dead-reckoning-log/report.html"), std::string::npos)
      << o.text;
  const std::string out = "slamot-out/dead-reckoning-log";
  EXPECT_EQ(lines(place.read(out + "/robot.tum")), kSteps + 1u);
  EXPECT_EQ(lines(place.read(out + "/robot.csv")), kSteps + 2u);
  EXPECT_EQ(place.read(out + "/robot.tum").substr(0, 24), "0.000000000 0.000000000 ");
  for (const char* name : {"landmarks.csv", "config.ini", "report.html"})
    EXPECT_TRUE(place.has(out + "/" + name)) << name;
  const auto summary = place.summary(out);
  EXPECT_EQ(summary["complete"], true);
  EXPECT_EQ(summary["steps"], kSteps);
  EXPECT_EQ(summary["observations"], kSteps / 2);
  EXPECT_EQ(summary["method"], "dead-reckoning");
  EXPECT_NEAR(summary["robot"]["position_rmse_m"].get<double>(), 0.0, 1e-6);
}

TEST(SlamotRun, GivesTheSameBytesTwiceAndWithAnyNumberOfThreads)
{
  const Workplace place;
  for (const char* how : {"a --threads 1", "b --threads 1", "c --threads 2"})
    ASSERT_EQ(place.slamot("run " + kRbpf + " log.rawlog --seed 7 -q -o " + how).status, 0);
  const std::string first = contents(place, "a");
  EXPECT_NE(first.find("robot.csv"), std::string::npos);
  EXPECT_EQ(first, contents(place, "b"));
  EXPECT_EQ(first, contents(place, "c"));
}

TEST(SlamotRun, RepeatsARunFromTheConfigItWrote)
{
  const Workplace place;
  ASSERT_EQ(place
                .slamot("run " + kRbpf +
                        " log.rawlog --seed 9 --set rbpf-slamot.particles=20 "
                        "--align rigid -q -o a")
                .status,
            0);
  ASSERT_EQ(place.slamot("run a/config.ini log.rawlog -q -o b").status, 0);
  EXPECT_EQ(contents(place, "a"), contents(place, "b"));
}

TEST(SlamotRun, WritesMapsOfTheLaserScansItRead)
{
  const Workplace place;
  place.writeLog("laser.rawlog", 5, true);
  for (const char* out : {"a", "b"})
    ASSERT_EQ(place.slamot(std::string("run dr.ini laser.rawlog -q -o ") + out).status, 0);
  EXPECT_TRUE(place.has("a/map.simplemap"));
  EXPECT_TRUE(place.has("a/grid.png"));
  EXPECT_EQ(contents(place, "a"), contents(place, "b"));
}

TEST(SlamotRun, IsSilentWhenQuiet)
{
  const Workplace place;
  const Outcome o = place.slamot("run dr.ini log.rawlog -q");
  EXPECT_EQ(o.status, 0);
  EXPECT_EQ(o.text, "");
}

TEST(SlamotRun, SaysInOneLineWhatIsWrongAndLeavesNothing)
{
  const Workplace place;
  place.write("typo.ini", "[rbpf-slamot]\nparticels = 30\n");
  place.write("none.ini", "[run]\nmethod = no-such-filter\n");
  place.write("junk.rawlog", std::string(3000, 'x'));
  place.write("mine/thesis.tex", "years");
  expectOneErrorLine(place.slamot("run"), 1, "command line");
  expectOneErrorLine(place.slamot("run absent.ini log.rawlog"), 1, "absent.ini");
  expectOneErrorLine(place.slamot("run typo.ini log.rawlog"), 1, "typo.ini [rbpf-slamot]");
  expectOneErrorLine(place.slamot("run none.ini log.rawlog"), 1, "no-such-filter");
  expectOneErrorLine(place.slamot("run dr.ini log.rawlog --set dead-reckoning.x=1"), 1, "x");
  expectOneErrorLine(place.slamot("run dr.ini log.rawlog --seed -1"), 1, "seed");
  expectOneErrorLine(place.slamot("run dr.ini log.rawlog -p absent.so"), 1, "absent.so");
  expectOneErrorLine(place.slamot("run dr.ini log.rawlog -o mine"), 1, "mine");
  expectOneErrorLine(place.slamot("run dr.ini absent.rawlog"), 2, "absent.rawlog");
  expectOneErrorLine(place.slamot("run dr.ini junk.rawlog"), 2, "junk.rawlog");
  EXPECT_FALSE(place.has("slamot-out"));
  EXPECT_EQ(place.read("mine/thesis.tex"), "years");
}

TEST(SlamotRun, LeavesAnIncompleteResultWhenInterrupted)
{
  const Workplace place;
  // The program opens the pipe once it heeds Ctrl-C, so the signal can't come too early.
  place.write("interrupt.sh", "mkfifo pipe.ini\n'" SLAMOT_PROGRAM
                              "' run pipe.ini log.rawlog -o out &\n"
                              "cat dr.ini > pipe.ini\nkill -INT $!\nwait $!\necho status $?\n");
  FILE* shell = ::popen(("cd '" + place.file("") + "' && sh interrupt.sh 2>&1").c_str(), "r");
  ASSERT_NE(shell, nullptr);
  std::string text;
  for (int c = std::fgetc(shell); c != EOF; c = std::fgetc(shell)) text += static_cast<char>(c);
  ::pclose(shell);
  EXPECT_NE(text.find("status 130"), std::string::npos) << text;
  const auto summary = place.summary("out");
  EXPECT_EQ(summary["complete"], false);
  EXPECT_LT(summary["steps"].get<int>(), kSteps);
  EXPECT_EQ(lines(place.read("out/robot.tum")), summary["steps"].get<std::size_t>() + 1);
}

TEST(SlamotRun, UsesTheIntactPartOfATruncatedLogOnlyWhenToldTo)
{
  const Workplace place;
  place.writeLog("long.rawlog", 2000);
  const std::string whole = place.read("long.rawlog");
  place.write("cut.rawlog", whole.substr(0, whole.size() / 2));
  expectOneErrorLine(place.slamot("run dr.ini cut.rawlog -o out"), 3, "cut.rawlog");
  EXPECT_FALSE(place.has("out"));
  expectOneErrorLine(place.slamot("run dr.ini cut.rawlog -o out --salvage -q"), 3, "were used");
  const auto summary = place.summary("out");
  EXPECT_EQ(summary["complete"], false);
  EXPECT_GT(summary["steps"].get<int>(), 100);
  EXPECT_LT(summary["steps"].get<int>(), 2000);
}

TEST(SlamotEvaluate, GivesTheNumbersOfTheSummary)
{
  const Workplace place;
  ASSERT_EQ(place.slamot("run " + kRbpf + " log.rawlog -q -o out").status, 0);
  const Outcome o = place.slamot("evaluate out --json");
  ASSERT_EQ(o.status, 0) << o.text;
  const auto evaluation = nlohmann::json::parse(o.text);
  const auto summary = place.summary("out");
  for (const auto& [key, value] : summary["robot"].items())
    EXPECT_EQ(evaluation["robot"]["all"][key], value) << key;
  for (const auto& [key, value] : summary["landmarks"].items())
    EXPECT_EQ(evaluation["landmarks"][key], value) << key;
  EXPECT_EQ(evaluation["association"], summary["association"]);
  EXPECT_EQ(evaluation["particles"], summary["particles"]);
  EXPECT_EQ(summary["landmarks"]["true"], 1);
}

TEST(SlamotEvaluate, TakesATrajectoryOfAnotherProgram)
{
  const Workplace place;
  place.write("other.tum", "0 0 0.5 0 0 0 0 1\n1 1 0.5 0 0 0 0 1\n2 2 0.5 0 0 0 0 1\n");
  const Outcome o = place.slamot("evaluate other.tum --truth log.rawlog --align none --json");
  ASSERT_EQ(o.status, 0) << o.text;
  const auto evaluation = nlohmann::json::parse(o.text);
  EXPECT_NEAR(evaluation["robot"]["all"]["position_mean_error_m"].get<double>(), 0.5, 1e-9);
  EXPECT_TRUE(evaluation["robot"]["all"]["nees_mean"].is_null());
  const Outcome aligned = place.slamot("evaluate other.tum --truth log.truth --json");
  EXPECT_NEAR(nlohmann::json::parse(aligned.text)["robot"]["all"]["position_rmse_m"].get<double>(),
              0, 1e-9);
}

TEST(SlamotEvaluate, TakesErrorsAtTheLeverArmOfTheRunOrOfTheCommand)
{
  const Workplace place;
  place.write("other.tum", "0 0 0.5 0 0 0 0 1\n1 1 0.5 0 0 0 0 1\n2 2 0.5 0 0 0 0 1\n");
  const auto meanError = [](const Outcome& o)
  {
    EXPECT_EQ(o.status, 0) << o.text;
    return nlohmann::json::parse(o.text)["robot"]["all"]["position_mean_error_m"].get<double>();
  };
  const std::string evaluate = "evaluate other.tum --truth log.rawlog --align none --json ";
  EXPECT_NEAR(meanError(place.slamot(evaluate + "--lever-arm -3,-0.5")), 3, 1e-9);
  EXPECT_NEAR(meanError(place.slamot(evaluate + "--lever-arm=0,-0.5")), 0, 1e-9);
  expectOneErrorLine(place.slamot(evaluate + "--lever-arm 1"), 1, "--lever-arm");
  expectOneErrorLine(place.slamot(evaluate + "--lever-arm 1,x"), 1, "--lever-arm");

  const std::string run = "run dr.ini log.rawlog -q -o out --set run.lever_arm_m=";
  ASSERT_EQ(place.slamot(run + "1,0").status, 0);
  EXPECT_NEAR(place.summary("out")["robot"]["position_rmse_m"].get<double>(), 1, 1e-6);
  EXPECT_NEAR(meanError(place.slamot("evaluate out --json")), 1, 1e-6);
  EXPECT_NEAR(meanError(place.slamot("evaluate out --json --lever-arm 0,0")), 0, 1e-6);
  expectOneErrorLine(place.slamot(run + "1"), 1, "lever_arm_m");
}

TEST(SlamotEvaluate, SaysWhatIsMissing)
{
  const Workplace place;
  place.write("other.tum", "0 0 0.5 0 0 0 0 1\n");
  expectOneErrorLine(place.slamot("evaluate absent"), 2, "absent");
  expectOneErrorLine(place.slamot("evaluate other.tum"), 1, "--truth");
  expectOneErrorLine(place.slamot("evaluate other.tum --truth absent"), 2, "absent");
  expectOneErrorLine(place.slamot("evaluate log.truth/.. --truth log.rawlog"), 2, "robot.csv");
}
}  // namespace slamot
