#include "filterRig.h"

#include <slamot/core/Error.h>

namespace slamot::filters
{
namespace
{
const std::string kGood =
    "particles = 5\nproposal = informed\nassociation = nn\ntarget_velocity_std_mps = 1\n"
    "target_velocity_time_s = 1\n";

/// The error that one more line leads to; empty if none.
std::string errorOf(const std::string& text)
{
  try
  {
    (void)test::makeFilter("rbpf-slamot", text);
    return {};
  }
  catch (const core::Error& e)
  {
    EXPECT_EQ(e.status(), core::ExitStatus::kConfig);
    return e.what();
  }
}
std::string without(const std::string& key)
{
  std::string text = kGood;
  const auto at = text.find(key);
  return text.erase(at, text.find('\n', at) - at + 1);
}
}  // namespace

TEST(RbpfSettings, NeedLittle)
{
  EXPECT_EQ(errorOf(kGood), "");
}

TEST(RbpfSettings, NameWhatIsMissing)
{
  for (const char* key : {"particles", "proposal", "association"})
    EXPECT_NE(errorOf(without(key)).find(std::string("[rbpf-slamot] ") + key + ": missing"),
              std::string::npos)
        << key;
}

TEST(RbpfSettings, RefuseWhatIsOutOfRange)
{
  for (const char* line :
       {"gate_probability = 1", "gate_probability = 0", "new_gate_probability = 0.5",
        "new_density_per_m_rad = -1", "range_std_m = -1", "bearing_std_deg = nan",
        "confirm_sightings = 0", "detection_probability = 1", "resample_below_ess = 1.1",
        "resampling = best", "target_confirm_sightings = 0", "target_lost_s = 0",
        "target_lost_std_m = 0", "target_motion = straight", "target_range_std_m = -1"})
  {
    const std::string key = std::string(line).substr(0, std::string(line).find(' '));
    EXPECT_NE(errorOf(kGood + line + "\n").find("[rbpf-slamot] " + key), std::string::npos) << line;
  }
  EXPECT_NE(errorOf(without("particles") + "particles = 0\n").find("from 1 to"), std::string::npos);
}

TEST(RbpfSettings, FollowWithBothDeviationsOrNeither)
{
  for (const char* line : {"follow_range_std_m = 0.1\n", "follow_bearing_std_deg = 1\n"})
    EXPECT_NE(errorOf(kGood + line).find("go together"), std::string::npos) << line;
  EXPECT_EQ(errorOf(kGood + "follow_range_std_m = 0.1\nfollow_bearing_std_deg = 1\n"), "");
}

TEST(RbpfSettings, SuggestTheNearestKey)
{
  EXPECT_NE(errorOf(kGood + "gate_probabilty = 0.9\n").find("did you mean gate_probability?"),
            std::string::npos);
}

TEST(RbpfSettings, ResampleByEveryScheme)
{
  for (const char* scheme : {"systematic", "stratified", "residual", "multinomial"})
    EXPECT_EQ(errorOf(kGood + "resampling = " + scheme + "\n"), "");
}

// Else --set could not choose another motion than the one whose keys the file holds.
TEST(RbpfSettings, LeaveTheKeysOfTheOtherMotionAlone)
{
  const std::string drive =
      "target_speed_mps = 1\ntarget_turn_rate_deg_per_s = 0\ntarget_speed_noise_mps = 0.1\n"
      "target_turn_rate_noise_deg_per_s = 1\ntarget_speed_std_mps = 0\n";
  EXPECT_EQ(errorOf(kGood + drive), "");
  EXPECT_EQ(errorOf(kGood + drive + "target_motion = differential-drive\n"), "");
}
}  // namespace slamot::filters
