#include "ekf/JointCompatibility.h"

#include "dense.h"

#include <slamot/math/statistics.h>

#include <functional>

namespace slamot::filters::ekf
{
namespace
{
/// Joint distance of pairs, from the full matrices.
double jointDistance(const Belief& belief, const std::vector<PossiblePair>& pairs,
                     const std::vector<int>& chosen)
{
  std::vector<SightingRows> rows;
  for (const int c : chosen) rows.push_back(pairs[static_cast<std::size_t>(c)].rows);
  if (rows.empty()) return 0;
  const Eigen::MatrixXd H = denseRows(rows, belief.P().size());
  Eigen::MatrixXd S = H * dense(belief.P()) * H.transpose();
  Eigen::VectorXd nu(H.rows());
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const auto i = static_cast<Eigen::Index>(2 * k);
    S.diagonal().segment<2>(i) += rows[k].variance;
    nu.segment<2>(i) = rows[k].innovation;
  }
  return nu.dot(S.inverse() * nu);
}

/// The best set by trying all.
std::vector<int> byTryingAll(const Belief& belief, const std::vector<PossiblePair>& pairs,
                             double probability)
{
  std::vector<int> best, chosen;
  double bestD2 = 0;
  const std::function<void(std::size_t)> next = [&](std::size_t i)
  {
    if (i == pairs.size())
    {
      const double d2 = jointDistance(belief, pairs, chosen);
      if (!chosen.empty() && d2 > math::chiSquareQuantile(probability, 2.0 * double(chosen.size())))
        return;
      if (chosen.size() > best.size() || (chosen.size() == best.size() && d2 < bestD2))
        best = chosen, bestD2 = d2;
      return;
    }
    next(i + 1);
    for (const int c : chosen)
      if (pairs[static_cast<std::size_t>(c)].sighting == pairs[i].sighting ||
          pairs[static_cast<std::size_t>(c)].thing == pairs[i].thing)
        return;
    chosen.push_back(static_cast<int>(i));
    next(i + 1);
    chosen.pop_back();
  };
  next(0);
  return best;
}
}  // namespace

TEST(JointCompatibility, FindsWhatTryingAllFinds)
{
  int partly = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
  {
    math::RandomStream random{seed};
    Belief belief(1, 4);
    belief.set(0, randomMatrix(3, 1, random), randomCov(3, random));
    for (int k = 0; k < 4; ++k)
      belief.addLandmark(0, {{0, 0}, 0.2 * randomCov(2, random)}, randomMatrix(2, 3, random));
    std::vector<PossiblePair> pairs;
    for (int sighting = 0; sighting < 4; ++sighting)
      for (int thing = 0; thing < 4; ++thing)
      {
        if (random.uniform() < 0.4) continue;
        PossiblePair pair{sighting, thing, randomRows(0, belief.landmark(thing), random), 0};
        pair.rows.innovation *= 4;
        pair.rows.variance *= 0.3;
        pairs.push_back(pair);
      }
    const auto expected = byTryingAll(belief, pairs, 0.95);
    EXPECT_EQ(jointlyCompatible(belief, pairs, 0.95), expected) << seed;
    partly += !expected.empty() && expected.size() < 4;
  }
  EXPECT_GT(partly, 10);
}

// Two landmarks, one metre apart, both off by a metre as an odometry error makes them: each alone
// is nearer to the other's, together they are not.
TEST(JointCompatibility, TellsACommonErrorFromAWrongPair)
{
  Belief belief(1, 4);
  belief.set(0, Vector3(0, 0, 0), Vector3(1, 1, 1e-6).asDiagonal().toDenseMatrix());
  std::vector<PossiblePair> pairs;
  for (int k = 0; k < 2; ++k)
    belief.addLandmark(0, {{double(k), 5}, 1e-4 * Matrix2::Identity()},
                       Eigen::Matrix<double, 2, 3>::Zero());
  const auto pair = [&](int sighting, int thing, double off)
  {
    SightingRows rows;
    rows.robot = 0;
    rows.object = belief.landmark(thing);
    rows.byObject.setIdentity();
    rows.byRobot << -1, 0, 0, 0, -1, 0;
    rows.innovation << off, 0;
    rows.variance << 1e-4, 1e-4;
    pairs.push_back({sighting, thing, rows, off * off});
  };
  pair(0, 0, -0.9), pair(0, 1, -1.9);  // seen 0.9 m to the left of the first
  pair(1, 0, 0.1), pair(1, 1, -0.9);   // and 0.1 m to its right, which is 0.9 m left of the second
  EXPECT_EQ(jointlyCompatible(belief, pairs, 0.99), (std::vector<int>{0, 3}));
}

TEST(JointCompatibility, EndsWhenItsStepsAreUsedUp)
{
  math::RandomStream random{1};
  Belief belief(1, 4);
  belief.set(0, Vector3::Zero(), Eigen::MatrixXd::Identity(3, 3));
  std::vector<PossiblePair> pairs;
  for (int k = 0; k < 12; ++k)
    belief.addLandmark(0, {{0, 0}, Matrix2::Identity()}, randomMatrix(2, 3, random));
  for (int sighting = 0; sighting < 12; ++sighting)
    for (int thing = 0; thing < 12; ++thing)
      pairs.push_back({sighting, thing, randomRows(0, belief.landmark(thing), random), 0});
  EXPECT_LE(jointlyCompatible(belief, pairs, 0.99, 1000).size(), 12u);
}
}  // namespace slamot::filters::ekf
