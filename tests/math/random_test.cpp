#include <gtest/gtest.h>
#include <slamot/math/random.h>
#include <slamot/math/statistics.h>

#include <algorithm>
#include <set>
#include <vector>

namespace slamot::math
{
namespace
{
/// Whether counts of equally likely cells are as chance makes them, at 1e-4 on either side: too
/// even is as suspect as too uneven.
void expectUniform(const std::vector<int>& counts)
{
  double n = 0, chiSquare = 0;
  for (const int c : counts) n += c;
  const double expected = n / static_cast<double>(counts.size());
  for (const int c : counts) chiSquare += (c - expected) * (c - expected) / expected;
  const auto dof = static_cast<double>(counts.size() - 1);
  EXPECT_LT(chiSquare, chiSquareQuantile(1 - 1e-4, dof));
  EXPECT_GT(chiSquare, chiSquareQuantile(1e-4, dof));
}

std::size_t cell(double u, std::size_t cells)
{
  return static_cast<std::size_t>(u * static_cast<double>(cells));
}

/// The standard normal distribution function.
double phi(double x)
{
  return 0.5 * std::erfc(-x / std::sqrt(2.0));
}
}  // namespace

TEST(RandomStream, IsFixedByItsKeys)
{
  RandomStream a{1, 2, 3}, b{1, 2, 3};
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a(), b());
}

TEST(RandomStream, DiffersByEveryKeyTheirOrderAndNumber)
{
  std::set<std::uint64_t> firsts;
  const std::vector<RandomStream> streams = {{},     {0},       {1},    {0, 0}, {0, 1}, {1, 0},
                                             {1, 1}, {0, 0, 0}, {1, 2}, {2, 1}, {3},    {~0ull}};
  for (RandomStream s : streams) firsts.insert(s());
  EXPECT_EQ(firsts.size(), streams.size());
}

// The numbers are part of every golden result: they may not change with a compiler or a library.
TEST(RandomStream, IsSplitMix64)
{
  RandomStream random{};
  EXPECT_EQ(random(), 0xE220A8397B1DCDAFull);  // of Vigna's splitmix64.c with seed 0
  EXPECT_EQ(random(), 0x6E789E6AA1B965F4ull);
  EXPECT_EQ(random(), 0x06C45D188009454Full);
}

TEST(RandomStream, UniformIsUniform)
{
  RandomStream random{1};
  std::vector<int> counts(100);
  for (int i = 0; i < 100000; ++i) ++counts.at(cell(random.uniform(), 100));
  expectUniform(counts);
}

TEST(RandomStream, UniformStaysInItsRange)
{
  RandomStream random{2};
  for (int i = 0; i < 10000; ++i)
  {
    const double u = random.uniform(-3, -1);
    EXPECT_TRUE(u >= -3 && u < -1);
  }
}

// Neighbouring keys (particles of one step, steps of one particle) are used side by side.
TEST(RandomStream, StreamsOfNeighbouringKeysAreIndependent)
{
  constexpr std::size_t kCells = 12;
  constexpr std::uint64_t kDraws = 60000;
  std::vector<int> last(kCells * kCells), first(kCells * kCells), within(kCells * kCells);
  const auto at = [](double a, double b) { return cell(a, kCells) * kCells + cell(b, kCells); };
  for (std::uint64_t i = 0; i < 2 * kDraws; i += 2)
  {
    RandomStream a{7, 3, i}, b{7, 3, i + 1}, c{7, i, 3}, d{7, i + 1, 3};
    const double ua = a.uniform();
    ++last.at(at(ua, b.uniform()));
    ++first.at(at(c.uniform(), d.uniform()));
    ++within.at(at(ua, a.uniform()));
  }
  expectUniform(last);
  expectUniform(first);
  expectUniform(within);
}

TEST(RandomStream, EveryBitIsFair)
{
  constexpr int kDraws = 40000;
  std::vector<int> ones(64);
  for (std::uint64_t i = 0; i < kDraws; ++i)
  {
    const std::uint64_t x = RandomStream{i}();
    for (std::size_t b = 0; b < 64; ++b) ones[b] += static_cast<int>(x >> b & 1);
  }
  double chiSquare = 0;
  for (const int n : ones) chiSquare += std::pow(n - kDraws / 2.0, 2) / (kDraws / 4.0);
  EXPECT_LT(chiSquare, chiSquareQuantile(1 - 1e-4, 64));
  EXPECT_GT(chiSquare, chiSquareQuantile(1e-4, 64));
}

TEST(RandomStream, NormalHasTheNormalDistribution)
{
  RandomStream random{3};
  std::vector<int> counts(200);
  double squares = 0, lagged = 0, before = 0;
  constexpr int kDraws = 200000;
  for (int i = 0; i < kDraws; ++i)
  {
    const double x = random.normal();
    ++counts.at(std::min<std::size_t>(199, cell(phi(x), 200)));
    squares += x * x;
    lagged += x * before;
    before = x;
  }
  expectUniform(counts);
  EXPECT_LT(squares, chiSquareQuantile(1 - 1e-4, kDraws));
  EXPECT_GT(squares, chiSquareQuantile(1e-4, kDraws));
  // The spare deviate of a pair must not depend on the other.
  EXPECT_NEAR(lagged / std::sqrt(double(kDraws)), 0, 4);
}

TEST(RandomStream, TakesThreeNormalDeviatesInTheirOrder)
{
  RandomStream a{4}, b{4};
  const Vector3 v = a.normal3();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(v[i], b.normal());
}

TEST(RandomStream, PoissonCountsHaveTheirDistribution)
{
  for (const double mean : {0.5, 4.0})
  {
    RandomStream random{5, static_cast<std::uint64_t>(mean)};
    constexpr int kDraws = 40000, kMost = 10;
    std::vector<int> counts(kMost + 1);
    for (int i = 0; i < kDraws; ++i)
      ++counts[static_cast<std::size_t>(std::min(random.poisson(mean), kMost))];
    double chiSquare = 0, dof = 0, p = std::exp(-mean), restP = 1;
    int rest = kDraws;
    for (int k = 0; k < kMost && kDraws * p >= 5; p *= mean / ++k)
    {
      const int n = counts[static_cast<std::size_t>(k)];
      chiSquare += std::pow(n - kDraws * p, 2) / (kDraws * p);
      rest -= n;
      restP -= p;
      ++dof;
    }
    chiSquare += std::pow(rest - kDraws * restP, 2) / (kDraws * restP);
    EXPECT_LT(chiSquare, chiSquareQuantile(1 - 1e-4, dof)) << mean;
  }
  EXPECT_EQ(RandomStream{6}.poisson(0), 0);
}
}  // namespace slamot::math
