#pragma once

#include "ekf/Belief.h"

#include <gtest/gtest.h>
#include <slamot/math/random.h>

#include <Eigen/LU>

namespace slamot::filters::ekf
{
/// All of a belief's covariance, both triangles.
inline Eigen::MatrixXd dense(const LowerMatrix& P)
{
  Eigen::MatrixXd out(P.size(), P.size());
  for (int i = 0; i < P.size(); ++i)
    for (int j = 0; j < P.size(); ++j) out(i, j) = P(i, j);
  return out;
}

inline Eigen::MatrixXd randomMatrix(int rows, int columns, math::RandomStream& random)
{
  Eigen::MatrixXd out(rows, columns);
  for (double& v : out.reshaped()) v = random.normal();
  return out;
}

/// A random symmetric positive definite matrix.
inline Eigen::MatrixXd randomCov(int n, math::RandomStream& random)
{
  const Eigen::MatrixXd A = randomMatrix(n, n, random);
  return A * A.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
}

/// A sighting with random derivatives.
inline SightingRows randomRows(int robot, int object, math::RandomStream& random)
{
  SightingRows out;
  out.robot = robot;
  out.object = object;
  out.byRobot = randomMatrix(2, 3, random);
  out.byObject = randomMatrix(2, 2, random);
  out.innovation = randomMatrix(2, 1, random);
  out.variance = Vector2(0.5 + random.uniform(), 0.5 + random.uniform());
  return out;
}

/// H of sightings, in full.
inline Eigen::MatrixXd denseRows(const std::vector<SightingRows>& rows, int n)
{
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(2 * rows.size()), n);
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const auto i = static_cast<Eigen::Index>(2 * k);
    H.block<2, 3>(i, rows[k].robot) = rows[k].byRobot;
    H.block<2, 2>(i, rows[k].object) = rows[k].byObject;
  }
  return H;
}
}  // namespace slamot::filters::ekf
