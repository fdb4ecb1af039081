#include "filterRig.h"

#include <slamot/math/random.h>
#include <slamot/models/RangeBearing.h>

namespace slamot::filters
{
namespace
{
using models::RangeBearing;
using Outcome = core::Pairing::Outcome;

constexpr double kDt = 0.2;

core::FilterContext startAtZero()
{
  core::FilterContext c;
  c.starts.time = 0.0;
  return c;
}

/// The filters that follow targets, by one script: a robot that stands at the origin, and what it
/// sees.
class Targets : public ::testing::TestWithParam<const char*>
{
 protected:
  void make(const std::string& more = "", core::FilterContext context = startAtZero())
  {
    const std::string name = GetParam();
    std::string keys = "target_velocity_std_mps = 0.5\ntarget_velocity_time_s = 2\n" + more;
    if (name != "odometry") keys += "particles = 20\nassociation = known\nproposal = informed\n";
    filter_ = test::makeFilter(name, keys, context);
  }
  static core::Blob blob(const Point2D& at, int id = core::kNoId,
                         const std::string& label = "target")
  {
    const Vector2 z = RangeBearing::predict({}, at);
    return {label, z[0], z[1], 0.05, 0.01, id};
  }
  static core::Blob bearing(const Point2D& at, int id = core::kNoId)
  {
    core::Blob b = blob(at, id);
    b.range.reset();
    return b;
  }
  /// One step with a blob scan of these.
  core::Update see(std::vector<core::Blob> blobs)
  {
    core::Step step;
    step.time = time_ += kDt;
    step.blobs.emplace().blobs = std::move(blobs);
    return filter_->process(step);
  }
  core::Update see(int times, const std::vector<core::Blob>& blobs)
  {
    core::Update u;
    while (times-- > 0) u = see(blobs);
    return u;
  }
  [[nodiscard]] std::vector<int> ids() const
  {
    std::vector<int> out;
    for (const auto& t : filter_->estimate().targets) out.push_back(t.id);
    return out;
  }
  static double spread(const core::TargetEstimate& t)
  {
    return t.pose.cov(0, 0) + t.pose.cov(1, 1);
  }
  [[nodiscard]] core::TargetEstimate only() const
  {
    const auto targets = filter_->estimate().targets;
    EXPECT_EQ(targets.size(), 1u);
    return targets.at(0);
  }

  std::unique_ptr<core::Filter> filter_;
  double time_ = 0;
};
INSTANTIATE_TEST_SUITE_P(Of, Targets, ::testing::Values("rbpf-slamot", "independent", "odometry"),
                         [](const auto& test)
                         {
                           const std::string name = test.param;
                           return name.substr(0, name.find('-'));
                         });

using Ids = std::vector<int>;
const Point2D kHere{3, 1}, kThere{-2, 2};
}  // namespace

TEST_P(Targets, WithAKnownStartIsThereBeforeTheFirstStep)
{
  core::FilterContext context = startAtZero();
  context.starts.targets[4].value = {3.0, 1.0};
  context.starts.targets[4].std = {0.1, 0.2};
  context.starts.targets[5].value = {std::nullopt, std::nullopt, 1.0};  // no place: no start
  make("", context);
  const core::TargetEstimate t = only();
  EXPECT_EQ(t.id, 4);
  EXPECT_NEAR(t.pose.mean.x, 3, 1e-12);
  EXPECT_NEAR(t.pose.cov(0, 0), 0.01, 1e-12);
  EXPECT_NEAR(t.pose.cov(1, 1), 0.04, 1e-12);
  core::Step step;
  step.time = time_ = 1;
  EXPECT_GT(spread(filter_->process(step).estimate.targets.at(0)), spread(t));
  (void)see({blob(kHere, 4)});
  EXPECT_LT(spread(only()), spread(t));
  EXPECT_EQ(only().label, "target");
}

TEST_P(Targets, WithAnIdentityStartsAtItsFirstSightingAndKeepsIt)
{
  make();
  EXPECT_TRUE(ids().empty());
  const core::Update u = see({blob(kHere, 12, "robot")});
  ASSERT_EQ(u.pairings.size(), 1u);
  EXPECT_TRUE(u.pairings[0].isBlob);
  EXPECT_EQ(u.pairings[0].outcome, Outcome::kNew);
  EXPECT_EQ(u.pairings[0].id, 12);
  const core::TargetEstimate t = only();
  EXPECT_EQ(t.id, 12);
  EXPECT_EQ(t.label, "robot");
  EXPECT_TRUE(t.identified);
  EXPECT_NEAR(t.pose.mean.x, 3, 1e-9);
  EXPECT_NEAR(t.pose.mean.y, 1, 1e-9);
  EXPECT_EQ(t.lastSeen, time_);
  EXPECT_EQ(see({blob(kHere, 12, "robot")}).pairings[0].outcome, Outcome::kKnown);
  EXPECT_EQ(ids(), Ids{12});
}

TEST_P(Targets, WithoutAnIdentityAreNumberedAsTheyAreConfirmed)
{
  make();
  (void)see({blob(kThere)});
  (void)see({blob(kThere), blob(kHere)});
  EXPECT_TRUE(ids().empty());
  (void)see({blob(kHere)});
  (void)see({blob(kHere)});
  EXPECT_EQ(ids(), Ids{0});
  EXPECT_NEAR(only().pose.mean.x, 3, 0.1);
  (void)see({blob(kHere), blob(kThere)});
  EXPECT_EQ(ids(), (Ids{0, 1}));
  EXPECT_FALSE(filter_->estimate().targets[1].identified);
  EXPECT_NEAR(filter_->estimate().targets[1].pose.mean.x, -2, 0.1);
}

TEST_P(Targets, SeenOnceIsDroppedBeforeItIsBelieved)
{
  make("target_tentative_s = 0.5\n");
  for (int i = 0; i < 5; ++i)
  {
    (void)see({blob(kHere)});
    (void)see(4, {});
  }
  EXPECT_TRUE(ids().empty());
}

TEST_P(Targets, IsLostAfterItsTimeAndReturnsUnderItsIdentity)
{
  make("target_lost_s = 3\n");
  (void)see(3, {blob(kHere, 12)});
  (void)see(14, {});
  EXPECT_EQ(ids(), Ids{12});
  (void)see(2, {});
  EXPECT_TRUE(ids().empty());
  (void)see({blob(kThere, 12)});
  EXPECT_EQ(ids(), Ids{12});
  EXPECT_NEAR(only().pose.mean.x, -2, 1e-9);
}

TEST_P(Targets, WithoutAnIdentityReturnsUnderANewNumber)
{
  make("target_lost_s = 3\n");
  (void)see(3, {blob(kHere)});
  EXPECT_EQ(ids(), Ids{0});
  (void)see(17, {});
  (void)see(3, {blob(kHere)});
  EXPECT_EQ(ids(), Ids{1});
}

TEST_P(Targets, IsLostWhenItsPlaceIsTooUncertain)
{
  make("target_lost_std_m = 0.5\n");
  (void)see(3, {blob(kHere, 1)});
  (void)see(2, {});
  EXPECT_EQ(ids(), Ids{1});
  (void)see(20, {});
  EXPECT_TRUE(ids().empty());
}

TEST_P(Targets, UnseenStaysNearItsPlaceAndGrowsUncertain)
{
  make();
  Point2D at = kHere;
  for (int i = 0; i < 10; ++i) (void)see({blob(at = {at.x + 0.1, at.y}, 1)});
  double last = spread(only());
  for (int i = 0; i < 75; ++i)
  {
    (void)see({});
    const double now = spread(only());
    EXPECT_GT(now, last);
    last = now;
  }
  // 0.5 m/s forgotten in two seconds: at most a metre on.
  EXPECT_NEAR(only().pose.mean.x, at.x + 1.0, 0.6);
  EXPECT_NEAR(only().pose.mean.y, at.y, 0.2);
}

TEST_P(Targets, ABearingAloneShrinksTheCovarianceAcrossButNotAlongTheRay)
{
  make();
  (void)see(3, {blob({4, 0}, 1)});
  (void)see(10, {});
  const Matrix2 before = only().pose.cov.topLeftCorner<2, 2>();
  (void)see({bearing({4, 0.2}, 1)});
  const Matrix2 after = only().pose.cov.topLeftCorner<2, 2>();
  EXPECT_LT(after(1, 1), 0.1 * before(1, 1));
  EXPECT_GT(after(0, 0), 0.95 * before(0, 0));
  EXPECT_NEAR(only().pose.mean.y, 0.2, 0.05);
}

TEST_P(Targets, ABearingAloneStartsNothing)
{
  make();
  const core::Update u = see(5, {bearing(kHere, 1), bearing(kThere)});
  EXPECT_TRUE(ids().empty());
  for (const core::Pairing& p : u.pairings) EXPECT_EQ(p.outcome, Outcome::kRejected);
}

TEST_P(Targets, LabelsKeepThemApart)
{
  make();
  (void)see(3, {blob(kHere, core::kNoId, "red"), blob({3.05, 1}, core::kNoId, "blue")});
  ASSERT_EQ(ids(), (Ids{0, 1}));
  const auto targets = filter_->estimate().targets;
  EXPECT_NE(targets[0].label, targets[1].label);
}

TEST_P(Targets, KeepTheirNumbersWhileTheyPassEachOther)
{
  make();
  math::RandomStream random{1};
  for (int i = 0; i < 40; ++i)
  {
    const auto noisy = [&](double x, double y) -> Point2D {
      return {x + 0.03 * random.normal(), y + 0.03 * random.normal()};
    };
    std::vector<core::Blob> blobs{blob(noisy(-3 + 0.15 * i, 2)), blob(noisy(3 - 0.15 * i, 3))};
    if (i % 2) std::swap(blobs[0], blobs[1]);
    (void)see(blobs);
  }
  ASSERT_EQ(ids(), (Ids{0, 1}));
  const auto targets = filter_->estimate().targets;
  const auto& low = targets[targets[0].pose.mean.y < targets[1].pose.mean.y ? 0 : 1];
  const auto& high = targets[targets[0].pose.mean.y < targets[1].pose.mean.y ? 1 : 0];
  EXPECT_NEAR(low.pose.mean.x, 2.85, 0.15);
  EXPECT_NEAR(high.pose.mean.x, -2.85, 0.15);
  EXPECT_GT(low.velocity[0], 0.3);
  EXPECT_LT(high.velocity[0], -0.3);
}

TEST_P(Targets, AnIdentitySeenTwiceInAScanIsOneTarget)
{
  make();
  (void)see({blob(kHere, 12), blob(kThere, 12)});
  EXPECT_EQ(ids(), Ids{12});
  (void)see({blob(kHere, 12), blob(kThere, 12)});
  EXPECT_EQ(ids(), Ids{12});
}

TEST_P(Targets, AnIdentityThatIsElsewhereStartsThereAnew)
{
  make();
  (void)see(5, {blob(kHere, 12)});
  EXPECT_EQ(see({blob(kThere, 12)}).pairings.at(0).outcome, Outcome::kRejected);
  EXPECT_NEAR(only().pose.mean.x, 3, 0.1);
  (void)see(5, {blob(kThere, 12)});
  EXPECT_EQ(ids(), Ids{12});
  EXPECT_NEAR(only().pose.mean.x, -2, 0.1);
}

TEST_P(Targets, AnUnnamedBlobIsOfTheTargetThatItIsAt)
{
  make();
  (void)see(3, {blob(kHere, 12), blob(kThere, 7)});
  const core::Update u = see({blob(kThere)});
  ASSERT_EQ(u.pairings.size(), 1u);
  EXPECT_EQ(u.pairings[0].outcome, Outcome::kKnown);
  EXPECT_EQ(u.pairings[0].id, 7);
  EXPECT_EQ(ids(), (Ids{7, 12}));
}
}  // namespace slamot::filters
