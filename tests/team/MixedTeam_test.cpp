#include <gtest/gtest.h>
#include <slamot/eval/Evaluation.h>
#include <slamot/eval/Recorder.h>
#include <slamot/filters/registerAll.h>
#include <slamot/sim/World.h>
#include <slamot/team/Team.h>

namespace slamot::team
{
namespace
{
const std::string kConfigs = SLAMOT_SOURCE_DIR "/config-ini/";

/// Means over both robots, the whole drive and all seeds.
struct Errors
{
  double robot = 0, target = 0;  ///< [m]
  double robotNees = 0, targetNees = 0;
  int fused = 0;
};

/// 30 s of the small team world, robot 1's heading known less well, so that there is something to
/// be told early.
sim::Scenario scenario()
{
  core::Config config = core::Config::load(kConfigs + "sim.team-300m.ini");
  config.set("world.steps=150");
  config.set("robot_1.start_std_theta_rad=0.03");
  return sim::Scenario::from(config);
}

const std::vector<std::string> kManoeuvring{"ekf-slamot.target_motion=manoeuvring",
                                            "rbpf-slamot.target_motion=manoeuvring"};

Errors run(const std::string& methods, const std::string& rule, int seeds,
           const std::vector<std::string>& settings = {})
{
  filters::registerAll();
  const sim::Scenario world = scenario();
  Errors out;
  for (int seed = 1; seed <= seeds; ++seed)
  {
    core::Config config = core::Config::load(kConfigs + "team-mixed.ini");
    config.set("team.methods=" + methods);
    config.set("team.rule=" + rule);
    for (const std::string& setting : settings) config.set(setting);
    const auto s = static_cast<std::uint64_t>(seed);
    sim::World first(world, s, sim::World::Sightings::kAsRead, 0);
    sim::World second(world, s, sim::World::Sightings::kAsRead, 1);
    sim::World* const worlds[] = {&first, &second};
    Team team(config, {{0, &first, first.starts()}, {1, &second, second.starts()}}, s, 1);
    eval::Recorder recorders[] = {eval::Recorder(team.filter(0)), eval::Recorder(team.filter(1))};
    team.run({{&recorders[0]}, {&recorders[1]}});
    for (std::size_t r = 0; r < 2; ++r)
    {
      const auto e = eval::evaluate(recorders[r].record(), worlds[r]->truth(), {});
      const double share = 1 / (2.0 * seeds);
      out.robot += share * e.robot.all.positionMean.value();
      out.robotNees += share * e.robot.all.neesMean.value();
      out.target += share * e.trueTargets.at(0).all.positionMean.value();
      out.targetNees += share * e.trueTargets.at(0).all.neesPositionMean.value();
      for (const auto& event : team.events(r))
        out.fused += event.receipt.outcome == fusion::Outcome::kFused;
    }
  }
  return out;
}

void expectHelped(const std::string& methods, int seeds,
                  const std::vector<std::string>& settings = {})
{
  const Errors alone = run(methods, "none", seeds, settings);
  const Errors together = run(methods, "ci", seeds, settings);
  EXPECT_EQ(alone.fused, 0);
  EXPECT_GT(together.fused, 2 * seeds);
  EXPECT_LT(together.robot, 0.7 * alone.robot);
  EXPECT_LT(together.target, 0.7 * alone.target);
  EXPECT_LT(together.robotNees, 3.5);   // ideal is 3; of covariance intersection, less
  EXPECT_LT(together.targetNees, 2.5);  // ideal is 2
  EXPECT_GT(together.targetNees, 0.1);
}
}  // namespace

TEST(MixedTeam, OfEkfAndParticleFilterIsBetterThanEachAlone)
{
  expectHelped("ekf-slamot, rbpf-slamot", 4);
}

TEST(MixedTeam, OfParticleFiltersIsBetterThanEachAlone)
{
  expectHelped("rbpf-slamot, rbpf-slamot", 3);
}

// With a bank of models in each robot, which tell one another the bank's mean and covariance.
TEST(MixedTeam, WithBanksOfModelsIsBetterThanEachAlone)
{
  expectHelped("ekf-slamot, rbpf-slamot", 4, kManoeuvring);
}

TEST(MixedTeam, RunsByEveryRule)
{
  for (const char* rule : {"split-ci", "ici", "paper"})
  {
    const Errors together = run("ekf-slamot, rbpf-slamot", rule, 1);
    EXPECT_GT(together.fused, 10) << rule;
    EXPECT_LT(together.robot, 1) << rule;
    EXPECT_LT(together.target, 1) << rule;
  }
}
}  // namespace slamot::team
