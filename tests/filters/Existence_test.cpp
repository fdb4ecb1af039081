#include "filterRig.h"

#include <set>

namespace slamot::filters
{
namespace
{
/// A robot that stands among landmarks on a circle of 3 m, some of them still there.
class Standing
{
 public:
  explicit Standing(const std::string& keys)
      : filter_(test::makeFilter("rbpf-slamot",
                                 "particles = 5\nproposal = informed\nassociation = nn\n" + keys +
                                     "target_velocity_std_mps = 1\ntarget_velocity_time_s = 1\n"))
  {
  }
  void scans(int n, const std::set<int>& there, double bearingMax = math::kPi)
  {
    for (int i = 0; i < n; ++i)
    {
      core::Step step;
      step.time = ++time_;
      step.landmarks.emplace().fov = {0, 6, -bearingMax, bearingMax};
      for (const int k : there)
        step.landmarks->sightings.push_back({3, bearing(k), 0.1, 0.02, core::kNoId});
      (void)filter_->process(step);
    }
  }
  /// Which of them the map holds.
  [[nodiscard]] std::multiset<int> mapped() const
  {
    std::multiset<int> out;
    for (const auto& [id, l] : test::landmarks(filter_->estimate()))
      for (int k = 0; k < 5; ++k)
        if (std::hypot(l.position.mean.x - 3 * std::cos(bearing(k)),
                       l.position.mean.y - 3 * std::sin(bearing(k))) < 0.3)
          out.insert(k);
    return out;
  }

 private:
  static double bearing(int k) { return -2.4 + 1.2 * k; }
  std::unique_ptr<core::Filter> filter_;
  double time_ = 0;
};

const std::set<int> kAll{0, 1, 2, 3, 4};
const std::multiset<int> kAllMapped{0, 1, 2, 3, 4}, kWithoutTwo{0, 1, 3, 4};
const std::string kDetection = "detection_probability = 0.9\n";
}  // namespace

TEST(Existence, ALandmarkThatVanishesIsRemoved)
{
  Standing s(kDetection);
  s.scans(10, kAll);
  EXPECT_EQ(s.mapped(), kAllMapped);
  s.scans(1, {0, 1, 3, 4});
  EXPECT_EQ(s.mapped(), kAllMapped);  // one miss is nothing unusual
  s.scans(5, {0, 1, 3, 4});
  EXPECT_EQ(s.mapped(), kWithoutTwo);
  s.scans(5, kAll);
  EXPECT_EQ(s.mapped(), kAllMapped);
}

TEST(Existence, WithoutADetectionProbabilityMissesTellNothing)
{
  Standing s("");
  s.scans(10, kAll);
  s.scans(50, {0, 1, 3, 4});
  s.scans(10, {});
  EXPECT_EQ(s.mapped(), kAllMapped);
}

TEST(Existence, AScanThatSawNothingIsNews)
{
  Standing s(kDetection);
  s.scans(10, kAll);
  s.scans(6, {});
  EXPECT_TRUE(s.mapped().empty());
}

TEST(Existence, WhatIsOutOfViewIsNotMissed)
{
  Standing s(kDetection);
  s.scans(10, kAll);
  s.scans(20, {1, 2, 3}, 1.5);
  EXPECT_EQ(s.mapped(), kAllMapped);
}

// Log odds: ln(0.5 / 0.05) for a sighting, ln(0.5 / 0.95) for a miss; four misses outweigh one
// sighting.
TEST(Existence, ANewLandmarkCountsAsSeenOnce)
{
  Standing s("detection_probability = 0.5\nconfirm_sightings = 1\n");
  s.scans(1, kAll);
  s.scans(3, {0, 1, 3, 4});
  EXPECT_EQ(s.mapped(), kAllMapped);
  s.scans(1, {0, 1, 3, 4});
  EXPECT_EQ(s.mapped(), kWithoutTwo);
}

TEST(Existence, ALandmarkSeenOnceIsForgottenBeforeItIsConfirmed)
{
  Standing s(kDetection);
  s.scans(10, {0, 1, 3, 4});
  s.scans(1, kAll);
  s.scans(10, {0, 1, 3, 4});
  s.scans(2, kAll);  // with the one long ago it would be confirmed by now
  EXPECT_EQ(s.mapped(), kWithoutTwo);
}
}  // namespace slamot::filters
