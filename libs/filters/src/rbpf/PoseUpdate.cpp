#include "PoseUpdate.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace slamot::filters::rbpf
{
PoseUpdate::Result PoseUpdate::solve(const Matrix3& root) const
{
  // (P0⁻¹ + A)⁻¹ = L (I + Lᵀ A L)⁻¹ Lᵀ: symmetric and positive, however much A outweighs P0.
  const Matrix3 M = Matrix3::Identity() + root.transpose() * information_ * root;
  const Eigen::LLT<Matrix3> llt(M);
  Result out;
  out.root = llt.matrixL().solve(root.transpose()).transpose();
  out.shift = out.root * (out.root.transpose() * vector_);
  const Vector3 diagonal = llt.matrixLLT().diagonal();
  out.logRoot = -std::log(diagonal.prod());
  out.logGain = 0.5 * vector_.dot(out.shift) + out.logRoot;
  out.whiteRoot = llt.matrixU().solve(Matrix3::Identity());
  out.white = out.whiteRoot * (out.root.transpose() * vector_);
  return out;
}
}  // namespace slamot::filters::rbpf
