#pragma once

#include <gtest/gtest.h>
#include <slamot/math/gaussian.h>

namespace slamot::test
{
/// Finite, symmetric, and without an eigenvalue below zero but for rounding.
template <class M>
void expectCovariance(const M& P)
{
  ASSERT_TRUE(P.allFinite()) << P;
  EXPECT_LE(math::asymmetry(P), 1e-14 * P.norm()) << P;
  EXPECT_GE(math::smallestEigenvalue(P), -1e-12 * P.trace()) << P;
}
}  // namespace slamot::test
