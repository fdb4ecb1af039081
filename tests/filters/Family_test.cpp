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

namespace
{
/// A robot that goes round among landmarks with identities and reports where they are.
class Round
{
 public:
  explicit Round(const std::string& keys)
      : filter_(
            test::makeFilter("ufastslam", "association = known\nconfirm_sightings = 1\n" + keys))
  {
  }
  core::Update step(const std::map<int, int>& misread = {})
  {
    const Pose2D increment(0.1, 0, 0.05);
    truth_ = math::compose(truth_, increment);
    core::Step out;
    out.time = ++time_;
    const Vector3 std(0.03, 0.02, 0.02);
    out.odometry = {increment, Matrix3(std.cwiseAbs2().asDiagonal())};
    out.landmarks.emplace();
    for (int k = 0; k < 5; ++k)
    {
      const Point2D at(6 * std::cos(1.2 * k), 6 * std::sin(1.2 * k));
      const double dx = at.x - truth_.x, dy = at.y - truth_.y;
      const auto wrong = misread.find(k);
      out.landmarks->sightings.push_back({std::hypot(dx, dy),
                                          math::wrapToPi(std::atan2(dy, dx) - truth_.phi), 0.1,
                                          0.02, wrong == misread.end() ? k : wrong->second});
    }
    return filter_->process(out);
  }
  [[nodiscard]] double error() const
  {
    const Pose2D& at = filter_->estimate().robot.mean;
    return std::hypot(at.x - truth_.x, at.y - truth_.y);
  }
  [[nodiscard]] const Pose2D& truth() const { return truth_; }

 private:
  std::unique_ptr<core::Filter> filter_;
  Pose2D truth_;
  double time_ = 0;
};
}  // namespace

TEST(UnscentedFastSlam, AMisreadIdentityIsRejectedBeforeItShapesThePose)
{
  for (const char* update : {"batch", "sequential"})
  {
    Round round(std::string("proposal_update = ") + update + "\n");
    for (int i = 0; i < 20; ++i) round.step();
    const double before = round.error();
    EXPECT_LT(before, 0.1);
    const auto pairings = round.step({{1, 3}, {3, 1}}).pairings;  // 1 and 3 exchanged
    for (const auto& p : pairings)
      EXPECT_EQ(p.outcome, p.index == 1 || p.index == 3 ? core::Pairing::Outcome::kRejected
                                                        : core::Pairing::Outcome::kKnown)
          << update << " " << p.index;
    EXPECT_LT(round.error(), before + 0.05) << update;
  }
}

// Where the transform is all but linear, the scan at once and sighting by sighting say the same.
TEST(UnscentedFastSlam, SightingBySightingIsTheScanAtOnceWhereLittleIsInDoubt)
{
  Round batch("proposal_update = batch\n"), sequential("proposal_update = sequential\n");
  double most = 0;
  for (int i = 0; i < 30; ++i)
  {
    const Pose2D a = batch.step().estimate.robot.mean, b = sequential.step().estimate.robot.mean;
    most = std::max(most, std::hypot(a.x - b.x, a.y - b.y));
  }
  EXPECT_LT(most, 2e-3);  // a tenth of what a scan leaves in doubt
  EXPECT_GT(most, 0);     // they are not the same computation
}
}  // namespace slamot::filters
