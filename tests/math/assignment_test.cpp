#include <gtest/gtest.h>
#include <slamot/math/assignment.h>
#include <slamot/math/random.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

namespace slamot::math
{
namespace
{
// The cheapest of all ways to give each of the fewer rows or columns its own partner.
double bruteForce(const Eigen::MatrixXd& cost)
{
  const Eigen::MatrixXd c = cost.rows() <= cost.cols() ? cost : Eigen::MatrixXd(cost.transpose());
  std::vector<int> columns(static_cast<std::size_t>(c.cols()));
  std::iota(columns.begin(), columns.end(), 0);
  double best = std::numeric_limits<double>::infinity();
  do
  {
    double sum = 0;
    for (Eigen::Index i = 0; i < c.rows(); ++i) sum += c(i, columns[static_cast<std::size_t>(i)]);
    best = std::min(best, sum);
  } while (std::next_permutation(columns.begin(), columns.end()));
  return best;
}

double costOf(const Eigen::MatrixXd& cost, const std::vector<int>& columnOf)
{
  double sum = 0;
  for (std::size_t i = 0; i < columnOf.size(); ++i)
    if (columnOf[i] >= 0) sum += cost(static_cast<Eigen::Index>(i), columnOf[i]);
  return sum;
}
}  // namespace

TEST(Assign, EqualsBruteForceForEveryShapeUpToSeven)
{
  RandomStream random{1};
  for (int rows = 1; rows <= 7; ++rows)
    for (int columns = 1; columns <= 7; ++columns)
      for (int trial = 0; trial < 5; ++trial)
      {
        Eigen::MatrixXd cost(rows, columns);
        // Whole numbers make ties, negative ones try the potentials.
        for (double& c : cost.reshaped()) c = std::floor(random.uniform(-5, 10));
        const std::vector<int> columnOf = assign(cost);
        EXPECT_DOUBLE_EQ(costOf(cost, columnOf), bruteForce(cost)) << cost;

        std::multiset<int> used(columnOf.begin(), columnOf.end());
        used.erase(-1);
        EXPECT_EQ(used.size(), static_cast<std::size_t>(std::min(rows, columns)));
        EXPECT_EQ(std::set<int>(used.begin(), used.end()).size(), used.size());
      }
}

// Of a solution to be the best, potentials must exist: no pair of rows, and no row alone, gains by
// a change.  Among 60 rows pairs are enough to catch a wrong step of the search, ties included.
TEST(Assign, NoSwapImprovesLargeOnes)
{
  RandomStream random{2};
  for (const bool ties : {false, true})
    for (const int columns : {60, 75})
    {
      Eigen::MatrixXd cost(60, columns);
      for (double& c : cost.reshaped())
        c = ties ? std::floor(random.uniform(0, 12)) : random.uniform(0, 12);
      const std::vector<int> columnOf = assign(cost);
      const std::set<int> used(columnOf.begin(), columnOf.end());
      EXPECT_EQ(used.size(), 60u);
      for (int i = 0; i < 60; ++i)
      {
        const int a = columnOf[static_cast<std::size_t>(i)];
        for (int j = 0; j < columns; ++j)
          EXPECT_TRUE(used.count(j) > 0 || cost(i, a) <= cost(i, j));
        for (int k = 0; k < i; ++k)
        {
          const int b = columnOf[static_cast<std::size_t>(k)];
          EXPECT_LE(cost(i, a) + cost(k, b), cost(i, b) + cost(k, a) + 1e-12);
        }
      }
      EXPECT_DOUBLE_EQ(costOf(cost, columnOf), costOf(cost.transpose(), assign(cost.transpose())));
    }
}

TEST(Assign, LeavesAllRowsAloneWithoutColumns)
{
  EXPECT_EQ(assign(Eigen::MatrixXd(3, 0)), std::vector<int>({-1, -1, -1}));
  EXPECT_TRUE(assign(Eigen::MatrixXd(0, 3)).empty());
}

TEST(Assign, RefusesCostsThatAreNotFinite)
{
  Eigen::MatrixXd cost = Eigen::MatrixXd::Ones(2, 2);
  cost(1, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)assign(cost), std::domain_error);
}
}  // namespace slamot::math
