#pragma once

#include <slamot/math/random.h>

#include <Eigen/Core>

namespace slamot::math
{
/// A matrix whose operators compute at once, in functions that are compiled once.  With Eigen's
/// own, every expression of these tests is compiled anew, a minute for each file.
template <class T>
class DenseOf : public Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>
{
 public:
  using Base = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  using Base::Base;

  [[nodiscard]] DenseOf transpose() const;
  /// By elimination with pivots.
  [[nodiscard]] DenseOf inverse() const;

  friend DenseOf operator*(const DenseOf& a, const DenseOf& b) { return a.times(b); }
  friend DenseOf operator*(double f, const DenseOf& a) { return a.scaled(f); }
  friend DenseOf operator/(const DenseOf& a, double f) { return a.scaled(1 / T(f)); }
  friend DenseOf operator+(const DenseOf& a, const DenseOf& b) { return a.plus(1, b); }
  friend DenseOf operator-(const DenseOf& a, const DenseOf& b) { return a.plus(-1, b); }
  DenseOf& operator+=(const DenseOf& b) { return *this = plus(1, b); }
  DenseOf& operator-=(const DenseOf& b) { return *this = plus(-1, b); }

 private:
  [[nodiscard]] DenseOf times(const DenseOf& b) const;
  [[nodiscard]] DenseOf plus(T f, const DenseOf& b) const;
  [[nodiscard]] DenseOf scaled(T f) const;
};
extern template class DenseOf<double>;
extern template class DenseOf<long double>;
using Dense = DenseOf<double>;

Dense identity(int n);
Dense zeros(int rows, int cols);
Dense diagonal(std::initializer_list<double> values);
/// Of normal deviates.
Dense draw(RandomStream& random, int rows, int cols);
/// The columns of a square matrix made orthonormal, in their order.
Dense orthonormal(Dense columns);
/// Largest eigenvalue of A against B; B is positive definite, else the ratio is 1e9.
double largestRatio(const Dense& A, const Dense& B);
/// Largest difference, relative to the larger of 1 and b's largest entry.
double error(const Dense& a, const Dense& b);
}  // namespace slamot::math
