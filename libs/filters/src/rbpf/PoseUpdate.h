#pragma once

#include "sighting/Sighting.h"

namespace slamot::filters::rbpf
{
/// Collects what a scan says of a pose with prior N(x0, P0), all sightings linearised at x0, and
/// gives the posterior and the scan's marginal likelihood: the proposal of FastSLAM 2.0
/// (Montemerlo et al. 2003, eq. (15)-(20)) for a whole scan at once, the targets' sightings
/// included. P0 may be singular (a control with two noises): only a square root of it enters, never
/// its inverse.
class PoseUpdate
{
 public:
  /// A sighting of a point with the innovation taken at x0.
  void add(const Innovation& o)
  {
    // By the pose, the derivative of what is expected is (-H, turn).
    Eigen::Matrix<double, 2, 3> J;
    J << -o.h11, -o.h12, o.turnR, -o.h21, -o.h22, o.turnB;
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
    Matrix3 root;    ///< a square root L of the covariance L Lᵀ
    double logGain;  ///< log of the marginal over the likelihood at x0: ½ (bᵀ P b - ln|I + P0 A|)
    // The same in the prior's own coordinates w, x = x0 + root0 w with w ~ N(0, I), where a
    // singular prior has a density too.
    Vector3 white;      ///< mean of w
    Matrix3 whiteRoot;  ///< a square root of its covariance
    double logRoot;     ///< ln of that root's determinant
  };
  /// \param root a square root of the prior: P0 = root rootᵀ.
  [[nodiscard]] Result solve(const Matrix3& root) const;

 private:
  Matrix3 information_ = Matrix3::Zero();
  Vector3 vector_ = Vector3::Zero();
};
}  // namespace slamot::filters::rbpf
