#include <slamot/models/stretch.h>

#include <slamot/math/eigensystem.h>

#include <Eigen/LU>
#include <algorithm>

namespace slamot::models
{
template <int N>
Stretch<N> stretch(const Eigen::Matrix<double, N, N>& from, const Eigen::Matrix<double, N, N>& to,
                   bool shrinkOnly)
{
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;
  const auto symmetric = [](const Matrix& M) { return Matrix(0.5 * (M + M.transpose())); };
  constexpr double kExact = 1e-13;  // of the largest variance: known exactly
  // In coordinates where `from` is the identity, but for those that it knows exactly: what of `to`
  // is left in the others given these.
  const auto a = math::eigensystem<N>(from);
  const Vector root = a.values.cwiseMax(0).cwiseSqrt();
  Vector inverse = Vector::Zero();
  for (int i = 0; i < N; ++i)
    if (a.values[i] > kExact * a.values[N - 1]) inverse[i] = 1 / root[i];
  const Matrix R = a.vectors * root.asDiagonal() * a.vectors.transpose();
  const Matrix I = a.vectors * inverse.asDiagonal() * a.vectors.transpose();
  // Not singular where all is known exactly either.
  const Matrix some = to + kExact * std::max(to.trace(), 1e-40) * Matrix::Identity();
  const auto g = math::eigensystem<N>(symmetric(R * some.inverse() * R));
  Vector by = Vector::Zero();
  for (int i = 0; i < N; ++i)
    if (g.values[i] > kExact) by[i] = 1 / std::sqrt(g.values[i]);
  if (shrinkOnly) by = by.cwiseMin(1);
  Stretch<N> out;
  out.T = R * g.vectors * by.asDiagonal() * g.vectors.transpose() * I;
  out.left = math::withoutNegative<N>(symmetric(to - out.T * from * out.T.transpose()));
  return out;
}
template Stretch<4> stretch(const Eigen::Matrix<double, 4, 4>&, const Eigen::Matrix<double, 4, 4>&,
                            bool);
template Stretch<6> stretch(const Eigen::Matrix<double, 6, 6>&, const Eigen::Matrix<double, 6, 6>&,
                            bool);
}  // namespace slamot::models
