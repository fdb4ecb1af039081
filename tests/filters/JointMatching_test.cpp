#include "rbpf/JointMatching.h"

#include <gtest/gtest.h>
#include <slamot/math/random.h>
#include <slamot/math/statistics.h>

#include <Eigen/Cholesky>

#include <set>

// Against what the definitions say, with all of a scan's covariance in one matrix.
namespace slamot::filters::rbpf
{
namespace
{
using math::RandomStream;

struct Scan
{
  Settings settings{};
  Matrix3 root = Matrix3::Zero();
  std::vector<double> logNew;
  std::vector<PossiblePair> pairs;
};

/// Landmarks and sightings so close together that which is of which is in doubt.
Scan draw(RandomStream& random, Association rule, std::size_t sightings, std::size_t landmarks)
{
  Scan s;
  s.settings.association = rule;
  s.settings.gateProbability = 0.95;
  const double inner = math::chiSquareQuantile(0.95, 2);
  s.settings.gates = {inner, math::chiSquareQuantile(0.9999, 2), 4, 15};
  for (int i = 0; i < 3; ++i) s.root.row(i) = (i < 2 ? 0.3 : 0.05) * random.normal3().transpose();
  const Matrix3 cov = s.root * s.root.transpose();
  const Vector3 off = s.root * random.normal3();
  const Eye eye(Pose2D(0, 0, 0)), truth(Pose2D(off[0], off[1], off[2]));
  std::vector<Point2D> places;
  for (std::size_t k = 0; k < landmarks; ++k)
    places.emplace_back(5 + random.uniform(0, 1.5), random.uniform(-0.8, 0.8));
  for (std::size_t j = 0; j < sightings; ++j)
  {
    const Point2D& p = places[j % landmarks];
    const double r = std::hypot(p.x - truth.x, p.y - truth.y) + 0.1 * random.normal();
    const double b = std::atan2(p.y - truth.y, p.x - truth.x) - truth.phi + 0.02 * random.normal();
    s.logNew.push_back(random.uniform(-4, 0));
    for (std::size_t k = 0; k < landmarks; ++k)
    {
      Innovation o;
      if (!innovate(eye, Ray::of(r, b, 0.1, 0.02), places[k].x, places[k].y, 0.02, 0.005, 0.03, o))
        continue;
      const double d2 = withPose(o, cov).d2;
      if (d2 <= s.settings.gates.outer)
        s.pairs.push_back(
            {static_cast<std::int32_t>(j), static_cast<std::int32_t>(100 + k), o, d2});
    }
  }
  return s;
}

/// Joint distance and log density of a set of pairs.
std::pair<double, double> jointly(const Scan& s, const std::vector<std::size_t>& set)
{
  const auto n = static_cast<Eigen::Index>(2 * set.size());
  if (n == 0) return {0, 0};
  Eigen::MatrixXd J(n, 3), S = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd nu(n);
  for (Eigen::Index i = 0; i < n; i += 2)
  {
    const Innovation& o = s.pairs[set[static_cast<std::size_t>(i / 2)]].innovation;
    J.middleRows<2>(i) << -o.h11, -o.h12, o.turnR, -o.h21, -o.h22, o.turnB;
    S.block<2, 2>(i, i) << o.s11, o.s12, o.s12, o.s22;
    nu.segment<2>(i) << o.nuR, o.nuB;
  }
  S += J * s.root * s.root.transpose() * J.transpose();
  const Eigen::LLT<Eigen::MatrixXd> llt(S);
  const double d2 = llt.matrixL().solve(nu).squaredNorm();
  const Eigen::MatrixXd L = llt.matrixL();
  return {d2, -0.5 * d2 - L.diagonal().array().log().sum() -
                  0.5 * static_cast<double>(n) * std::log(math::kTwoPi)};
}

/// f(pairs) for each way to give sightings different landmarks or none.
template <class F>
void forEachWay(const Scan& s, std::size_t sighting, std::vector<std::size_t>& set, const F& f)
{
  if (sighting == s.logNew.size()) return f(set);
  forEachWay(s, sighting + 1, set, f);
  for (std::size_t p = 0; p < s.pairs.size(); ++p)
  {
    if (s.pairs[p].sighting != static_cast<std::int32_t>(sighting)) continue;
    const bool taken =
        std::any_of(set.begin(), set.end(),
                    [&](std::size_t q) { return s.pairs[q].thing == s.pairs[p].thing; });
    if (taken) continue;
    set.push_back(p);
    forEachWay(s, sighting + 1, set, f);
    set.pop_back();
  }
}

std::vector<std::int32_t> matched(const Scan& s)
{
  JointMatching matching(s.settings);
  matching.reserve(s.logNew.size());
  JointMatching::Scratch scratch;
  scratch.pairs = s.pairs;
  std::vector<std::int32_t> out;
  matching.match(s.root, s.logNew, scratch, out);
  return out;
}
std::vector<std::size_t> pairsOf(const Scan& s, const std::vector<std::int32_t>& matches)
{
  std::vector<std::size_t> out;
  for (std::size_t p = 0; p < s.pairs.size(); ++p)
    if (matches[static_cast<std::size_t>(s.pairs[p].sighting)] == s.pairs[p].thing)
      out.push_back(p);
  return out;
}
double scoreOf(const Scan& s, const std::vector<std::size_t>& set)
{
  double sum = jointly(s, set).second;
  std::set<std::int32_t> seen, having;
  for (const auto& p : s.pairs) having.insert(p.sighting);
  for (const std::size_t p : set) seen.insert(s.pairs[p].sighting);
  for (const std::int32_t j : having)
    if (!seen.count(j)) sum += s.logNew[static_cast<std::size_t>(j)];
  return sum;
}
}  // namespace

TEST(JointMatching, LikelihoodIsThatOfTheBestOfAllWays)
{
  int unlikeSequential = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed)
  {
    RandomStream random{seed};
    Scan s = draw(random, Association::kLikelihood, 1 + seed % 4, 1 + seed % 3);
    double best = -1e300;
    std::vector<std::size_t> set;
    forEachWay(s, 0, set, [&](const auto& way) { best = std::max(best, scoreOf(s, way)); });
    EXPECT_NEAR(scoreOf(s, pairsOf(s, matched(s))), best, 1e-8) << "seed " << seed;
    s.settings.association = Association::kSequential;
    unlikeSequential += scoreOf(s, pairsOf(s, matched(s))) < best - 1e-6;
  }
  EXPECT_GT(unlikeSequential, 20);  // else the cases show nothing
}

TEST(JointMatching, CompatibilityIsTheLargestCompatibleSetAndItsNearest)
{
  int unlikeSequential = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed)
  {
    RandomStream random{seed};
    Scan s = draw(random, Association::kJoint, 1 + seed % 4, 1 + seed % 3);
    std::size_t most = 0;
    double nearest = 0;
    std::vector<std::size_t> set;
    forEachWay(s, 0, set,
               [&](const auto& way)
               {
                 const double d2 = jointly(s, way).first;
                 const double gate =
                     way.empty() ? 0 : math::chiSquareQuantile(0.95, 2.0 * double(way.size()));
                 const bool each = std::all_of(way.begin(), way.end(),
                                               [&](std::size_t p)
                                               { return s.pairs[p].d2 <= s.settings.gates.inner; });
                 if (!each || d2 > gate || way.size() < most) return;
                 if (way.size() > most || d2 < nearest) nearest = d2;
                 most = way.size();
               });
    const auto found = pairsOf(s, matched(s));
    EXPECT_EQ(found.size(), most) << "seed " << seed;
    EXPECT_NEAR(jointly(s, found).first, nearest, 1e-8) << "seed " << seed;
    s.settings.association = Association::kSequential;
    unlikeSequential += pairsOf(s, matched(s)).size() < most;
  }
  EXPECT_GT(unlikeSequential, 5);
}

TEST(JointMatching, SequentialTakesTheNearestGivenThoseBefore)
{
  for (std::uint64_t seed = 1; seed <= 100; ++seed)
  {
    RandomStream random{seed};
    const Scan s = draw(random, Association::kSequential, 4, 3);
    std::vector<std::size_t> chosen;
    for (std::int32_t j = 0; j < 4; ++j)
    {
      double least = 1e300;
      std::size_t next = s.pairs.size();
      for (std::size_t p = 0; p < s.pairs.size(); ++p)
      {
        const bool taken =
            std::any_of(chosen.begin(), chosen.end(),
                        [&](std::size_t q) { return s.pairs[q].thing == s.pairs[p].thing; });
        if (s.pairs[p].sighting != j || taken) continue;
        auto with = chosen;
        with.push_back(p);
        const auto [d2, log] = jointly(s, with);
        const auto [d2Before, logBefore] = jointly(s, chosen);
        const double cost = -2 * (log - logBefore);
        if (d2 - d2Before > s.settings.gates.inner ||
            d2 > math::chiSquareQuantile(0.95, 2.0 * double(with.size())) || cost >= least)
          continue;
        least = cost;
        next = p;
      }
      if (next < s.pairs.size()) chosen.push_back(next);
    }
    auto found = pairsOf(s, matched(s));
    std::sort(found.begin(), found.end(),
              [&](std::size_t a, std::size_t b)
              { return s.pairs[a].sighting < s.pairs[b].sighting; });
    EXPECT_EQ(found, chosen) << "seed " << seed;
  }
}

TEST(JointMatching, AnUnpairedSightingIsNewOnlyIfNothingSpeaksForIt)
{
  Scan s;
  s.settings.association = Association::kJoint;
  s.settings.gateProbability = 0.99;
  s.settings.gates = {9.2, 23, 6.6, 19};
  Innovation o;
  ASSERT_TRUE(innovate(Eye(Pose2D{}), Ray::of(10.8, 0, 0.1, 0.02), 10, 0, 0.02, 0, 0.02, o));
  ASSERT_GT(o.d2, 9.2);
  s.pairs = {{0, 5, o, o.d2}};
  s.logNew = {-3, -3};
  EXPECT_EQ(matched(s), (std::vector<std::int32_t>{kRejected, kNew}));
  s.settings.association = Association::kLikelihood;
  EXPECT_EQ(matched(s), (std::vector<std::int32_t>{kNew, kNew}));
}

// 200 sightings of 2000 landmarks, every one of them in doubt: exact search would take for ever.
TEST(JointMatching, EndsOnScansThatNobodyCouldSearch)
{
  for (const Association rule :
       {Association::kSequential, Association::kJoint, Association::kLikelihood})
  {
    RandomStream random{9};
    const Scan s = draw(random, rule, 200, 2000);
    ASSERT_GT(s.pairs.size(), 200u * 500u);
    const auto found = pairsOf(s, matched(s));
    EXPECT_GT(found.size(), 100u);
    std::set<std::int32_t> things;
    for (const std::size_t p : found) EXPECT_TRUE(things.insert(s.pairs[p].thing).second);
  }
}
}  // namespace slamot::filters::rbpf
