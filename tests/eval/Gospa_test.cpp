#include <gtest/gtest.h>
#include <slamot/eval/Gospa.h>
#include <slamot/math/random.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace slamot::eval
{
namespace
{
std::vector<Point2D> randomPoints(math::RandomStream& random, int count)
{
  std::vector<Point2D> out;
  for (int i = 0; i < count; ++i) out.emplace_back(random.uniform(0, 3), random.uniform(0, 3));
  return out;
}

// The definition: over all partial pairings, squared distances and c²/2 for each point left alone.
double bruteForceGospa(const std::vector<Point2D>& x, const std::vector<Point2D>& y, double c)
{
  std::vector<bool> used(y.size(), false);
  const std::function<double(std::size_t)> best = [&](std::size_t i)
  {
    if (i == x.size()) return c * c / 2 * double(std::count(used.begin(), used.end(), false));
    double least = c * c / 2 + best(i + 1);
    for (std::size_t j = 0; j < y.size(); ++j)
    {
      if (used[j]) continue;
      used[j] = true;
      least = std::min(least, (x[i] - y[j]).sqrNorm() + best(i + 1));
      used[j] = false;
    }
    return least;
  };
  return std::sqrt(best(0));
}

// The definition: over all ways to pair the fewer with the more.
double bruteForceOspa(std::vector<Point2D> few, std::vector<Point2D> many, double c)
{
  if (few.size() > many.size()) std::swap(few, many);
  if (many.empty()) return 0;
  std::vector<std::size_t> order(many.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  double least = std::numeric_limits<double>::infinity();
  do
  {
    double sum = c * c * double(many.size() - few.size());
    for (std::size_t i = 0; i < few.size(); ++i)
      sum += std::pow(std::min(c, (few[i] - many[order[i]]).norm()), 2);
    least = std::min(least, sum);
  } while (std::next_permutation(order.begin(), order.end()));
  return std::sqrt(least / double(many.size()));
}
}  // namespace

TEST(Gospa, EqualsBruteForceOverAllPairings)
{
  math::RandomStream random{2};
  for (int m = 0; m <= 5; ++m)
    for (int n = 0; n <= 5; ++n)
      for (const double c : {0.3, 1.0, 10.0})
      {
        const auto x = randomPoints(random, m), y = randomPoints(random, n);
        const Gospa g = gospa(x, y, c);
        EXPECT_NEAR(g.total, bruteForceGospa(x, y, c), 1e-12);
        EXPECT_NEAR(g.total * g.total, g.localisation + g.missed + g.falseOnes, 1e-12);
        EXPECT_DOUBLE_EQ(g.missed, c * c / 2 * double(y.size() - g.pairs.size()));
        EXPECT_DOUBLE_EQ(g.falseOnes, c * c / 2 * double(x.size() - g.pairs.size()));
      }
}

// Points in a few heaps far apart, some of which share a side of the grid: groups must not lose
// pairs, nor make ones.
TEST(Gospa, EqualsBruteForceWherePointsLieInGroups)
{
  math::RandomStream random{4};
  for (int trial = 0; trial < 300; ++trial)
  {
    std::vector<Point2D> x, y;
    for (auto* set : {&x, &y})
      for (int i = random.poisson(3); i > 0 && set->size() < 6; --i)
      {
        const double heap = std::floor(random.uniform(-2, 2));
        set->emplace_back(3 * heap + random.uniform(-1, 1), random.uniform(-1, 1));
      }
    for (const double c : {0.2, 1.0, 2.5})
    {
      const Gospa g = gospa(x, y, c);
      EXPECT_NEAR(g.total, bruteForceGospa(x, y, c), 1e-12) << trial << " c " << c;
      EXPECT_NEAR(g.ospa, bruteForceOspa(x, y, c), 1e-12) << trial << " c " << c;
      EXPECT_EQ(g.estimated, x.size());
      EXPECT_EQ(g.truly, y.size());
      for (const auto& [i, j] : g.pairs) EXPECT_LT((x[i] - y[j]).norm(), c);
    }
  }
}

TEST(Gospa, OfManyPointsIsThatOfItsParts)
{
  math::RandomStream random{5};
  std::vector<Point2D> x, y;
  double squares = 0;
  // 20 000 pairs 10 m apart, each 0.5 m or 3 m long: the long ones are no pairs.
  for (int i = 0; i < 20'000; ++i)
  {
    y.emplace_back(10.0 * (i % 200) - 1000, 10.0 * (i / 200));  // NOLINT: whole rows
    const double a = random.uniform(0, math::kTwoPi), d = i % 4 == 0 ? 3 : 0.5;
    x.emplace_back(y.back().x + d * std::cos(a), y.back().y + d * std::sin(a));
    squares += i % 4 == 0 ? 2 * 2 * 2 / 2.0 : 0.25;
  }
  const Gospa g = gospa(x, y, 2);
  EXPECT_EQ(g.pairs.size(), 15'000u);
  EXPECT_NEAR(g.total * g.total, squares, 1e-6);
  EXPECT_NEAR(g.missed, 5000 * 2.0, 1e-9);
  EXPECT_NEAR(g.ospa * g.ospa, (15'000 * 0.25 + 5000 * 4) / 20'000, 1e-9);
}

TEST(Gospa, RefusesWhatIsNotFinite)
{
  EXPECT_THROW((void)gospa({{std::nan(""), 0}}, {{1, 0}}, 1), std::domain_error);
  EXPECT_THROW((void)gospa({{0, 0}}, {{0, 1e300}}, 1), std::domain_error);
}

TEST(Gospa, PairsNothingAtTheCutoff)
{
  EXPECT_TRUE(gospa({{0, 0}}, {{1, 0}}, 1.0).pairs.empty());
  EXPECT_EQ(gospa({{0, 0}}, {{0.999, 0}}, 1.0).pairs.size(), 1u);
}

TEST(Ospa, EqualsBruteForceOverAllPermutations)
{
  math::RandomStream random{3};
  for (int m = 0; m <= 5; ++m)
    for (int n = 0; n <= 5; ++n)
      for (const double c : {0.3, 1.0, 10.0})
      {
        const auto x = randomPoints(random, m), y = randomPoints(random, n);
        EXPECT_NEAR(gospa(x, y, c).ospa, bruteForceOspa(x, y, c), 1e-12);
      }
}

TEST(Ospa, OfOneEmptySetIsTheCutoff)
{
  EXPECT_DOUBLE_EQ(gospa({}, {{1, 2}}, 0.7).ospa, 0.7);
  EXPECT_DOUBLE_EQ(gospa({}, {}, 0.7).ospa, 0.0);
}
}  // namespace slamot::eval
