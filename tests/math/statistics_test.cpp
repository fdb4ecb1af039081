#include <gtest/gtest.h>
#include <slamot/math/statistics.h>

#include <cmath>
#include <limits>

namespace slamot::math
{
TEST(ChiSquareQuantile, EqualsTheClosedFormForTwoDegrees)
{
  for (const double p : {1e-6, 0.1, 0.5, 0.95, 0.99999})
    EXPECT_NEAR(chiSquareQuantile(p, 2), -2 * std::log1p(-p), 1e-9);
}

TEST(ChiSquareQuantile, EqualsTheTables)
{
  EXPECT_NEAR(chiSquareQuantile(0.95, 1), 3.841458820694124, 1e-12);
  EXPECT_NEAR(chiSquareQuantile(0.95, 3), 7.814727903251179, 1e-12);
  EXPECT_NEAR(chiSquareQuantile(0.005, 10), 2.155856481304, 1e-9);
}

TEST(ChiSquareQuantile, RefusesWhatHasNone)
{
  for (const double p : {0.0, 1.0, -0.1, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW((void)chiSquareQuantile(p, 2), std::domain_error) << p;
  EXPECT_THROW((void)chiSquareQuantile(0.5, 0), std::domain_error);
}

TEST(MeanInterval, IsStudents)
{
  const MeanInterval m = meanInterval({1, 2, 3, 4});
  EXPECT_DOUBLE_EQ(m.mean, 2.5);
  EXPECT_NEAR(m.std, std::sqrt(5.0 / 3), 1e-15);
  EXPECT_NEAR(m.halfWidth95, 3.182446305284263 * std::sqrt(5.0 / 12), 1e-12);
  EXPECT_EQ(m.count, 4);
}

TEST(MeanInterval, OfOneValueIsThatValueAndOfNoneIsNaN)
{
  const MeanInterval one = meanInterval({7});
  EXPECT_EQ(one.mean, 7);
  EXPECT_EQ(one.halfWidth95, 0);
  EXPECT_EQ(one.count, 1);
  const MeanInterval none = meanInterval({});
  EXPECT_TRUE(std::isnan(none.mean));
  EXPECT_EQ(none.count, 0);
}

TEST(MeanInterval, OfEqualValuesHasNoWidth)
{
  const MeanInterval m = meanInterval({2.5, 2.5, 2.5, 2.5});
  EXPECT_EQ(m.mean, 2.5);
  EXPECT_EQ(m.std, 0);
  EXPECT_EQ(m.halfWidth95, 0);
}

TEST(Quantile, InterpolatesBetweenSortedValues)
{
  EXPECT_EQ(quantile({4, 1, 3, 2}, 0), 1);
  EXPECT_EQ(quantile({4, 1, 3, 2}, 1), 4);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({10, 0}, 0.25), 2.5);
  EXPECT_EQ(quantile({7}, 0.3), 7);
}

TEST(Quantile, OfNothingIsNaN)
{
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}
}  // namespace slamot::math
