#pragma once

#include "addProduct.h"

#include <Eigen/Core>
#include <algorithm>

namespace slamot::filters::ekf
{
/// A symmetric matrix that grows.  Only its lower triangle is kept up to date: an update of n
/// states costs half of what a full matrix does, and stays symmetric whatever the rounding.
class LowerMatrix
{
 public:
  LowerMatrix() = default;
  LowerMatrix(const LowerMatrix& other)
      : data_(other.data_.topLeftCorner(other.n_, other.n_)), n_(other.n_)
  {
  }
  LowerMatrix(LowerMatrix&&) = default;
  LowerMatrix& operator=(LowerMatrix&&) = default;
  [[nodiscard]] int size() const { return n_; }
  double operator()(int i, int j) const { return i >= j ? data_(i, j) : data_(j, i); }

  /// Rows and columns up to n; new ones are zero.
  void grow(int n)
  {
    if (n > data_.rows()) reserve(std::max(n, static_cast<int>(data_.rows()) * 3 / 2));
    for (int j = 0; j < n; ++j)
    {
      const int from = std::max(j, n_);
      data_.col(j).segment(from, n - from).setZero();
    }
    n_ = n;
  }

  /// The block of rows i.. and columns j... .
  template <int A, int B>
  [[nodiscard]] Eigen::Matrix<double, A, B> block(int i, int j) const
  {
    if (i >= j + B - 1) return data_.block<A, B>(i, j);
    if (j >= i + A - 1) return data_.block<B, A>(j, i).transpose();
    Eigen::Matrix<double, A, B> out;
    for (int a = 0; a < A; ++a)
      for (int b = 0; b < B; ++b) out(a, b) = (*this)(i + a, j + b);
    return out;
  }

  /// out (size() x k) = columns j to j + k.
  template <class Out>
  void columns(int j, int k, Out&& out) const
  {
    out.topRows(j) = data_.block(j, 0, k, j).transpose();
    for (int c = 0; c < k; ++c)
      for (int r = 0; r < c; ++r) out(j + r, c) = data_(j + c, j + r);
    for (int c = 0; c < k; ++c)
      out.col(c).segment(j + c, n_ - j - c) = data_.col(j + c).segment(j + c, n_ - j - c);
  }

  void set(int i, int j, double value) { (i >= j ? data_(i, j) : data_(j, i)) = value; }

  /// Rows j to j + k and columns likewise become `columns` (size() x k), which holds them whole.
  template <class In>
  void setColumns(int j, int k, const In& columns)
  {
    data_.block(j, 0, k, j) = columns.topRows(j).transpose();
    for (int c = 0; c < k; ++c)
      data_.col(j + c).segment(j + c, n_ - j - c) = columns.col(c).segment(j + c, n_ - j - c);
  }

  /// Becomes T (this) Tᵀ, T the identity but for a block at j.
  template <class Block>
  void transform(int j, const Block& T)
  {
    const int k = static_cast<int>(T.rows()), below = n_ - j - k;
    const Eigen::MatrixXd diagonal = data_.block(j, j, k, k).selfadjointView<Eigen::Lower>();
    data_.block(j, 0, k, j) = (T * data_.block(j, 0, k, j)).eval();
    data_.block(j, j, k, k).template triangularView<Eigen::Lower>() = T * diagonal * T.transpose();
    data_.block(j + k, j, below, k) = (data_.block(j + k, j, below, k) * T.transpose()).eval();
  }

  /// Adds a symmetric block on the diagonal.
  template <class Block>
  void add(int j, const Block& Q)
  {
    data_.block(j, j, Q.rows(), Q.cols()).template triangularView<Eigen::Lower>() += Q;
  }

  /// Rows and columns j to j + k become zero.
  void clear(int j, int k)
  {
    data_.block(j, 0, k, j).setZero();
    for (int c = j; c < j + k; ++c) data_.col(c).segment(c, n_ - c).setZero();
  }

  /// Adds sign V Vᵀ.
  void update(const Eigen::MatrixXd& V, double sign)
  {
    addProduct(sign, ReadOnly::of(V), ReadOnly::of(V), data_.data(), data_.outerStride(), true);
  }
  /// Takes A Bᵀ off, which must be symmetric.
  void subtract(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B)
  {
    addProduct(-1, ReadOnly::of(A), ReadOnly::of(B), data_.data(), data_.outerStride(), true);
  }
  LowerMatrix& operator*=(double factor)
  {
    if (factor != 1) data_.topLeftCorner(n_, n_).triangularView<Eigen::Lower>() *= factor;
    return *this;
  }

  [[nodiscard]] auto diagonal() const { return data_.diagonal().head(n_); }

 private:
  void reserve(int capacity)
  {
    Eigen::MatrixXd bigger(capacity, capacity);
    for (int j = 0; j < n_; ++j) bigger.col(j).segment(j, n_ - j) = data_.col(j).segment(j, n_ - j);
    data_.swap(bigger);
  }

  Eigen::MatrixXd data_;
  int n_ = 0;
};
}  // namespace slamot::filters::ekf
