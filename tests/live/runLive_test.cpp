#include <gtest/gtest.h>
#include <slamot/core/Error.h>
#include <slamot/live/Announcement.h>
#include <slamot/live/runLive.h>

#include <limits>
#include <random>
#include <thread>

#include "../fusion/FakeTeamFilter.h"
#include "MemoryNetwork.h"

namespace slamot::live
{
namespace
{
constexpr double kNever = std::numeric_limits<double>::infinity();

/// Steps at given times, each perhaps a moment late.
class Steps : public core::Source
{
 public:
  Steps(std::vector<double> times, unsigned hesitation)
      : times_(std::move(times)), hesitation_(hesitation)
  {
  }
  std::optional<core::Step> next() override
  {
    if (hesitation_ > 0 && random_() % 4 == 0)
      std::this_thread::sleep_for(std::chrono::microseconds(random_() % hesitation_));
    if (at_ == times_.size()) return {};
    core::Step step;
    step.time = times_[at_++];
    return step;
  }

 private:
  std::vector<double> times_;
  std::size_t at_ = 0;
  unsigned hesitation_;
  std::mt19937 random_{1};
};

/// A robot of a fake filter.
struct Robot
{
  Robot(int number, const std::set<int>& team, const fusion::TeamOptions& options,
        const std::vector<double>& times, unsigned hesitation)
      : filter(stateOf(number)),
        member(number, team, filter, options),
        source(times, hesitation),
        forRun{&source, &filter, &member, {}, {}}
  {
  }
  static core::RobotAndTarget stateOf(int number)
  {
    auto out = fusion::someEstimate(6, 0);
    for (Eigen::Index i = 0; i < out.mean.size(); ++i)
      out.mean[i] += 0.01 * std::sin(static_cast<double>(i) + 5.0 * number);
    out.cov *= 1 + 0.3 * number;
    return out;
  }
  fusion::FakeTeamFilter filter;
  fusion::Member member;
  Steps source;
  fusion::TeamRobot forRun;
};

using Times = std::vector<std::vector<double>>;  // by robot

// Some instants are shared, some not; logs start and end when they like.
Times randomTimes(std::mt19937& random, int robots)
{
  Times out(static_cast<std::size_t>(robots));
  for (auto& times : out)
  {
    double t = 0.1 * static_cast<double>(random() % 10);
    for (std::size_t n = 5 + random() % 25; n > 0; --n)
    {
      times.push_back(t);
      t += 0.1 * static_cast<double>(1 + random() % 3);
    }
  }
  return out;
}

std::vector<std::unique_ptr<Robot>> makeRobots(const Times& times,
                                               const fusion::TeamOptions& options,
                                               unsigned hesitation)
{
  std::set<int> team;
  for (std::size_t r = 0; r < times.size(); ++r) team.insert(static_cast<int>(r));
  std::vector<std::unique_ptr<Robot>> out;
  for (std::size_t r = 0; r < times.size(); ++r)
    out.push_back(
        std::make_unique<Robot>(static_cast<int>(r), team, options, times[r], hesitation));
  return out;
}

fusion::TeamOptions optionsOf(unsigned trial)
{
  fusion::TeamOptions out;
  out.target = 7;
  out.frame = "map";
  out.fusion.omega = 0.8;  // fuses always, so that any other order would show
  out.exchangeEvery = 1 + static_cast<int>(trial % 3);
  if (trial % 2) out.radio = {0.2, 0.15, 0.2, 0.2, trial};
  return out;
}

/// One robot in lockstep with others that the test speaks for; what became of it.
std::string failureOf(const std::vector<Announcement>& others)
{
  MemoryHub hub;
  for (const Announcement& a : others) hub.publish("steps", a.sender, encode(a));
  const Times times = {{1, 2, 3}, {1, 2, 3}};
  auto robots = makeRobots(times, optionsOf(0), 0);
  fusion::Radio radio({});
  MemoryNetwork network(hub, 0);
  LiveOptions options;
  options.team = {0, 1};
  try
  {
    runLockstep(robots[0]->forRun, radio, network, options, {0.05, 0.05});
  }
  catch (const core::Error& e)
  {
    EXPECT_EQ(e.status(), core::ExitStatus::kLimit);
    return e.what();
  }
  return "";
}

Announcement announcement(Announcement::Kind kind, std::uint64_t sequence, double time, double next,
                          std::uint64_t session = 5)
{
  Announcement a;
  a.kind = kind;
  a.sender = 1;
  a.session = session;
  a.sequence = sequence;
  a.time = time;
  a.next = next;
  return a;
}
}  // namespace

TEST(Lockstep, EqualsTheTeamWhateverTheTimesOfTheLogsAndTheMachines)
{
  for (unsigned trial = 0; trial < 40; ++trial)
  {
    std::mt19937 random(trial);
    const Times times = randomTimes(random, 2 + static_cast<int>(trial % 3));
    const fusion::TeamOptions options = optionsOf(trial);
    const auto expected = makeRobots(times, options, 0);
    std::vector<fusion::TeamRobot> all;
    for (const auto& robot : expected) all.push_back(robot->forRun);
    fusion::Radio air(options.radio);
    fusion::runTeam(all, air);

    const auto robots = makeRobots(times, options, 2000);
    MemoryHub hub;
    std::vector<std::thread> threads;
    for (const auto& robot : robots)
      threads.emplace_back(
          [&]
          {
            MemoryNetwork network(hub, robot->member.number());
            fusion::Radio radio(options.radio);
            LiveOptions live;
            for (const auto& r : robots) live.team.insert(r->member.number());
            live.session = 1;
            runLockstep(robot->forRun, radio, network, live, {});
          });
    for (auto& thread : threads) thread.join();
    std::int64_t heard = 0;
    for (std::size_t r = 0; r < robots.size(); ++r)
    {
      EXPECT_EQ(robots[r]->filter.bytes(), expected[r]->filter.bytes()) << trial << ", robot " << r;
      EXPECT_EQ(robots[r]->member.counts().rows(), expected[r]->member.counts().rows()) << trial;
      EXPECT_EQ(robots[r]->forRun.events.size(), all[r].events.size()) << trial;
      heard += robots[r]->member.counts().of(fusion::Outcome::kFused);
    }
    EXPECT_GT(heard, 0) << trial;
  }
}

TEST(Lockstep, EndsWithOneLineThatNamesWhoDidWhat)
{
  using Kind = Announcement::Kind;
  const auto hello = announcement(Kind::kHello, 0, 0, 1);
  const auto step = announcement(Kind::kStep, 1, 1, 2);
  EXPECT_NE(failureOf({}).find("robot 1 was not heard, step 0"), std::string::npos);
  EXPECT_NE(failureOf({hello}).find("robot 1 fell silent, step 0"), std::string::npos);
  EXPECT_NE(failureOf({hello, step}).find("robot 1 fell silent, step 1"), std::string::npos);
  EXPECT_NE(failureOf({hello, step, announcement(Kind::kLeft, 2, 1, 2)}).find("ended before"),
            std::string::npos);
  EXPECT_NE(failureOf({hello, announcement(Kind::kHello, 0, 0, 1, 6)}).find("started again"),
            std::string::npos);
  EXPECT_NE(failureOf({hello, announcement(Kind::kStep, 2, 2, 3)}).find("not heard in full"),
            std::string::npos);
  auto stranger = hello;
  stranger.sender = 9;
  EXPECT_NE(failureOf({stranger}).find("robot 9 is not of the team"), std::string::npos);
  // What an earlier run left does not count.
  EXPECT_EQ(failureOf({announcement(Kind::kLeft, 7, 3, kNever, 4), hello,
                       announcement(Kind::kStep, 9, 3, kNever, 4),
                       announcement(Kind::kStep, 1, 3, kNever)}),
            "");
}

TEST(RealTime, AMessageOfTheLastStepIsFusedBeforeTheNextOne)
{
  MemoryHub hub;
  const Times times = {{0, 1e6}, {0}};
  const auto robots = makeRobots(times, optionsOf(0), 0);
  core::Step step;
  robots[1]->member.process(step);
  hub.publish("estimates", 1, robots[1]->member.tell());
  fusion::Radio radio({});
  MemoryNetwork network(hub, 0);
  std::atomic<bool> stop{false};
  LiveOptions options;
  options.team = {0, 1};
  options.run.stop = &stop;
  options.onFusion = [&](const fusion::FusionEvent& e)
  {
    EXPECT_EQ(e.time, 0);
    EXPECT_EQ(e.sent, 0);
    stop = true;  // the next step is never due
  };
  const LiveResult result = runRealTime(robots[0]->forRun, radio, network, options, {});
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.steps, 1u);
  EXPECT_EQ(robots[0]->forRun.events.size(), 1u);
  EXPECT_EQ(result.sessionsHeard, (std::map<int, int>{{1, 1}}));
}

TEST(RealTime, WhoIsFarBehindCatchesUpBeforeItTellsAndHears)
{
  MemoryHub hub;
  const Times times = {{0, 1, 2, 3, 1000}, {1000}};
  const auto robots = makeRobots(times, optionsOf(0), 0);
  hub.publish("clock", 1, encode(Beacon{1, 1, 1, 999.5}));
  core::Step step;
  step.time = 1000;
  robots[1]->member.process(step);
  hub.publish("estimates", 1, robots[1]->member.tell());
  fusion::Radio radio({});
  MemoryNetwork network(hub, 0);
  LiveOptions options;
  options.team = {0, 1};
  const LiveResult result = runRealTime(robots[0]->forRun, radio, network, options, {});
  EXPECT_FALSE(result.interrupted);
  EXPECT_EQ(result.steps, 5u);
  // Nobody counts as from the future what it was too late for.
  EXPECT_EQ(robots[0]->member.counts().messages(), 1);
  EXPECT_EQ(robots[0]->forRun.events.size(), 1u);
  EXPECT_LE(robots[0]->member.sent(), 2);
}
}  // namespace slamot::live
