#include "LiveTeam.h"

#include <algorithm>
#include <filesystem>

// Robots of a team as processes of their own, over DDS.
namespace slamot
{
namespace
{
namespace fs = std::filesystem;
using test::LiveTeam;
using test::Process;
using Words = LiveTeam::Words;

Words operator+(Words a, const Words& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const Words kTwo = {"--team", "0,1"};

// All that a robot's estimate goes to, of its folder in a team's result and of its own.
void expectSameResult(const LiveTeam& team, int robot)
{
  const std::string number = std::to_string(robot);
  int files = 0;
  for (const auto& entry : fs::directory_iterator(team.folder.file("all/t.robot" + number)))
  {
    const std::string name = entry.path().filename().string();
    // Settings and timing are of the run; the report and the scene tell them too.
    if (name.find(".csv") == std::string::npos && name.find(".tum") == std::string::npos) continue;
    ++files;
    const std::string bytes = team.folder.read("all/t.robot" + number + "/" + name);
    EXPECT_FALSE(bytes.empty()) << name;
    EXPECT_TRUE(bytes == team.folder.read("r" + number + "/" + name)) << name << " of " << number;
  }
  EXPECT_GE(files, 8);
}

void expectLockstepEqualsTeam(const LiveTeam& team, int robots, const Words& settings)
{
  std::string numbers, command = "team '" + team.config + "'";
  for (int r = 0; r < robots; ++r)
  {
    numbers += (r > 0 ? "," : "") + std::to_string(r);
    command += " '" + team.log(r) + "'";
  }
  for (const std::string& word : settings) command += " " + word;
  const auto all = test::slamot(command + " -q -o all", team.folder.file(""));
  ASSERT_EQ(all.status, 0) << all.text;
  std::vector<std::unique_ptr<Process>> processes;
  for (int r = 0; r < robots; ++r)
    processes.push_back(team.start(r, settings + Words{"--lockstep", "--team", numbers}));
  for (int r = 0; r < robots; ++r)
  {
    EXPECT_EQ(processes[static_cast<std::size_t>(r)]->status(), 0)
        << processes[static_cast<std::size_t>(r)]->text();
    expectSameResult(team, r);
    EXPECT_GT(team.outcome(r, "fused"), 0) << r;
  }
}

int rowsAfter(const std::string& csv, double time)
{
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  int out = 0;
  while (std::getline(in, line)) out += std::stod(line) > time;
  return out;
}
}  // namespace

TEST(SlamotRobot, InLockstepTwoEqualTheirTeamToTheByte)
{
  expectLockstepEqualsTeam(LiveTeam(40), 2, {});
}

TEST(SlamotRobot, InLockstepOneWithParticlesEqualsItsTeamToTheByte)
{
  LiveTeam team(25);
  team.config = LiveTeam::source("config-ini/team-mixed.ini");
  expectLockstepEqualsTeam(team, 2, {"--seed", "4"});
}

TEST(SlamotRobot, InLockstepAPoorRadioIsTheSameToo)
{
  expectLockstepEqualsTeam(
      LiveTeam(40), 2,
      {"--set", "team.message_loss=0.3", "--set", "team.message_delay_s=0.3", "--set",
       "team.message_delay_spread_s=0.3", "--set", "team.message_duplication=0.2", "--seed", "3"});
}

TEST(SlamotRobot, InLockstepThreeEqualTheirTeamToTheByte)
{
  const test::TemporaryFolder folder;
  std::ifstream two(LiveTeam::source("config-ini/sim.team-300m.ini"));
  std::ostringstream text;
  text << two.rdbuf()
       << "\n[robot_2]\nmotion = straight\nspeed_mps = 2\nstart = given\nstart_x_m = 25\n"
          "start_y_m = 155\nstart_theta_deg = 0\nv_std_mps = 0.1\nomega_std_radps = 0.02\n"
          "start_known = true\nstart_std_x_m = 0.05\nstart_std_y_m = 0.05\n"
          "start_std_theta_rad = 0.00873\n";
  expectLockstepEqualsTeam(LiveTeam(40, folder.write("sim.ini", text.str())), 3,
                           {"--set", "team.exchange_every=2"});
}

TEST(SlamotRobot, InLockstepADeadPeerEndsTheRunWithOneLineAndWhatThereIs)
{
  const LiveTeam team(100);
  const Words lockstep = kTwo + Words{"--lockstep", "--set", "dds.lockstep_silence_s=5"};
  // What the other says goes to a pipe that nobody reads: it stops when that is full, mid-run.
  const std::string pipe = team.folder.file("r1.log");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int end = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(end, 0);
  ASSERT_GT(::fcntl(end, F_SETPIPE_SZ, 4096), 0);
  const auto living = team.start(0, lockstep + Words{"-v"});
  const auto dying = team.start(1, lockstep + Words{"-v"});
  ASSERT_TRUE(living->says("message of robot 1")) << living->text();
  dying->signal(SIGKILL);
  EXPECT_EQ(living->status(), 5) << living->text();
  const std::string text = living->text();
  const std::string line = "slamot: error: lockstep: robot 1 fell silent, step ";
  EXPECT_NE(text.find(line), std::string::npos) << text;
  EXPECT_EQ(team.json(0, "summary.json")["complete"], false);
  EXPECT_GT(team.json(0, "summary.json")["steps"], 0);
  ::close(end);
}

TEST(SlamotRobot, InLockstepCtrlCEndsBothAtAStepsBoundary)
{
  const LiveTeam team(100);
  const std::string pipe = team.folder.file("r1.log");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int end = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GT(::fcntl(end, F_SETPIPE_SZ, 4096), 0);
  const auto first = team.start(0, kTwo + Words{"--lockstep", "-v"});
  const auto second = team.start(1, kTwo + Words{"--lockstep", "-v"});
  ASSERT_TRUE(first->says("message of robot 1")) << first->text();
  first->signal(SIGINT);
  EXPECT_EQ(first->status(), 130) << first->text();
  EXPECT_EQ(team.json(0, "summary.json")["complete"], false);
  // The other finds out once it goes on.
  std::array<char, 4096> said{};
  std::string text;
  ASSERT_TRUE(test::comes(
      [&]
      {
        while (const auto n = ::read(end, said.data(), said.size()))
        {
          if (n < 0) break;
          text.append(said.data(), static_cast<std::size_t>(n));
        }
        return second->hasEnded();
      }))
      << text;
  EXPECT_EQ(second->status(), 5) << text;
  EXPECT_NE(text.find("robot 0 ended before its log did"), std::string::npos) << text;
  ::close(end);
}

TEST(SlamotRobot, InRealTimeTwoExchangeAndFinish)
{
  const LiveTeam team(100);
  const Words live = kTwo + Words{"--speed", "10", "--wait", "100"};
  const auto first = team.start(0, live), second = team.start(1, live);
  EXPECT_EQ(first->status(), 0) << first->text();
  EXPECT_EQ(second->status(), 0) << second->text();
  for (const int robot : {0, 1})
  {
    EXPECT_GT(team.outcome(robot, "fused"), 0);
    EXPECT_EQ(team.json(robot, "summary.json")["complete"], true);
    EXPECT_EQ(team.json(robot, "summary.json")["steps"], 100);
    EXPECT_LT(team.json(robot, "summary.json")["robot"]["position_mean_error_m"], 1);
  }
}

TEST(SlamotRobot, AKilledPeerIsHeardAgainAndTheOtherGoesOn)
{
  const LiveTeam team(500);
  const auto survivor = team.start(0, kTwo + Words{"-v"});
  std::size_t said = 0;
  {
    const auto killed = team.start(1, kTwo, "before.log");
    ASSERT_TRUE(survivor->says("message of robot 1", said)) << survivor->text();
    killed->signal(SIGKILL);
    EXPECT_EQ(killed->status(), 128 + SIGKILL);
  }
  ASSERT_TRUE(survivor->says("robot 1 is silent", said)) << survivor->text();
  const auto again = team.start(1, kTwo + Words{"-v"});
  ASSERT_TRUE(survivor->says("robot 1 was started again, ", said)) << survivor->text();
  const double restart = std::stod(survivor->text().substr(said));
  ASSERT_TRUE(survivor->says("message of robot 1", said)) << survivor->text();
  ASSERT_TRUE(again->says("put forward by")) << again->text();
  ASSERT_TRUE(again->says("message of robot 0")) << again->text();
  survivor->signal(SIGINT);
  again->signal(SIGINT);
  EXPECT_EQ(survivor->status(), 130);
  EXPECT_EQ(again->status(), 130);
  EXPECT_EQ(team.json(0, "messages.json")["starts_heard"]["1"], 2);
  // A row bears the time of its step, up to a step earlier; before that was silence.
  EXPECT_GT(rowsAfter(team.folder.read("r0/fusions.csv"), restart - 1), 0);
  EXPECT_EQ(team.json(0, "summary.json")["complete"], false);
  for (const int robot : {0, 1})
    EXPECT_LT(team.json(robot, "summary.json")["robot"]["position_mean_error_m"], 1);
}

TEST(SlamotRobot, WhoComesLateIsPutForwardToTheTeam)
{
  const LiveTeam team(500);
  const auto early = team.start(0, kTwo + Words{"-v", "--start-at", "1"});  // at its log's end
  EXPECT_EQ(early->status(), 0) << early->text();
  EXPECT_EQ(team.outcome(0, "fused"), 0);
  const double wall = static_cast<double>(::time(nullptr)) - 20;
  const auto first = team.start(0, kTwo + Words{"-v", "--start-at", std::to_string(wall)});
  const auto late = team.start(1, kTwo + Words{"-v"});
  ASSERT_TRUE(late->says("put forward by")) << late->text();
  ASSERT_TRUE(late->says("message of robot 0")) << late->text();
  ASSERT_TRUE(first->says("message of robot 1")) << first->text();
  late->signal(SIGINT);
  first->signal(SIGINT);
  EXPECT_EQ(late->status(), 130);
  EXPECT_EQ(first->status(), 130);
  EXPECT_GE(team.json(1, "summary.json")["steps"], 20 / 0.2);  // all that it missed, too
}

TEST(SlamotRobot, LosingAFifthOfAllPacketsDoesNotStopTheTeam)
{
  const LiveTeam team(500);
  const Words live = kTwo + Words{"-v", "--set", "dds.packet_loss=0.2"};
  const auto first = team.start(0, live), second = team.start(1, live);
  std::size_t saidFirst = 0, saidSecond = 0;
  for (int i = 0; i < 10; ++i)
  {
    ASSERT_TRUE(first->says("message of robot 1", saidFirst)) << first->text();
    ASSERT_TRUE(second->says("message of robot 0", saidSecond)) << second->text();
  }
  first->signal(SIGINT);
  second->signal(SIGINT);
  EXPECT_EQ(first->status(), 130) << first->text();
  EXPECT_EQ(second->status(), 130) << second->text();
  for (const int robot : {0, 1})
    EXPECT_LT(team.json(robot, "summary.json")["robot"]["position_mean_error_m"], 1);
}

TEST(SlamotRobot, SettingsAreCheckedBeforeAnythingIsSent)
{
  const LiveTeam team(5);
  const auto refused = [&](const Words& words, const std::string& line)
  {
    const auto robot = team.start(0, words);
    EXPECT_EQ(robot->status(), 1);
    EXPECT_NE(robot->text().find(line), std::string::npos) << robot->text();
    EXPECT_FALSE(fs::exists(team.folder.file("r0")));
  };
  refused({"--team", "1,2"}, "[dds] team: has no robot 0");
  refused({"--team", "0,0"}, "[dds] team: names a robot twice");
  refused({"--set", "dds.domian=3"}, "unknown key; did you mean domain?");
  refused({"--set", "dds.domain=231"}, "[dds] domain");
  refused({"--set", "dds.interface=nosuch0"}, "nosuch0");
  refused({"--set", "dds.security=."}, "make-keys");
  refused({"--set", "team.rule=centralized"}, "use slamot team for that");
  refused({"--lockstep", "--speed", "2"}, "--lockstep excludes --speed");
}
}  // namespace slamot
