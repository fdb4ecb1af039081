#include <slamot/math/eigensystem.h>
#include <slamot/math/random.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace slamot::math
{
namespace
{
template <int N>
using Square = Eigen::Matrix<double, N, N>;

/// With the eigenvalues told, in axes drawn.
template <int N>
Square<N> draw(RandomStream& random, const Eigen::VectorXd& values)
{
  const Eigen::Index n = values.size();
  Square<N> axes(n, n);
  for (Eigen::Index j = 0; j < n; ++j)
  {
    for (Eigen::Index i = 0; i < n; ++i) axes(i, j) = random.normal();
    for (Eigen::Index k = 0; k < j; ++k) axes.col(j) -= axes.col(k).dot(axes.col(j)) * axes.col(k);
    axes.col(j).normalize();
  }
  Square<N> out = Square<N>::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i) out.col(i) += values[j] * axes(i, j) * axes.col(j);
  return out;
}

template <int N>
void check(Eigen::Index n)
{
  RandomStream random{1, static_cast<std::uint64_t>(n)};
  for (int trial = 0; trial < 30; ++trial)
  {
    Eigen::VectorXd wanted(n);
    for (double& v : wanted) v = random.uniform(-1, 2);
    std::sort(wanted.begin(), wanted.end());
    const Square<N> m = draw<N>(random, wanted);
    const Eigensystem<N> e = eigensystem<N>(m);
    EXPECT_LT((e.values - wanted).norm(), 1e-12);
    for (Eigen::Index j = 0; j < n; ++j)
    {
      const Eigen::VectorXd v = e.vectors.col(j);
      Eigen::VectorXd left = -e.values[j] * v;
      for (Eigen::Index i = 0; i < n; ++i) left += v[i] * m.col(i);
      EXPECT_LT(left.norm(), 1e-12);
      EXPECT_NEAR(v.norm(), 1, 1e-12);
    }
    if constexpr (N == 4 || N == 6)
    {
      const auto left = eigensystem<N>(withoutNegative<N>(m)).values;
      EXPECT_LT((left - wanted.cwiseMax(0)).norm(), 1e-12);
    }
  }
}
}  // namespace

TEST(Eigensystem, OfEverySizeIsTheMatrixs)
{
  check<3>(3);
  check<4>(4);
  check<6>(6);
  check<Eigen::Dynamic>(5);
  check<Eigen::Dynamic>(1);
}
}  // namespace slamot::math
