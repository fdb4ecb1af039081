#include "filterRig.h"

#include <slamot/laws/checkFilter.h>
#include <slamot/sim/World.h>

// Banks of models and glint in every filter: the laws that all obey.
namespace slamot::filters
{
namespace
{
const std::string kBank =
    "target_motion = manoeuvring\ntarget_velocity_std_mps = 0.8\ntarget_speed_mps = 0.8\n"
    "target_turn_rate_deg_per_s = 11.459155902616464\ntarget_mode_time_s = 10\n"
    "target_velocity_noise_mps_per_sqrt_hz = 0.03\ntarget_heading_walk_deg_per_sqrt_s = 1.8\n"
    "target_acceleration_std_mps2 = 0.3\ntarget_acceleration_noise_mps2_per_sqrt_hz = 0.02\n"
    "target_jerk_noise_mps3_per_sqrt_hz = 0.1\n";
const std::string kAllModes =
    "target_modes = constant-velocity, left-turn, right-turn, coordinated-turn, "
    "constant-acceleration\n";
const std::string kDriven =
    "target_motion = differential-drive\ntarget_speed_mps = 0.8\n"
    "target_turn_rate_deg_per_s = 11.459155902616464\ntarget_speed_noise_mps = 0.1\n"
    "target_turn_rate_noise_deg_per_s = 5.729577951308232\n";
const std::string kTargetGlint = "target_glint_probability = 0.05\n";
const std::string kGlint = "glint_probability = 0.05\n" + kTargetGlint;
const std::string kRbpf = "particles = 40\nproposal = informed\nassociation = known\n";
const std::string kPhd = "particles = 40\nassociation = nn\ntargets = gm-phd\n";

struct Case
{
  std::string test, filter, keys;
};
const Case kCases[] = {
    {"BankRbpf", "rbpf-slamot", kRbpf + kBank},
    {"AllModesRbpf", "rbpf-slamot", kRbpf + kBank + kAllModes},
    {"BankEkf", "ekf-slamot", kBank},
    {"AllModesEkf", "ekf-slamot", kBank + kAllModes},
    {"BankCompressed", "ekf-slamot", kBank + "local_radius_m = 3\n"},
    {"BankSlamot", "slamot", kBank},
    {"BankOdometry", "odometry", kBank},
    {"BankPhd", "gmphd-ufastslam", kPhd + kBank},
    {"GlintRbpf", "rbpf-slamot", kRbpf + kDriven + kGlint},
    {"GlintMotion", "fastslam1", "particles = 40\nassociation = known\n" + kDriven + kGlint},
    {"GlintNn", "rbpf-slamot",
     "particles = 40\nproposal = informed\nassociation = nn\n" + kDriven + kGlint},
    {"GlintJcbb", "ufastslam", "particles = 40\nassociation = jcbb\n" + kDriven + kGlint},
    {"GlintEkf", "ekf-slamot", kDriven + kGlint},
    {"GlintEkfJcbb", "ekf-slamot", "association = jcbb\n" + kDriven + kGlint},
    {"GlintCompressed", "ekf-slamot", "local_radius_m = 3\n" + kDriven + kGlint},
    {"GlintSlamot", "slamot", kDriven + kGlint},
    {"GlintOdometry", "odometry", kDriven + kTargetGlint},
    {"GlintPhd", "gmphd-ufastslam", kPhd + kDriven + kGlint}};

class TargetModels : public ::testing::TestWithParam<Case>
{
};
INSTANTIATE_TEST_SUITE_P(Each, TargetModels, ::testing::ValuesIn(kCases),
                         [](const auto& one) { return one.param.test; });
}  // namespace

TEST_P(TargetModels, ObeyTheFilterLaws)
{
  registerAll();
  const auto& [test, filter, keys] = GetParam();
  laws::LawOptions options;
  options.runs = 20;
  // A model that expects more than the world does is cautious; particles are few.
  options.robotNees = {0.5, filter == "fastslam1" ? 100.0 : 5.0,
                       "a law expects outliers, of which the world has none"};
  options.targetNees = {0.3, 5, "the target never leaves its one mode"};
  laws::checkFilter(filter, core::Config::parse("[" + filter + "]\n" + keys, test), options);
}

// A law's tails reach over the whole small world: what is new is new all the same.
TEST(TargetModels, FilterThatExpectsGlintMapsWhatIsNewWithoutIdentities)
{
  laws::World world;
  world.identities = false;
  const laws::Drive drive = laws::drive(world, 5);
  core::FilterContext context;
  context.starts = drive.starts;
  const auto mapped = [&](const std::string& name, const std::string& keys)
  {
    const auto filter = test::makeFilter(name, "association = nn\n" + kDriven + keys, context);
    for (const core::Step& step : drive.steps) (void)filter->process(step);
    return test::landmarks(filter->estimate()).size();
  };
  const std::string few = "particles = 40\nproposal = informed\n";
  for (const auto& [name, keys] : {std::pair<std::string, std::string>{"rbpf-slamot", few},
                                   std::pair<std::string, std::string>{"ekf-slamot", ""}})
  {
    const std::size_t plain = mapped(name, keys), told = mapped(name, keys + kGlint);
    EXPECT_GE(plain, 8u) << name;
    EXPECT_GE(told + 1, plain) << name;
  }
}
}  // namespace slamot::filters
