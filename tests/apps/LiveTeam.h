#pragma once

#include "../results/TemporaryFolder.h"
#include "Process.h"
#include "program.h"

#include <memory>
#include <nlohmann/json.hpp>

namespace slamot::test
{
/// Robots in processes of their own, on this machine's loopback; other tests don't hear them.
class LiveTeam
{
 public:
  using Words = std::vector<std::string>;

  /// \param scenario of the logs t.robot0.rawlog, ...; shortened to so many steps of 0.2 s.
  explicit LiveTeam(int steps, const std::string& scenario = source("config-ini/sim.team-300m.ini"))
  {
    const auto made = slamot(
        "simulate '" + scenario + "' -q -o t.rawlog --set world.steps=" + std::to_string(steps),
        folder.file(""));
    EXPECT_EQ(made.status, 0) << made.text;
  }

  static std::string source(const std::string& path)
  {
    return std::string(SLAMOT_SOURCE_DIR) + "/" + path;
  }
  /// So that tests side by side meet neither by name nor, mostly, by port.
  static std::string domain() { return std::to_string(::getpid() % 230); }

  [[nodiscard]] std::string log(int robot) const
  {
    return folder.file("t.robot" + std::to_string(robot) + ".rawlog");
  }

  /// Starts a robot; its results go to r<robot>, what it says to `said`.
  std::unique_ptr<Process> start(int robot, const Words& more, const std::string& said = {},
                                 const Words& before = {}) const
  {
    const std::string name = "r" + std::to_string(robot);
    Words words = before;
    for (const std::string& word :
         Words{SLAMOT_PROGRAM, "robot", config, log(robot), "-o", folder.file(name), "--set",
               "dds.interface=lo", "--set", "dds.peers=127.0.0.1", "--set",
               "dds.domain=" + domain(), "--set", "dds.name=test-" + std::to_string(::getpid())})
      words.push_back(word);
    words.insert(words.end(), more.begin(), more.end());
    return std::make_unique<Process>(words, folder.file(said.empty() ? name + ".log" : said));
  }

  [[nodiscard]] nlohmann::json json(int robot, const std::string& file) const
  {
    return nlohmann::json::parse(folder.read("r" + std::to_string(robot) + "/" + file));
  }
  [[nodiscard]] int outcome(int robot, const char* name) const
  {
    return json(robot, "messages.json")["by_outcome"][name];
  }

  TemporaryFolder folder;
  std::string config = source("config-ini/robot-ci.ini");
};
}  // namespace slamot::test
