#include <slamot/models/NoiseLaw.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace slamot::models
{
namespace
{
using Tail = NoiseLaw::Tail;

/// Of two coordinates with R = I, at squared distance q.
double density(const NoiseLaw& law, double q)
{
  double sum = 0;
  for (const auto& c : law.components()) sum += c.weight * std::exp(-0.5 * q / c.factor) / c.factor;
  return sum / math::kTwoPi;
}

/// The tails themselves, with scale 1.
double exact(Tail tail, double q)
{
  if (tail == Tail::kStudent) return std::pow(1 + q / 2, -2) / math::kTwoPi;  // 2 degrees
  if (tail == Tail::kLaplace) return std::cyl_bessel_k(0.0, std::sqrt(2 * q)) / math::kPi;
  return std::exp(-0.5 * q) / math::kTwoPi;
}

class NoiseLawOf : public testing::TestWithParam<Tail>
{
};
INSTANTIATE_TEST_SUITE_P(Tails, NoiseLawOf,
                         testing::Values(Tail::kStudent, Tail::kGaussian, Tail::kLaplace));

TEST_P(NoiseLawOf, SumOfGaussiansIsTheLaw)
{
  const NoiseLaw law({1, GetParam(), 3, 2});
  const double most = GetParam() == Tail::kStudent ? 2500 : 25;
  for (double q = 0.1; q <= most; q *= 1.3)
    EXPECT_NEAR(density(law, 9 * q) * 9 / exact(GetParam(), q), 1, 0.15) << "q = " << q;
}

TEST_P(NoiseLawOf, WeightsSumToOneByRisingFactors)
{
  const NoiseLaw law({0.3, GetParam(), 3, 2});
  double sum = 0, last = 0;
  for (const auto& c : law.components())
  {
    sum += c.weight;
    EXPECT_GT(c.weight, 0);
    EXPECT_GT(c.factor, last);
    last = c.factor;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_EQ(law.widest(), last);
}

// The part of draws beyond a distance against the exact tail's: P(|w| > r) in two dimensions.
TEST_P(NoiseLawOf, DrawsAreOfTheLaw)
{
  const NoiseLaw law({0.3, GetParam(), 3, 2});
  math::RandomStream random{7};
  constexpr int kDraws = 100000;
  const double r2 = 25 * 9;
  int beyond = 0;
  for (int i = 0; i < kDraws; ++i)
  {
    const double f = law.drawFactor(random), x = random.normal(), y = random.normal();
    beyond += f * (x * x + y * y) > r2;
  }
  double expected = 0;  // by the trapezium rule over the radius
  for (double r = 5; r < 5000; r *= 1.001)
  {
    const double middle = r * 1.0005;
    expected += exact(GetParam(), middle * middle) * math::kTwoPi * middle * 0.001 * r;
  }
  expected = 0.3 * expected + 0.7 * std::exp(-0.5 * r2);
  const double std = std::sqrt(expected / kDraws);
  EXPECT_NEAR(static_cast<double>(beyond) / kDraws, expected, 4 * std + 1e-6);
}

TEST(NoiseLaw, WithoutGlintIsNormal)
{
  const NoiseLaw law({0, Tail::kStudent, 3, 2});
  ASSERT_EQ(law.components().size(), 1u);
  EXPECT_EQ(law.components()[0].weight, 1);
  EXPECT_EQ(law.components()[0].factor, 1);
  math::RandomStream random{1};
  for (int i = 0; i < 100; ++i) EXPECT_EQ(law.drawFactor(random), 1);
}

TEST(NoiseLaw, RefusesWhatIsNoLaw)
{
  EXPECT_THROW(NoiseLaw({-0.1, Tail::kStudent, 3, 2}), std::domain_error);
  EXPECT_THROW(NoiseLaw({1.1, Tail::kStudent, 3, 2}), std::domain_error);
  EXPECT_THROW(NoiseLaw({0.1, Tail::kStudent, 0, 2}), std::domain_error);
  EXPECT_THROW(NoiseLaw({0.1, Tail::kStudent, 3, std::nan("")}), std::domain_error);
}
}  // namespace
}  // namespace slamot::models
