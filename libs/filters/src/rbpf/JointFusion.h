#pragma once

#include <slamot/core/Team.h>
#include <slamot/math/geometry.h>

#include <Eigen/Core>

// What another robot told, taken into the moments that all particles have together.
namespace slamot::filters::rbpf
{
/// The part of the errors of robot and target that is no difference between particles: one rigid
/// motion of both, and the target's own.  These two are independent of each other.
struct CommonErrors
{
  Matrix3 frame;                                   ///< of the motion, as one of the robot's pose
  Eigen::Matrix<double, Eigen::Dynamic, 3> lever;  ///< of the target by the robot's pose
  Eigen::MatrixXd target;                          ///< of the target, seen from a particle
};

/// What to do with each particle's joint p of robot and target: p becomes p + shift - gain (p - m),
/// m their mean.  The rest of the new covariance is common to all again.
struct JointFusion
{
  bool pays = false;      ///< false: the rest is not set
  double omega = 1;       ///< weight of one's own estimate
  Eigen::VectorXd shift;  ///< of the mean
  Eigen::MatrixXd gain;
  Matrix3 frame = Matrix3::Zero();  ///< as in CommonErrors
  Eigen::MatrixXd target;           ///< as in CommonErrors
};

/// `own` holds all errors, the common ones included.  The fused covariance is that of the rule, and
/// more: the frame and the target, seen from a particle, must be independent, so both grow by what
/// the fusion correlated them; not so by the paper's rule, which knows of no such thing.  It pays
/// if the criterion is smaller nevertheless, or where the weight is given.
/// \throws std::domain_error as math::intersect(), and if sizes disagree.
[[nodiscard]] JointFusion fuseJoint(const core::RobotAndTarget& own, const CommonErrors& common,
                                    const core::Evidence& evidence,
                                    const core::FusionOptions& options);
}  // namespace slamot::filters::rbpf
