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
        EXPECT_NEAR(ospa(x, y, c), bruteForceOspa(x, y, c), 1e-12);
      }
}

TEST(Ospa, OfOneEmptySetIsTheCutoff)
{
  EXPECT_DOUBLE_EQ(ospa({}, {{1, 2}}, 0.7), 0.7);
  EXPECT_DOUBLE_EQ(ospa({}, {}, 0.7), 0.0);
}
}  // namespace slamot::eval
