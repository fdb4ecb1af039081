#include "../results/TemporaryFolder.h"
#include "program.h"

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

constexpr int kSteps = 40;
const std::string kConfigs = "'" SLAMOT_SOURCE_DIR "'/config-ini/";
const std::string kBoth = " t.robot0.rawlog t.robot1.rawlog -q -o ";

/// A folder with the logs of two robots, and team.ini.
class Workplace : public TemporaryFolder
{
 public:
  explicit Workplace(int steps = kSteps)
  {
    fs::copy_file(SLAMOT_SOURCE_DIR "/config-ini/team-ci.ini", file("team.ini"));
    simulated_ =
        slamot("simulate " + kConfigs +
               "sim.team-300m.ini -o t.rawlog -q --set world.steps=" + std::to_string(steps));
  }

  [[nodiscard]] Outcome slamot(const std::string& arguments) const
  {
    return test::slamot(arguments, file(""));
  }
  /// Whether the command ended well.
  [[nodiscard]] bool does(const std::string& arguments) const
  {
    const Outcome o = slamot(arguments);
    EXPECT_EQ(o.status, 0) << arguments << "\n" << o.text;
    return o.status == 0;
  }
  [[nodiscard]] bool has(const std::string& name) const { return fs::exists(file(name)); }
  [[nodiscard]] nlohmann::json json(const std::string& name) const
  {
    return nlohmann::json::parse(read(name));
  }
  [[nodiscard]] bool isReady() const { return simulated_.status == 0; }

 private:
  Outcome simulated_;
};

/// What a robot came to believe, in full precision.
std::string beliefs(const Workplace& place, const std::string& folder)
{
  std::string out;
  for (const char* name : {"/robot.csv", "/target_0.csv", "/landmarks.csv"})
    out += place.read(folder + name);
  return out;
}

void expectOneErrorLine(const Outcome& o, int status, const std::string& about)
{
  EXPECT_EQ(o.status, status) << o.text;
  EXPECT_EQ(o.text.rfind("slamot: error: ", 0), 0u) << o.text;
  EXPECT_EQ(std::count(o.text.begin(), o.text.end(), '\n'), 1) << o.text;
  EXPECT_NE(o.text.find(about), std::string::npos) << o.text;
}
}  // namespace

TEST(SlamotTeam, WritesAFolderForEachRobotAndPagesForAll)
{
  const Workplace place;
  ASSERT_TRUE(place.isReady());
  ASSERT_TRUE(place.does("team team.ini" + kBoth + "out"));
  for (const char* name :
       {"team.json", "config.ini", "report.html", "scene.3Dscene", "t.robot0/summary.json",
        "t.robot0/robot.csv", "t.robot0/target_0.csv", "t.robot0/fusions.csv",
        "t.robot0/report.html", "t.robot1/robot.csv", "t.robot1/config.ini"})
    EXPECT_TRUE(place.has(std::string("out/") + name)) << name;
  const auto team = place.json("out/team.json");
  EXPECT_EQ(team["rule"], "ci");
  EXPECT_EQ(team["seed"], 1);
  EXPECT_EQ(team["complete"], true);
  ASSERT_EQ(team["robots"].size(), 2u);
  for (const auto& robot : team["robots"])
  {
    const auto summary = place.json("out/" + robot["name"].get<std::string>() + "/summary.json");
    for (const char* key : {"position_mean_error_m", "position_rmse_m", "nees_mean"})
    {
      EXPECT_EQ(robot["robot"][key], summary["robot"][key]) << key;
      EXPECT_EQ(robot["target"][key], summary["targets"][0][key]) << key;
    }
    EXPECT_EQ(robot["steps"], kSteps);
    EXPECT_EQ(robot["messages"]["sent"], kSteps);
    EXPECT_EQ(robot["messages"]["received"], kSteps);
    EXPECT_GT(robot["messages"]["fused"], 0);
    EXPECT_EQ(robot["messages"]["wrong_candidates_fused"], 0);
  }
}

TEST(SlamotTeam, ItsPageAndSceneShowTheTeam)
{
  const Workplace place;
  ASSERT_TRUE(place.isReady());
  ASSERT_TRUE(place.does("team team.ini" + kBoth + "out"));
  const std::string page = place.read("out/report.html");
  for (const char* text : {"<h1>team of 2, rule ci</h1>", "href=\"t.robot0/report.html\"",
                           "Errors of the robots.", "Errors of the target",
                           "received: the sum of outcomes", "wrong candidate fused", "rule = ci"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(page.find("http"), std::string::npos) << "nothing is fetched";
  const Outcome o = place.slamot("render out -o a.png --width 320 --height 240");
  if (o.text.find("OpenGL") != std::string::npos) GTEST_SKIP() << o.text;
  EXPECT_EQ(o.status, 0) << o.text;
  EXPECT_EQ(place.read("a.png").substr(1, 3), "PNG");
}

TEST(SlamotTeam, ItsPageStandsWithoutTruthAndWithoutMessages)
{
  const Workplace place(10);
  ASSERT_TRUE(place.isReady());
  for (const char* truth : {"t.robot0.truth", "t.robot1.truth"}) fs::remove_all(place.file(truth));
  ASSERT_TRUE(place.does("team team.ini --set team.rule=centralized" + kBoth + "out"));
  const std::string page = place.read("out/report.html");
  EXPECT_NE(page.find("No ground truth"), std::string::npos);
  EXPECT_NE(page.find("there are no messages"), std::string::npos);
  EXPECT_EQ(page.find("Errors of the robots"), std::string::npos);
  EXPECT_EQ(page.find("This plot is missing"), std::string::npos);
}

TEST(SlamotTeam, RepeatsARunFromTheConfigItWroteInPlaceOfAnOlderOne)
{
  const Workplace place;
  ASSERT_TRUE(place.isReady());
  ASSERT_TRUE(place.does("team team.ini --seed 5 --set team.message_loss=0.5" + kBoth + "a"));
  ASSERT_TRUE(place.does("team a/config.ini" + kBoth + "b"));
  ASSERT_TRUE(place.does("team a/config.ini" + kBoth + "b")) << "over the result that is there";
  EXPECT_EQ(place.read("a/config.ini"), place.read("b/config.ini"));
  for (const char* robot : {"/t.robot0", "/t.robot1"})
  {
    EXPECT_EQ(beliefs(place, std::string("a") + robot), beliefs(place, std::string("b") + robot));
    EXPECT_EQ(place.read(std::string("a") + robot + "/fusions.csv"),
              place.read(std::string("b") + robot + "/fusions.csv"));
  }
}

TEST(SlamotTeam, TheOrderOfTheLogsChangesNoRobotsResult)
{
  const Workplace place;
  ASSERT_TRUE(place.isReady());
  ASSERT_TRUE(place.does("team team.ini --set team.message_loss=0.3" + kBoth + "a"));
  ASSERT_TRUE(place.does(
      "team team.ini --set team.message_loss=0.3 t.robot1.rawlog t.robot0.rawlog -q -o b"));
  for (const char* robot : {"/t.robot0", "/t.robot1"})
    EXPECT_EQ(beliefs(place, std::string("a") + robot), beliefs(place, std::string("b") + robot));
}

TEST(SlamotTeam, ARobotThatHearsNothingIsToTheBitARobotAlone)
{
  const Workplace place;
  ASSERT_TRUE(place.isReady());
  ASSERT_TRUE(place.does("run team.ini t.robot1.rawlog -q -o alone"));
  ASSERT_TRUE(place.does("team team.ini t.robot1.rawlog -q -o one"));
  ASSERT_TRUE(place.does("team team.ini --set team.message_loss=1" + kBoth + "lost"));
  ASSERT_TRUE(place.does("team team.ini --set team.rule=none" + kBoth + "none"));
  ASSERT_TRUE(place.does("team team.ini" + kBoth + "ci"));
  const std::string alone = beliefs(place, "alone");
  EXPECT_EQ(alone, beliefs(place, "one/t.robot1"));
  EXPECT_EQ(alone, beliefs(place, "lost/t.robot1"));
  EXPECT_EQ(alone, beliefs(place, "none/t.robot1"));
  EXPECT_NE(alone, beliefs(place, "ci/t.robot1"));
  const auto lost = place.json("lost/team.json")["robots"][1]["messages"];
  EXPECT_EQ(lost["sent"], kSteps);
  EXPECT_EQ(lost["received"], 0);
  const auto none = place.json("none/team.json")["robots"][1]["messages"];
  EXPECT_EQ(none["by_outcome"]["fusion_off"], none["received"]);
}

TEST(SlamotTeam, OneEkfOverAllExchangesNothing)
{
  const Workplace place;
  ASSERT_TRUE(place.isReady());
  ASSERT_TRUE(place.does("team team.ini --set team.rule=centralized" + kBoth + "out"));
  const auto team = place.json("out/team.json");
  EXPECT_EQ(team["robots"][0]["steps"], kSteps);
  EXPECT_TRUE(team["robots"][0]["messages"].is_null());
  EXPECT_FALSE(team["robots"][0]["target"].is_null());
}

TEST(SlamotTeam, SaysInOneLineWhatIsWrongAndLeavesNothing)
{
  const Workplace place(5);
  ASSERT_TRUE(place.isReady());
  const auto wrong = [&](const std::string& how, int status, const std::string& about)
  { expectOneErrorLine(place.slamot("team " + how), status, about); };
  const std::string both = "t.robot0.rawlog t.robot1.rawlog";
  place.write("same/t.robot0.rawlog", place.read("t.robot0.rawlog"));
  wrong("team.ini", 1, "datasets");
  wrong("team.ini t.robot0.rawlog t.robot0.rawlog", 1, "two logs of this name");
  wrong("team.ini t.robot0.rawlog same/t.robot0.rawlog", 1, "two logs of this name");
  wrong("team.ini --set team.rule=best " + both, 1, "rule");
  wrong("team.ini --set team.message_loss=2 " + both, 1, "message_loss");
  wrong("team.ini --set team.messageloss=1 " + both, 1, "message_loss");
  wrong("team.ini --set team.methods=ekf-slamot,ekf-slamot,ekf-slamot " + both, 1, "methods");
  wrong("team.ini --set team.methods=dead-reckoning " + both, 1, "dead-reckoning");
  wrong("absent.ini " + both, 1, "absent.ini");
  wrong("team.ini t.robot0.rawlog t.robot7.rawlog", 2, "t.robot7.rawlog");
  place.write("junk.robot1.rawlog", std::string(3000, 'x'));
  wrong("team.ini t.robot0.rawlog junk.robot1.rawlog", 2, "junk.robot1.rawlog");
  place.write("mine/thesis.tex", "years");
  wrong("team.ini -o mine " + both, 1, "mine");
  EXPECT_FALSE(place.has("slamot-out"));
}

TEST(SlamotTeam, UsesTheIntactPartOfATruncatedLogOnlyWhenToldTo)
{
  const Workplace place;
  ASSERT_TRUE(place.isReady());
  const std::string whole = place.read("t.robot1.rawlog");
  place.write("cut.robot1.rawlog", whole.substr(0, whole.size() / 2));
  const std::string command = "team team.ini t.robot0.rawlog cut.robot1.rawlog -q -o out";
  expectOneErrorLine(place.slamot(command), 3, "cut.robot1.rawlog");
  EXPECT_FALSE(place.has("out"));
  expectOneErrorLine(place.slamot(command + " --salvage"), 3, "were used");
  EXPECT_EQ(place.json("out/team.json")["complete"], false);
  EXPECT_EQ(place.json("out/t.robot0/summary.json")["complete"], true);
  const auto cut = place.json("out/cut.robot1/summary.json");
  EXPECT_EQ(cut["complete"], false);
  EXPECT_GT(cut["steps"], kSteps / 4);
  EXPECT_LT(cut["steps"], kSteps);
}

TEST(SlamotTeam, LeavesAnIncompleteResultWhenInterrupted)
{
  const Workplace place;
  ASSERT_TRUE(place.isReady());
  // The program opens the pipe once it heeds Ctrl-C, so the signal can't come too early.
  place.write("interrupt.sh", "mkfifo pipe.ini\n'" SLAMOT_PROGRAM "' team pipe.ini" + kBoth +
                                  "out &\ncat team.ini > pipe.ini\nkill -INT $!\nwait $!\n");
  const int status = std::system(("cd '" + place.file("") + "' && sh interrupt.sh").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_EQ(place.json("out/team.json")["complete"], false);
  EXPECT_LT(place.json("out/t.robot1/summary.json")["steps"], kSteps);
}

TEST(SlamotEvaluate, TakesATeamsFolderWithOneAlignmentForAll)
{
  const Workplace place;
  ASSERT_TRUE(place.isReady());
  ASSERT_TRUE(place.does("team team.ini --align rigid" + kBoth + "out"));
  const Outcome o = place.slamot("evaluate out --json");
  ASSERT_EQ(o.status, 0) << o.text;
  const auto all = nlohmann::json::parse(o.text);
  const auto team = place.json("out/team.json");
  ASSERT_EQ(all.size(), 2u);
  for (const auto& robot : team["robots"])
    EXPECT_EQ(all[robot["name"].get<std::string>()]["robot"]["all"]["position_rmse_m"],
              robot["robot"]["position_rmse_m"]);
  EXPECT_EQ(all["t.robot0"]["align"], "rigid");
  EXPECT_EQ(all["t.robot0"]["truth_from_map"], all["t.robot1"]["truth_from_map"]);
  expectOneErrorLine(place.slamot("evaluate out --truth t.robot0.truth"), 1, "--truth");
  expectOneErrorLine(place.slamot("evaluate out --scans t.robot0.rawlog"), 1, "--scans");
}

TEST(SlamotRun, ALoneRobotOfAMixedTeamNeedsToBeToldItsFilter)
{
  const Workplace place(5);
  ASSERT_TRUE(place.isReady());
  const std::string mixed =
      "run team.ini t.robot0.rawlog -q -o out --set team.methods=ekf-slamot,rbpf-slamot";
  expectOneErrorLine(place.slamot(mixed), 1, "run.method");
  EXPECT_TRUE(place.does(mixed + " --set run.method=ekf-slamot"));
}
}  // namespace slamot
