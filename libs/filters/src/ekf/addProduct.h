#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace slamot::filters::ekf
{
/// A matrix to be read: entry (i, k) at data[i * stepI + k * stepK].
struct ReadOnly
{
  const double* data;
  Eigen::Index stepI, stepK;
  Eigen::Index rows, columns;

  static ReadOnly of(const Eigen::MatrixXd& m)
  {
    return {m.data(), 1, m.outerStride(), m.rows(), m.cols()};
  }
  static ReadOnly transposeOf(const Eigen::MatrixXd& m)
  {
    return {m.data(), m.outerStride(), 1, m.cols(), m.rows()};
  }
};

/// C += factor A Bᵀ, with `lower` only on and below C's diagonal; columns of C are `stride` apart.
/// This takes nearly all of the filter's time.  Eigen's product, built for any 64-bit PC, uses two
/// lanes of a processor that has eight; this one looks at what the processor has, and yet gives
/// the same bits on all: sums go over k in rising order, and nothing is contracted.  Measured by
/// bench/ekf_bench.cpp, see doc/speed.md.
void addProduct(double factor, const ReadOnly& A, const ReadOnly& B, double* C, Eigen::Index stride,
                bool lower);

/// The ways that this processor can do it, for tests; addProduct() takes the first.
[[nodiscard]] std::vector<std::string> productWays();
void addProduct(const std::string& way, double factor, const ReadOnly& A, const ReadOnly& B,
                double* C, Eigen::Index stride, bool lower);
}  // namespace slamot::filters::ekf
