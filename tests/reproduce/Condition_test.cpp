#include <gtest/gtest.h>
#include <slamot/reproduce/Condition.h>

#include <stdexcept>

namespace slamot::reproduce::test
{
namespace
{
void expectError(const std::string& text, const std::string& part)
{
  try
  {
    (void)parseCondition(text);
    ADD_FAILURE() << text << " was taken";
  }
  catch (const std::invalid_argument& e)
  {
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << text << ": " << e.what();
  }
}
}  // namespace

TEST(Condition, ReadsTermsWithTheirCells)
{
  const Condition c = parseCondition("robot_mean_m(gm-phd, world=0.3 m/s 3 deg; 1 m, n=10) < 1.5");
  ASSERT_EQ(c.sum.size(), 1u);
  EXPECT_EQ(c.sum[0].metric, "robot_mean_m");
  EXPECT_EQ(c.sum[0].method, "gm-phd");
  EXPECT_EQ(c.sum[0].cell.at("world"), "0.3 m/s 3 deg; 1 m");
  EXPECT_EQ(c.sum[0].cell.at("n"), "10");
  EXPECT_TRUE(c.divisor.empty());
  EXPECT_EQ(c.bound.kind, Bound::Kind::kBelow);
  EXPECT_EQ(c.bound.high, 1.5);
}

TEST(Condition, ReadsRatiosOfSums)
{
  const Condition c = parseCondition("(a(x) - b(x)) / (a(y)+b(y)) in 0.9 .. 1.1");
  ASSERT_EQ(c.sum.size(), 2u);
  EXPECT_FALSE(c.sum[0].isTakenAway);
  EXPECT_TRUE(c.sum[1].isTakenAway);
  ASSERT_EQ(c.divisor.size(), 2u);
  EXPECT_FALSE(c.divisor[1].isTakenAway);
  EXPECT_EQ(c.bound.kind, Bound::Kind::kBetween);
  EXPECT_EQ(c.bound.low, 0.9);
  EXPECT_EQ(c.bound.high, 1.1);
}

TEST(Condition, ReadsPublishedValues)
{
  const Bound mean = parseCondition("a(x) = 0.0393 +- 0.0136").bound;
  EXPECT_EQ(mean.kind, Bound::Kind::kAsPublished);
  EXPECT_EQ(mean.published, 0.0393);
  EXPECT_EQ(mean.deviation, 0.0136);
  EXPECT_FALSE(mean.runs);
  const Bound runs = parseCondition("a(x) <= 3.93 of 10 runs").bound;
  EXPECT_EQ(runs.kind, Bound::Kind::kAtMostPublished);
  EXPECT_EQ(runs.runs, 10);
  EXPECT_FALSE(runs.deviation);
  EXPECT_EQ(parseCondition("a(x) >= 3 of 2 runs").bound.kind, Bound::Kind::kAtLeastPublished);
  EXPECT_EQ(parseCondition("a(x) > -2e-3").bound.low, -2e-3);
}

TEST(Condition, SaysWhatIsWrong)
{
  expectError("", "a metric's name is missing");
  expectError("a", "'(' is missing");
  expectError("a(", "')' is missing");
  expectError("a(x", "')' is missing");
  expectError("a() < 1", "a() has no method");
  expectError("a(x, n) < 1", "'n' is no axis=value");
  expectError("a(x, n=1, n=2) < 1", "axis n comes twice");
  expectError("a(x)", "'' is no bound");
  expectError("a(x) < much", "'much' is no number");
  expectError("a(x) < inf", "is no number");
  expectError("a(x) < 1 2", "'2' follows");
  expectError("a(x) - b(x) / c(x) < 1", "needs brackets");
  expectError("a(x) / b(x) + c(x) < 1", "needs brackets");
  expectError("(a(x) - b(x) < 1", "')' is missing");
  expectError("a(x) in 2 .. 1", "rising order");
  expectError("a(x) in 1 2", "'..' is missing");
  expectError("a(x) = 3", "neither '+- deviation' nor 'of N runs'");
  expectError("a(x) = 3 +- 0", "the deviation is not positive");
  expectError("a(x) = 3 of 1.5 runs", "whole number");
  expectError("a(x) = 3 of 10", "'runs' is missing");
}
}  // namespace slamot::reproduce::test
