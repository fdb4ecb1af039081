#include "drives.h"
#include "filterRig.h"

#include <slamot/laws/checkFilter.h>

// The members of the family that are settings of one engine.
namespace slamot::filters
{
namespace
{
struct Member
{
  const char* name;
  const char* keys;
  bool knownIds;
};
const Member kMembers[] = {
    {"fastslam1", "particles = 60\n", false},
    {"fastslam2", "association = jcbb\n", false},
    {"ufastslam", "association = known\nconfirm_sightings = 1\n", true},
    {"ufastslam", "proposal_update = sequential\nassociation = scnn\n", false},
    {"ufastslam", "association = jml\n", false},
    {"gmphd-ufastslam", "detection_probability = 0.98\n", false},
    {"gmphd-ufastslam", "detection_probability = 0.98\nparticle_weight = single-feature\n", false},
    {"gmphd-ufastslam", "detection_probability = 0.98\nparticle_weight = empty-set\n", false},
    {"gmphd-ufastslam",
     "detection_probability = 0.98\ntargets = gm-phd\ntarget_detection_probability = 0.98\n",
     false},
    {"rbpf-slamot",
     "particles = 40\nproposal = informed\nassociation = known\nconfirm_sightings = 1\n"
     "targets = gm-phd\ntarget_detection_probability = 0.98\n",
     true},
};
std::string keysOf(const Member& m)
{
  return std::string(m.keys) + "target_velocity_std_mps = 0.8\ntarget_velocity_time_s = 2\n";
}
class Family : public ::testing::TestWithParam<Member>
{
};
INSTANTIATE_TEST_SUITE_P(Each, Family, ::testing::ValuesIn(kMembers));
}  // namespace

TEST_P(Family, ObeysTheFilterLaws)
{
  registerAll();
  const Member& m = GetParam();
  const core::Config config =
      core::Config::parse(std::string("[") + m.name + "]\n" + keysOf(m), "test");
  laws::LawOptions options;
  options.world.identities = m.knownIds;
  options.runs = 40;
  options.robotNees = {0.5, 100, "measure"};
  options.targetNees = {0.3, 100, "measure"};
  laws::checkFilter(m.name, config, options);
}
}  // namespace slamot::filters
