#include "rbpf/SightingTracks.h"

#include <gtest/gtest.h>
#include <slamot/math/random.h>

#include "rbpf/LandmarkScan.h"

namespace slamot::filters::rbpf
{
namespace
{
const SightingTracks::Settings kSensor{0.02, 0.005};

Ray rayTo(const Pose2D& robot, const Point2D& p, double rangeError = 0, double bearingError = 0)
{
  const double dx = p.x - robot.x, dy = p.y - robot.y;
  return Ray::of(std::hypot(dx, dy) + rangeError,
                 math::wrapToPi(std::atan2(dy, dx) - robot.phi + bearingError), 0.2, 0.02);
}

/// Three posts a hand's breadth apart.
const std::vector<Point2D> kPosts{{4, 0}, {4, 0.2}, {4.15, 0.1}};
}  // namespace

TEST(SightingTracks, FollowNeighboursWhileTheRobotDrives)
{
  SightingTracks tracks(kSensor);
  math::RandomStream random{7};
  Pose2D robot{};
  std::vector<std::size_t> first;
  for (int k = 0; k < 100; ++k)
  {
    std::vector<Ray> rays;
    for (const Point2D& p : kPosts)
      rays.push_back(rayTo(robot, p, 0.01 * random.normal(), 0.002 * random.normal()));
    tracks.link(rays, 0.1 * k);
    std::vector<std::size_t> places{tracks.place(0), tracks.place(1), tracks.place(2)};
    if (k == 0) first = places;
    EXPECT_EQ(places, first) << k;
    EXPECT_EQ(tracks.hits(0), k + 1);
    const auto step = math::turnThenMove(0.2, k < 50 ? 0.3 : -0.4, 0.1, 0.01, 0.01);
    robot = math::compose(robot, step.mean);
    tracks.move(step);
  }
  EXPECT_EQ(tracks.capacity(), kPosts.size());
}

TEST(SightingTracks, AnUncertainTurnWidensWhereAThingIsExpected)
{
  for (const double omegaStd : {0.0, 0.1})
  {
    SightingTracks tracks(kSensor);
    tracks.link({rayTo({}, {4, 0})}, 0);
    tracks.move(math::turnThenMove(0, 0, 1, 0, omegaStd));
    tracks.link({rayTo({}, {4, 0.5})}, 1);  // 0.125 rad aside
    EXPECT_EQ(tracks.hits(0), omegaStd > 0 ? 2 : 1);
  }
}

TEST(SightingTracks, APauseEndsATrackAndItsPlaceIsGivenAnew)
{
  SightingTracks tracks(kSensor);
  tracks.link({rayTo({}, {4, 0})}, 0);
  tracks.link({rayTo({}, {4, 0})}, 1.9);
  EXPECT_EQ(tracks.hits(0), 2);
  tracks.link({rayTo({}, {4, 0})}, 4);
  EXPECT_EQ(tracks.hits(0), 1);
  EXPECT_EQ(tracks.capacity(), 1u);
}

/// A map of posts, all equally well known, and a scan of them from a robot at the origin.
class TrackMatching : public ::testing::Test
{
 protected:
  static Settings settings()
  {
    Settings s{};
    s.gates = {9.21, 23.0, 6.63, 19.5};
    s.association = Association::kNearest;
    s.newDensity = 1e-4;
    s.tracking = kSensor;
    return s;
  }

  void mapPosts(const std::vector<Point2D>& posts)
  {
    map.detach(pool.newToken());
    see(posts, 0);
    const std::vector<std::int32_t> all(posts.size(), kNew);
    for (std::size_t j = 0; j < posts.size(); ++j) slots.push_back(scan.newSlot(j));
    scan.apply(map, Eye({}), all, nullptr, 0);
    scan.finish({&all});
  }
  void see(const std::vector<Point2D>& points, double time, const Matrix3& cov = Matrix3::Zero())
  {
    seen = {};
    for (const Point2D& p : points)
    {
      const Ray r = rayTo({}, p);
      seen.sightings.push_back({r.range, r.bearing, 0.2, 0.02, core::kNoId});
    }
    scan.begin(&seen, time, {Pose2D{}}, Gaussian<Pose2D>{{}, cov});
  }
  double match(const Matrix3& root = Matrix3::Zero(), std::uint64_t seed = 1)
  {
    math::RandomStream random{seed};
    return scan.matchTracks(map, Eye({}), root, followed, random, scratch, matches);
  }
  /// The index in `posts` of what a sighting is taken for; -1: new, -2: not used.
  int postOf(std::size_t sighting) const
  {
    const auto it =
        std::find(slots.begin(), slots.end(), static_cast<std::uint32_t>(matches[sighting]));
    return matches[sighting] < 0 ? matches[sighting] : static_cast<int>(it - slots.begin());
  }
  /// log N(z - h; S) of a sighting at `at` of a post known as mapPosts() leaves it, at zero
  /// bearing.
  static double logLikelihood(const Point2D& post, const Point2D& at)
  {
    const double r = std::hypot(post.x, post.y), b = std::atan2(post.y, post.x);
    Matrix2 S = Matrix2::Zero();  // the map's part and the sighting's are alike
    S(0, 0) = 2 * 0.2 * 0.2;
    S(1, 1) = 2 * 0.02 * 0.02;
    const Vector2 nu(std::hypot(at.x, at.y) - r, std::atan2(at.y, at.x) - b);
    return -0.5 * (nu.dot(S.inverse() * nu) + std::log(S.determinant())) - std::log(math::kTwoPi);
  }

  Settings set = settings();
  maps::LandmarkPool pool{1};
  LandmarkScan scan{set, pool, 1};
  maps::LandmarkMap map;
  core::LandmarkScan seen;
  std::vector<std::uint32_t> slots;
  std::vector<std::int32_t> followed, matches;
  TrackScratch scratch;
};

TEST_F(TrackMatching, WaitsForASecondSightingAndThenKeepsTheLandmark)
{
  mapPosts({{4, 0}, {4, 0.6}});
  see({{4, 0.02}}, 10);
  match();
  EXPECT_EQ(postOf(0), kRejected);
  see({{4, 0.03}}, 10.1);
  match();
  ASSERT_EQ(postOf(0), 0);
  for (double y = 0.05; y < 0.5; y += 0.03)  // drifts until the other post is nearer
  {
    see({{4, y}}, 10.2 + y);
    EXPECT_EQ(match(), 0.0);
    EXPECT_EQ(postOf(0), 0) << y;
  }
}

TEST_F(TrackMatching, DrawsByLikelihoodAndPutsTheRestIntoTheWeight)
{
  const std::vector<Point2D> posts{{4, 0}, {4, 0.25}};
  const Point2D at{4.05, 0.1};
  mapPosts(posts);
  see({at}, 10);
  match();
  see({at}, 10.1);
  const double a = logLikelihood(posts[0], at), b = logLikelihood(posts[1], at),
               fresh = std::log(1e-4);
  const double total = std::log(std::exp(a) + std::exp(b) + std::exp(fresh));
  int first = 0;
  constexpr int kDraws = 4000;
  for (int k = 0; k < kDraws; ++k)
  {
    followed.assign(1, kNew);
    const double gain = match(Matrix3::Zero(), 100 + static_cast<std::uint64_t>(k));
    ASSERT_GE(postOf(0), kNew);
    first += postOf(0) == 0;
    EXPECT_NEAR(gain, total - (postOf(0) == 0 ? a : postOf(0) == 1 ? b : fresh), 1e-3);
  }
  const double share = std::exp(a - total);
  EXPECT_GT(share, 0.2);
  EXPECT_LT(share, 0.8);
  EXPECT_NEAR(first, kDraws * share, 4 * std::sqrt(kDraws * share * (1 - share)));
}

TEST_F(TrackMatching, AClearSightingPlacesThePoseForTheOthers)
{
  // The robot is 0.3 m to the right of where it thinks: the pair's left post seems to be between.
  const std::vector<Point2D> posts{{4, 0}, {4, 0.5}, {3, -3}};
  mapPosts(posts);
  Matrix3 root = Matrix3::Zero();
  root(1, 1) = 0.4;
  int alone = 0, together = 0;
  for (const bool withThird : {false, true})
    for (std::uint64_t k = 0; k < 200; ++k)
    {
      std::vector<Point2D> at{{4, 0.3}};
      if (withThird) at.push_back({3, -2.7});
      const double time = 10 + static_cast<double>(10 * k) + (withThird ? 5 : 0);
      see(at, time, root * root.transpose());
      match(root, k);
      see(at, time + 0.1, root * root.transpose());
      match(root, k);
      (withThird ? together : alone) += postOf(0) == 0;
      if (withThird)
      {
        EXPECT_EQ(postOf(1), 2);
      }
    }
  EXPECT_LT(alone, 150);
  EXPECT_GT(together, 190);
}

TEST_F(TrackMatching, OfTwoTracksOfOneLandmarkTheBetterKeepsIt)
{
  mapPosts({{4, 0}});
  const std::vector<Point2D> near{{4, 0.02}, {4, -0.08}};
  for (const std::size_t better : {0u, 1u})
  {
    const std::vector<Point2D> points{near[better], near[1 - better]};
    const double time = 10.0 * static_cast<double>(better + 1);
    for (const double later : {0.0, 0.1}) see(points, time + later), match();
    see(points, time + 0.2);
    followed.assign(4, static_cast<std::int32_t>(slots[0]));  // as if begun one without the other
    match();
    EXPECT_EQ(postOf(better), 0) << better;
    EXPECT_NE(matches[0], matches[1]) << better;
  }
}

TEST_F(TrackMatching, NeverTakesTwoSightingsForOneLandmark)
{
  mapPosts({{4, 0}});
  see({{4, -0.05}, {4, 0.05}}, 10);
  match();
  see({{4, -0.05}, {4, 0.05}}, 10.1);
  for (std::uint64_t k = 0; k < 50; ++k)
  {
    followed.assign(2, kNew);
    match(Matrix3::Zero(), k);
    EXPECT_NE(matches[0], matches[1]);
  }
}
}  // namespace slamot::filters::rbpf
