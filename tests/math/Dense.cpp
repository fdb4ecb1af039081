#include "Dense.h"

#include <slamot/math/gaussian.h>

#include <cmath>

namespace slamot::math
{
template <class T>
DenseOf<T> DenseOf<T>::transpose() const
{
  return DenseOf(Base::transpose());
}

template <class T>
DenseOf<T> DenseOf<T>::inverse() const
{
  DenseOf left = *this, right(Base::Identity(this->rows(), this->cols()));
  for (Eigen::Index k = 0; k < left.rows(); ++k)
  {
    Eigen::Index pivot = 0;
    left.col(k).tail(left.rows() - k).cwiseAbs().maxCoeff(&pivot);
    for (DenseOf* m : {&left, &right}) m->row(k).swap(m->row(k + pivot));
    const T p = left(k, k);
    for (DenseOf* m : {&left, &right}) m->row(k) /= p;
    for (Eigen::Index i = 0; i < left.rows(); ++i)
    {
      const T f = left(i, k);
      if (i == k || f == 0) continue;
      for (DenseOf* m : {&left, &right}) m->row(i) -= f * m->row(k);
    }
  }
  return right;
}

template <class T>
DenseOf<T> DenseOf<T>::times(const DenseOf& b) const
{
  return DenseOf(this->lazyProduct(b));
}

template <class T>
DenseOf<T> DenseOf<T>::plus(T f, const DenseOf& b) const
{
  DenseOf out = *this;
  static_cast<Base&>(out) += f * static_cast<const Base&>(b);
  return out;
}

template <class T>
DenseOf<T> DenseOf<T>::scaled(T f) const
{
  DenseOf out = *this;
  static_cast<Base&>(out) *= f;
  return out;
}

template class DenseOf<double>;
template class DenseOf<long double>;

Dense identity(int n)
{
  return Dense(Eigen::MatrixXd::Identity(n, n));
}
Dense zeros(int rows, int cols)
{
  return Dense(Eigen::MatrixXd::Zero(rows, cols));
}

Dense diagonal(std::initializer_list<double> values)
{
  const auto n = static_cast<int>(values.size());
  Dense out = zeros(n, n);
  Eigen::Index k = 0;
  for (const double v : values) out(k, k) = v, ++k;
  return out;
}

Dense draw(RandomStream& random, int rows, int cols)
{
  Dense out(rows, cols);
  for (double& a : out.reshaped()) a = random.normal();
  return out;
}

Dense orthonormal(Dense columns)
{
  for (Eigen::Index k = 0; k < columns.cols(); ++k)
  {
    for (int twice = 0; twice < 2; ++twice)  // once leaves what cancels
      for (Eigen::Index j = 0; j < k; ++j)
        columns.col(k) -= columns.col(j).dot(columns.col(k)) * columns.col(j);
    columns.col(k).normalize();
  }
  return columns;
}

double largestRatio(const Dense& A, const Dense& B)
{
  // Cholesky's L of B, and L⁻¹ A L⁻ᵀ.
  const Eigen::Index n = B.rows();
  Dense L = B;
  for (Eigen::Index k = 0; k < n; ++k)
  {
    for (Eigen::Index j = 0; j < k; ++j) L.col(k).tail(n - k) -= L(k, j) * L.col(j).tail(n - k);
    if (!(L(k, k) > 0)) return 1e9;
    L.col(k).head(k).setZero();
    L.col(k).tail(n - k) /= std::sqrt(L(k, k));
  }
  const Dense whitener = L.inverse(), M = whitener * A * whitener.transpose();
  return -smallestEigenvalue(-0.5 * (M + M.transpose()));
}

double error(const Dense& a, const Dense& b)
{
  return (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}
}  // namespace slamot::math
