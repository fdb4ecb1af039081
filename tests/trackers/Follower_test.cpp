#include "glintWorld.h"

#include <slamot/core/Error.h>

namespace slamot::filters
{
namespace
{
using namespace test;
using Outcome = core::Pairing::Outcome;

const char* const kNames[] = {"kalman-tracker", "imm-tracker", "particle-tracker"};
const std::string kMotion =
    "target_velocity_std_mps = 1\ntarget_acceleration_noise_mps2_per_sqrt_hz = 0.2\n";

core::Step stepAt(double time, std::vector<core::Blob> blobs)
{
  core::Step out;
  out.time = time;
  out.odometry = Gaussian<Pose2D>{};
  out.blobs = core::BlobScan{{}, std::move(blobs)};
  return out;
}

core::Blob blobAt(double x, double y, int id = core::kNoId, const std::string& label = "target")
{
  return {label, std::hypot(x, y), std::atan2(y, x), 0.1, 0.01, id};
}

class EachTracker : public testing::TestWithParam<const char*>
{
};
std::string nameOf(const testing::TestParamInfo<const char*>& tracker)
{
  std::string name = tracker.param;
  name.erase(name.find('-'), 1);
  return name;
}
INSTANTIATE_TEST_SUITE_P(Trackers, EachTracker, testing::ValuesIn(kNames), nameOf);

TEST_P(EachTracker, TellsNamelessTargetsApart)
{
  const auto filter = makeFilter(GetParam(), kMotion);
  core::Update u;
  for (int i = 0; i <= 20; ++i)
    u = filter->process(stepAt(0.1 * i, {blobAt(5 + 0.05 * i, 2), blobAt(8, 6 - 0.05 * i)}));
  ASSERT_EQ(u.estimate.targets.size(), 2u);
  EXPECT_FALSE(u.estimate.targets[0].identified);
  EXPECT_NEAR(u.estimate.targets[0].pose.mean.x, 6, 0.2);
  EXPECT_NEAR(u.estimate.targets[1].pose.mean.y, 5, 0.2);
  EXPECT_NEAR(u.estimate.targets[0].velocity.x(), 0.5, 0.3);
  EXPECT_NEAR(u.estimate.targets[1].velocity.y(), -0.5, 0.3);
  for (const auto& p : u.pairings) EXPECT_EQ(p.outcome, Outcome::kKnown);
}

TEST_P(EachTracker, BelievesInTheThirdSightingAndLosesWhatIsUnseen)
{
  const auto filter = makeFilter(GetParam(), kMotion + "target_lost_s = 2\n");
  EXPECT_EQ(filter->process(stepAt(0, {blobAt(5, 2)})).pairings.at(0).outcome, Outcome::kNew);
  EXPECT_TRUE(filter->process(stepAt(0.1, {blobAt(5, 2)})).estimate.targets.empty());
  EXPECT_EQ(filter->process(stepAt(0.2, {blobAt(5, 2)})).estimate.targets.size(), 1u);
  EXPECT_EQ(filter->process(stepAt(2.1, {})).estimate.targets.size(), 1u);
  EXPECT_TRUE(filter->process(stepAt(2.3, {})).estimate.targets.empty());
}

TEST_P(EachTracker, TakesIdentitiesAtTheirWordWhereTheyAreKnown)
{
  for (const bool known : {true, false})
  {
    const auto filter = makeFilter(
        GetParam(), kMotion + (known ? "association = known\n" : "") + "likelihood = gaussian\n");
    for (int i = 0; i < 5; ++i) (void)filter->process(stepAt(0.1 * i, {blobAt(5, 2, 4)}));
    const auto u = filter->process(stepAt(0.5, {blobAt(5, 9, 4)}));
    EXPECT_EQ(u.pairings.at(0).outcome, known ? Outcome::kKnown : Outcome::kRejected);
    EXPECT_EQ(u.estimate.targets.at(0).id, 4);
  }
}

TEST_P(EachTracker, KeepsToLabels)
{
  const auto filter = makeFilter(GetParam(), kMotion);
  for (int i = 0; i < 5; ++i) (void)filter->process(stepAt(0.1 * i, {blobAt(5, 2, 1)}));
  const auto u = filter->process(stepAt(0.5, {blobAt(5, 2, core::kNoId, "robot")}));
  EXPECT_EQ(u.pairings.at(0).outcome, Outcome::kNew);
}

// What odometry lacks in certainty is in what is reported, and only there.
TEST_P(EachTracker, AddsTheRobotsDoubt)
{
  const auto run = [&](double std)
  {
    const auto filter = makeFilter(GetParam(), kMotion);
    core::Update u;
    for (int i = 0; i < 10; ++i)
    {
      core::Step step = stepAt(0.1 * i, {blobAt(5, 2, 1)});
      step.odometry->cov = std * std * Matrix3::Identity();
      u = filter->process(step);
    }
    return u.estimate;
  };
  const auto sure = run(0), doubtful = run(0.1);
  EXPECT_EQ(sure.targets[0].pose.mean, doubtful.targets[0].pose.mean);
  const Matrix3 more = doubtful.targets[0].pose.cov - sure.targets[0].pose.cov;
  // 10 steps: 0.1 in all, of place; a turn moves the target by its distance, across.
  const Pose2D& at = sure.targets[0].pose.mean;
  EXPECT_NEAR(more(0, 0), 0.1 + 0.1 * at.y * at.y, 1e-9);
  EXPECT_NEAR(more(1, 1), 0.1 + 0.1 * at.x * at.x, 1e-9);
  EXPECT_TRUE(doubtful.robot.cov.isApprox(0.1 * Matrix3::Identity()));
}

TEST_P(EachTracker, SaysWhatIsWrongWithItsKeys)
{
  const auto complaint = [&](const std::string& keys) -> std::string
  {
    try
    {
      (void)makeFilter(GetParam(), kMotion + keys);
    }
    catch (const core::Error& e)
    {
      EXPECT_EQ(e.status(), core::ExitStatus::kConfig);
      return e.what();
    }
    return {};
  };
  const std::string where = std::string("test [") + GetParam() + "] ";
  EXPECT_EQ(complaint("observation = polr\n").rfind(where + "observation: 'polr' is not known", 0),
            0u);
  EXPECT_EQ(complaint("likelihood = normal\n").rfind(where + "likelihood: ", 0), 0u);
  EXPECT_EQ(complaint("noise_scale = 0\n").rfind(where + "noise_scale: 0 is out of range", 0), 0u);
  EXPECT_EQ(
      complaint("target_glint_probability = 2\n").rfind(where + "target_glint_probability", 0), 0u);
  EXPECT_EQ(complaint("weight_exponet = 1\n").rfind(where + "weight_exponet: unknown key", 0), 0u);
  EXPECT_EQ(complaint(""), "");
}

TEST(ParticleTrackerKeys, SayWhatIsWrongWithThem)
{
  for (const char* key : {"weight_exponent = 1.1", "resample_below_ess = -1", "particles = 0",
                          "target_motion = damped-velocity"})
    EXPECT_THROW((void)makeFilter("particle-tracker", kMotion + key + "\n"), core::Error) << key;
}

TEST(TrackerConfigs, ShippedOnesRun)
{
  const GlintRun run("position", 1);
  for (const std::string name : kNames)
  {
    registerAll();
    core::Config config = core::Config::load(SLAMOT_CONFIG_INI "/" + name + ".ini");
    const auto filter = core::FilterRegistry::instance().make(name, config, run.context());
    config.requireAllRead();
    EXPECT_LT(rmse(follow(*filter, run), run), 30) << name;
  }
}
}  // namespace
}  // namespace slamot::filters
