#include "LiveTeam.h"

#include <filesystem>

// What needs more of the machine than a loopback: DDS Security's plugins, network namespaces.
namespace slamot
{
namespace
{
namespace fs = std::filesystem;
using test::LiveTeam;
using Words = LiveTeam::Words;

bool isInstalled(const std::string& library)
{
  std::error_code ignored;
  for (const char* place : {"/usr/lib", "/usr/local/lib"})
    for (fs::recursive_directory_iterator it(place, ignored), end; it != end; it.increment(ignored))
      if (it->path().filename() == library) return true;
  return false;
}

bool succeeds(const std::string& command)
{
  return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
}

/// A network of its own, with a loopback that loses packets.
class LossyNamespace
{
 public:
  LossyNamespace()
  {
    isThere_ = succeeds("ip netns add " + name_) && succeeds(in("ip link set lo up"));
    isLossy_ = isThere_ && (succeeds(in("tc qdisc add dev lo root netem loss 20%")) ||
                            succeeds(in("iptables -A INPUT -p udp -m statistic --mode random "
                                        "--probability 0.2 -j DROP")));
  }
  ~LossyNamespace()
  {
    if (isThere_) succeeds("ip netns del " + name_);
  }
  LossyNamespace(const LossyNamespace&) = delete;
  LossyNamespace& operator=(const LossyNamespace&) = delete;
  [[nodiscard]] bool isLossy() const { return isLossy_; }
  [[nodiscard]] Words prefix() const { return {"ip", "netns", "exec", name_}; }

 private:
  [[nodiscard]] std::string in(const std::string& command) const
  {
    return "ip netns exec " + name_ + " " + command;
  }
  std::string name_ = "slamot-test-" + std::to_string(::getpid());
  bool isThere_ = false, isLossy_ = false;
};
}  // namespace

TEST(SlamotRobot, WithSecurityWhoHasNoKeysIsNotHeard)
{
  if (!isInstalled("libdds_security_auth.so")) GTEST_SKIP() << "no DDS Security plugins here";
  const LiveTeam team(500);
  const std::string keys = team.folder.file("keys");
  ASSERT_TRUE(succeeds("'" + LiveTeam::source("share/dds-security/make-keys") + "' '" + keys +
                       "' --domain " + LiveTeam::domain() + " 0 1"))
      << "share/dds-security/make-keys needs openssl";
  const std::string others = team.folder.file("others");
  ASSERT_TRUE(succeeds("'" + LiveTeam::source("share/dds-security/make-keys") + "' '" + others +
                       "' --domain " + LiveTeam::domain() + " 2 3"));
  // All four are of the team by their numbers: 0 and 1 have its keys, 2 none, 3 another team's.
  for (const char* number : {"2", "3"})
    fs::copy(team.log(1), team.folder.file(std::string("t.robot") + number + ".rawlog"));
  const Words all = {"--team", "0,1,2,3", "-v"};
  const auto with = [&](const std::string& place) {
    return Words{"--team", "0,1,2,3", "-v", "--set", "dds.security=" + place};
  };
  const auto without = team.start(2, all), stranger = team.start(3, with(others + "/robot3"));
  const auto first = team.start(0, with(keys + "/robot0"));
  const auto second = team.start(1, with(keys + "/robot1"));
  ASSERT_TRUE(first->says("message of robot 1")) << first->text();
  ASSERT_TRUE(second->says("message of robot 0")) << second->text();
  // Discovery is tried every second: some more of those.
  std::this_thread::sleep_for(std::chrono::seconds(3));
  for (const auto* process : {&first, &second, &without, &stranger})
  {
    EXPECT_FALSE((*process)->hasEnded()) << (*process)->text();
    (*process)->signal(SIGINT);
  }
  for (const auto* process : {&first, &second, &without, &stranger})
    EXPECT_EQ((*process)->status(), 130) << (*process)->text();
  const auto heardBy = [&](int robot) { return team.json(robot, "messages.json")["starts_heard"]; };
  EXPECT_EQ(heardBy(0), nlohmann::json({{"1", 1}}));
  EXPECT_EQ(heardBy(1), nlohmann::json({{"0", 1}}));
  for (const int robot : {2, 3})
  {
    EXPECT_EQ(heardBy(robot), nlohmann::json::object()) << robot;
    EXPECT_EQ(team.json(robot, "messages.json")["received"], 0) << robot;
    EXPECT_GT(team.json(robot, "messages.json")["sent"], 0) << robot;
  }
}

TEST(SlamotRobot, ALossyNetworkAndAKilledPeerDoNotStopTheTeam)
{
  const LossyNamespace network;
  if (!network.isLossy()) GTEST_SKIP() << "needs root, ip netns, and tc netem or iptables";
  const LiveTeam team(500);
  const Words live = {"--team", "0,1", "-v"};
  const auto survivor = team.start(0, live, "", network.prefix());
  std::size_t said = 0;
  {
    const auto killed = team.start(1, live, "before.log", network.prefix());
    ASSERT_TRUE(survivor->says("message of robot 1", said)) << survivor->text();
    killed->signal(SIGKILL);
    EXPECT_EQ(killed->status(), 128 + SIGKILL);
  }
  const auto again = team.start(1, live, "", network.prefix());
  ASSERT_TRUE(survivor->says("robot 1 was started again", said)) << survivor->text();
  for (int i = 0; i < 10; ++i)
  {
    ASSERT_TRUE(survivor->says("message of robot 1", said)) << survivor->text();
    ASSERT_FALSE(again->hasEnded()) << again->text();
  }
  survivor->signal(SIGINT);
  again->signal(SIGINT);
  EXPECT_EQ(survivor->status(), 130);
  EXPECT_EQ(again->status(), 130);
  for (const int robot : {0, 1})
  {
    EXPECT_LT(team.json(robot, "summary.json")["robot"]["position_mean_error_m"], 1);
    for (const char* damage : {"wrong_version", "wrong_length", "wrong_checksum", "not_finite"})
      EXPECT_EQ(team.outcome(robot, damage), 0);
  }
}
}  // namespace slamot
