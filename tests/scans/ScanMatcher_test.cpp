#include <gtest/gtest.h>
#include <slamot/scans/ScanMatcher.h>
#include <slamot/scans/returns.h>

#include "drawnHouse.h"
#include "searchWindow.h"

namespace slamot::scans
{
namespace
{
using namespace slamot::test;

constexpr MatchSettings kSettings{0.03, 1, 0.001, 0.0002, 0.35};
constexpr MatchReach kReach{0.4, 1.5, 0.4, 1.0};

std::vector<Point2D> pointsOfScan(const Walls& walls, const Pose2D& pose,
                                  math::RandomStream& random, double rangeStd = 0.02)
{
  std::vector<Point2D> out;
  for (const Return& r : returnsOf({scanFrom(walls, pose, random, rangeStd)}, 25))
    out.push_back(r.point);
  return out;
}

/// What scans from these poses saw, at their true places.
LocalMap mapOf(const Walls& walls, const std::vector<Pose2D>& poses, math::RandomStream& random)
{
  std::vector<Point2D> all;
  for (const Pose2D& pose : poses)
    for (const Point2D& p : pointsOfScan(walls, pose, random))
      all.push_back(math::transform(pose, p));
  return LocalMap(all, 40);
}

Gaussian<Pose2D> around(const Pose2D& pose, double position, double heading)
{
  Gaussian<Pose2D> out;
  out.mean = pose;
  out.cov = Vector3(position * position, position * position, heading * heading).asDiagonal();
  return out;
}

Vector3 errorOf(const Pose2D& a, const Pose2D& b)
{
  return {a.x - b.x, a.y - b.y, math::wrapToPi(a.phi - b.phi)};
}

const std::vector<Pose2D> kFrom = {{2, 1.5, 0}, {2.4, 1.6, 0.4}, {2.8, 1.8, 0.8}, {3, 2.2, 1.2}};

TEST(ScanMatcher, FindsWhereAScanWasTakenAllOverTheWindow)
{
  math::RandomStream random{1};
  const LocalMap map = mapOf(room(), kFrom, random);
  const Pose2D truth{2.9, 2.0, 0.9};
  const auto points = pointsOfScan(room(), truth, random);
  for (const double d : {-0.38, 0.0, 0.38})
    for (const double turn : {-0.39, 0.0, 0.39})
    {
      const auto expected = around({truth.x + d, truth.y - d, truth.phi + turn}, 0.01, 0.01);
      const Match m = ScanMatcher(kSettings).match(map, points, expected, kReach);
      ASSERT_TRUE(m.matched) << d << " " << turn;
      const Vector3 e = errorOf(m.alone.mean, truth);
      EXPECT_LT(e.head<2>().norm(), 0.03) << d << " " << turn;
      EXPECT_LT(std::abs(e[2]), 0.01) << d << " " << turn;
      EXPECT_GT(m.score, 0.6);
    }
}

TEST(ScanMatcher, SearchesThreeDeviationsOfWhatIsExpected)
{
  math::RandomStream random{2};
  const LocalMap map = mapOf(room(), kFrom, random);
  const Pose2D truth{2.9, 2.0, 0.9};
  const auto points = pointsOfScan(room(), truth, random);
  const Pose2D far{truth.x + 1.2, truth.y, truth.phi};
  const ScanMatcher matcher(kSettings);
  const Match narrow = matcher.match(map, points, around(far, 0.1, 0.02), kReach);
  EXPECT_GT(errorOf(narrow.alone.mean, truth).norm(), 0.5);  // the window ends 0.4 m from `far`
  const Match wide = matcher.match(map, points, around(far, 0.5, 0.02), kReach);
  EXPECT_LT(errorOf(wide.alone.mean, truth).norm(), 0.03);
}

TEST(ScanMatcher, TellsWhatItCannotMatch)
{
  math::RandomStream random{3};
  const LocalMap map = mapOf(room(), kFrom, random);
  const ScanMatcher matcher(kSettings);
  const auto expected = around({2.9, 2, 0.9}, 0.1, 0.1);
  Walls elsewhere;  // a hall: all walls are 10 m off
  addBox(elsewhere, -10, -10, 15, 15);
  const auto points = pointsOfScan(elsewhere, expected.mean, random);
  const Match m = matcher.match(map, points, expected, kReach);
  EXPECT_FALSE(m.matched);
  EXPECT_EQ(m.pose.mean, expected.mean);
  EXPECT_EQ(m.pose.cov, expected.cov);
  EXPECT_FALSE(matcher.match(map, {}, expected, kReach).matched);
  EXPECT_FALSE(matcher.match(map, {{1, 1}, {2, 1}}, expected, kReach).matched);
  EXPECT_FALSE(matcher.match(LocalMap({}, 10), points, expected, kReach).matched);
}

TEST(ScanMatcher, IsVagueAlongACorridor)
{
  math::RandomStream random{4};
  const Walls corridor = {{{-50, 1}, {50, 1}}, {{-50, -1}, {50, -1}}};
  const Pose2D truth{0, 0, 0};
  const LocalMap map = mapOf(corridor, {{-0.5, 0, 0}, {0, 0.1, 0.1}}, random);
  const auto expected = around({0.1, 0.1, 0.1}, 0.2, 0.1);
  const Match m =
      ScanMatcher(kSettings).match(map, pointsOfScan(corridor, truth, random), expected, kReach);
  ASSERT_TRUE(m.matched);
  EXPECT_LT(std::sqrt(m.alone.cov(1, 1)), 0.03);
  EXPECT_LT(std::abs(m.alone.mean.y), 0.03);
  EXPECT_GT(std::sqrt(m.alone.cov(0, 0)), 0.15);  // as far as the walls' noise tells nothing
  EXPECT_GT(m.alone.cov(0, 0), 25 * m.alone.cov(1, 1));
  EXPECT_GT(std::sqrt(m.pose.cov(0, 0)), 0.1);  // so that odometry decides
  EXPECT_NEAR(m.pose.mean.x, 0.1, 0.1);
}

TEST(ScanMatcher, IsNotPulledByWhatMoved)
{
  math::RandomStream random{5};
  const LocalMap map = mapOf(room(), kFrom, random);
  const Pose2D truth{2.9, 2.0, 0.9};
  Walls busy = room();
  addBox(busy, 3.4, 3.4, 4.0, 3.9);
  addBox(busy, 2.0, 5.82, 5.0, 5.9);  // so near a wall that it is paired with it
  const auto points = pointsOfScan(busy, truth, random);
  const Match m = ScanMatcher(kSettings).match(
      map, points, around({truth.x + 0.1, truth.y, truth.phi + 0.1}, 0.1, 0.1), kReach);
  ASSERT_TRUE(m.matched);
  EXPECT_LT(m.explained, 0.9);
  EXPECT_LT(errorOf(m.alone.mean, truth).head<2>().norm(), 0.03);
  EXPECT_LT(std::abs(errorOf(m.alone.mean, truth)[2]), 0.01);
}

/// The covariance is honest, rather too large: a wall's spread counts beside the beam's.
TEST(ScanMatcher, ErrsAsItsCovarianceSays)
{
  constexpr int kRuns = 300;
  double nees = 0;
  for (int run = 0; run < kRuns; ++run)
  {
    math::RandomStream random{6, static_cast<std::uint64_t>(run)};
    const LocalMap map = mapOf(room(), kFrom, random);
    const Pose2D truth{2.5 + random.uniform(), 1.5 + random.uniform(), random.uniform(0, 1.5)};
    const auto points = pointsOfScan(room(), truth, random);
    const Pose2D start{truth.x + 0.1 * random.normal(), truth.y + 0.1 * random.normal(),
                       truth.phi + 0.05 * random.normal()};
    const Match m = ScanMatcher(kSettings).match(map, points, around(start, 1, 1), kReach);
    ASSERT_TRUE(m.matched) << run;
    nees += math::mahalanobisSquared(errorOf(m.alone.mean, truth), m.alone.cov) / kRuns;
  }
  EXPECT_GT(nees, 0.5) << "3 is ideal";
  EXPECT_LT(nees, 3.5);
}

/// An exhaustive search finds nothing better.
TEST(SearchWindow, FindsTheBestOfAllPoses)
{
  math::RandomStream random{7};
  const LocalMap map = mapOf(room(), kFrom, random);
  for (int run = 0; run < 20; ++run)
  {
    const Pose2D truth{2.5 + random.uniform(), 1.5 + random.uniform(), random.uniform(0, 1.5)};
    const auto points = pointsOfScan(room(), truth, random);
    SearchWindow window;
    window.centre = {truth.x + 0.3 * random.normal(), truth.y + 0.3 * random.normal(), truth.phi};
    window.radius = 0.6;
    window.turn = 0;
    window.positionStd = 1e6;
    window.headingStd = 1e6;
    double best = 0;
    for (int y = -12; y <= 12; ++y)
      for (int x = -12; x <= 12; ++x)
      {
        double sum = 0;
        for (const Point2D& p : points)
        {
          const auto c = map.cellOf(math::transform(window.centre, p));
          sum += map.field().bound(0, c[0] + x, c[1] + y);
        }
        best = std::max(best, sum / (LocalMap::kHit * static_cast<double>(points.size())));
      }
    const auto found = searchWindow(map, points, window, 0.1);
    ASSERT_TRUE(found) << run;
    EXPECT_NEAR(found->score, best, 1e-12) << run;
    EXPECT_FALSE(searchWindow(map, points, window, best + 1e-6)) << run;
  }
}
}  // namespace
}  // namespace slamot::scans
