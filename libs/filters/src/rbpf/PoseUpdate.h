#pragma once

#include "Sighting.h"

#include <Eigen/LU>

namespace slamot::filters::rbpf
{
/// Collects what a scan says of a pose with prior N(x0, P0), all sightings linearised at x0, and
/// gives the posterior and the scan's marginal likelihood: the proposal of FastSLAM 2.0
/// (Montemerlo et al. 2003, eq. (15)-(20)) for a whole scan at once, the targets' sightings included.
/// P0 may be singular (a control with two noises): only P0 itself enters, not its inverse.
class PoseUpdate
{
 public:
  /// A sighting of a point with the innovation taken at x0.
  void add(const Innovation& o)
  {
    // By the pose, h's derivative is (-H, (0, -1)ᵀ).
    Eigen::Matrix<double, 2, 3> J;
    J << -o.h11, -o.h12, 0.0, -o.h21, -o.h22, -1.0;
    const double id = 1 / o.det;
    Matrix2 Si;
    Si << o.s22 * id, -o.s12 * id, -o.s12 * id, o.s11 * id;
    const Eigen::Matrix<double, 3, 2> JtSi = J.transpose() * Si;
    information_.noalias() += JtSi * J;
    vector_.noalias() += JtSi * Vector2(o.nuR, o.nuB);
  }

  struct Result
  {
    Vector3 shift;   ///< of the mean, from x0
    Matrix3 cov;
    double logGain;  ///< log of the marginal over the likelihood at x0: ½ (bᵀ P b - ln|I + P0 A|)
  };
  [[nodiscard]] Result solve(const Matrix3& P0) const
  {
    const Matrix3 M = Matrix3::Identity() + P0 * information_;
    Result out;
    const Matrix3 P = M.inverse() * P0;
    out.cov = 0.5 * (P + P.transpose());
    out.shift = out.cov * vector_;
    out.logGain = 0.5 * (vector_.dot(out.shift) - std::log(M.determinant()));
    return out;
  }

 private:
  Matrix3 information_ = Matrix3::Zero();
  Vector3 vector_ = Vector3::Zero();
};
}  // namespace slamot::filters::rbpf
