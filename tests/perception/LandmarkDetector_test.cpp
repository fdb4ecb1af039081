#include <slamot/core/Error.h>
#include <slamot/math/gaussian.h>
#include <slamot/perception/CornerDetector.h>
#include <slamot/perception/RoundDetector.h>

#include "castScans.h"

#include <gtest/gtest.h>

namespace slamot::perception
{
namespace
{
using namespace test;

std::vector<DetectedLandmark> found(const std::string& kind, const core::LaserScan& scan,
                                    const std::string& keys = {})
{
  core::Config config = core::Config::parse("[" + kind + "]\n" + keys, "test");
  const LaserOptions laser;
  return LandmarkDetectorRegistry::instance()
      .make(kind, config, laser)
      ->detect(scan, clustersOf(scan, laser));
}

double nees(const Gaussian<Point2D>& estimate, const Point2D& truth)
{
  const Vector2 e(estimate.mean.x - truth.x, estimate.mean.y - truth.y);
  return math::mahalanobisSquared(e, estimate.cov);
}

/// Mean NEES of what is found of one circle over scans from about it; `missed` counts.
double consistency(const std::string& kind, double radius, double range, int& missed,
                   const std::string& keys = {})
{
  double sum = 0;
  int n = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
  {
    math::RandomStream random{1000 + seed};
    const double a = random.uniform(-1.2, 1.2);
    const Point2D at{range * std::cos(a), range * std::sin(a)};
    const auto all = found(kind, scanOf({{{at, radius}}, {}}, {}, seed), keys);
    if (all.size() != 1)
    {
      ++missed;
      continue;
    }
    sum += nees(all[0].at, at);
    ++n;
  }
  return sum / std::max(1, n);
}

TEST(Posts, AreWhereTheyAreAsSurelyAsTheySay)
{
  for (const double range : {1.0, 2.0, 4.0, 6.0})
  {
    int missed = 0;
    const double mean = consistency("posts", 0.1, range, missed);
    EXPECT_EQ(missed, 0) << range;
    EXPECT_LT(mean, 2.6) << range;  // 2 +- 0.14 if right; a mean over 200 is above by chance never
    EXPECT_GT(mean, 0.8) << range;  // between beams there is more doubt than error
  }
}

TEST(Trees, OfAnySizeAreWhereTheyAreAsSurelyAsTheySay)
{
  for (const double radius : {0.1, 0.25, 0.5})
    for (const double range : {3.0, 8.0, 15.0})
    {
      if (2 * radius / range < 2.5 * Laser{}.angleStep) continue;  // between the beams
      int missed = 0;
      const double mean = consistency("trees", radius, range, missed);
      EXPECT_LE(missed, 4) << radius << " at " << range;
      EXPECT_LT(mean, 2.6) << radius << " at " << range;
    }
}

TEST(Posts, AreNoWallsCornersOrThingsThatAreHidden)
{
  const World world{{{{6, -1.8}, 0.1}, {{3, -0.95}, 0.1}, {{4, 1}, 0.6}},
                    {{{8, -8}, {8, 8}}, {{2, 4}, {2, 6}}, {{2, 4}, {4, 4}}}};
  const auto all = found("posts", scanOf(world, {}, 5));
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NEAR(all[0].at.mean.x, 3, 0.05);
  EXPECT_NEAR(all[0].size, 0.1, 0.05);
}

TEST(Corners, AreWhereWallsMeet)
{
  double sum = 0;
  constexpr int kScans = 200;
  for (std::uint64_t seed = 1; seed <= kScans; ++seed)
  {
    math::RandomStream random{seed};
    const Point2D at{random.uniform(3, 6), random.uniform(-2, 2)};
    // A room's corner, seen from inside.
    const double turn = std::atan2(at.y, at.x) + random.uniform(-0.3, 0.3);
    const auto end = [&](double a)
    { return Point2D(at.x + 2 * std::cos(turn + a), at.y + 2 * std::sin(turn + a)); };
    const auto all =
        found("corners", scanOf({{}, {{at, end(2.356)}, {at, end(-2.356)}}}, {}, seed));
    ASSERT_EQ(all.size(), 1u) << seed;
    EXPECT_LT(std::hypot(all[0].at.mean.x - at.x, all[0].at.mean.y - at.y), 0.15) << seed;
    sum += nees(all[0].at, at);
  }
  EXPECT_LT(sum / kScans, 3);
  EXPECT_GT(sum / kScans, 1);
}

TEST(Corners, AStraightWallAndARoundThingHaveNone)
{
  EXPECT_TRUE(found("corners", scanOf({{}, {{{4, -6}, {4, 6}}}}, {}, 6)).empty());
  EXPECT_TRUE(found("corners", scanOf({{{{3, 0}, 0.3}}, {}}, {}, 6)).empty());
}

TEST(LinesOf, FitsEachWallOfARoom)
{
  const World room{{}, {{{6, -3}, {6, 3}}, {{6, 3}, {-6, 3}}, {{6, -3}, {-6, -3}}}};
  const LaserOptions laser;
  const auto clusters = clustersOf(scanOf(room, {}, 7), laser);
  ASSERT_EQ(clusters.size(), 1u);
  const auto lines = linesOf(clusters[0], laser.rangeStd, {});
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_NEAR(lines[1].direction.x, 0, 0.01);  // the one ahead, from right to left
  EXPECT_NEAR(lines[1].direction.y, 1, 0.01);
  EXPECT_NEAR(lines[1].middle.x, 6, 0.02);
  EXPECT_LT(lines[1].angleStd, 0.01);
}

class Nowhere : public LandmarkDetector
{
 public:
  Nowhere(core::Params& p, const LaserOptions&) { (void)p.positive("radius_m"); }
  [[nodiscard]] std::vector<DetectedLandmark> detect(const core::LaserScan&,
                                                     const std::vector<Cluster>&) const override
  {
    return {};
  }
  [[nodiscard]] double maxRange() const override { return 1; }
};

TEST(LandmarkDetectorRegistry, MakesByNameAndReadsStrictly)
{
  auto& registry = LandmarkDetectorRegistry::instance();
  registry.add("nowhere", [](core::Params& p, const LaserOptions& o)
               { return std::make_unique<Nowhere>(p, o); });
  core::Config none = core::Config::parse("", "test");
  EXPECT_THROW((void)registry.make("nowhere", none, {}), core::Error);  // its key is missing
  EXPECT_THROW((void)registry.make("nothing", none, {}), core::Error);
  registry.add("posts", [](core::Params& p, const LaserOptions& o)
               { return std::make_unique<Nowhere>(p, o); });
  EXPECT_THROW((void)registry.make("posts", none, {}), core::Error);  // registered twice
}
}  // namespace
}  // namespace slamot::perception
