#pragma once

#include <slamot/math/gaussian.h>

namespace slamot::filters
{
/// Mean and covariance of weighted Gaussians over poses, one by one (West 1979): every term added
/// to the covariance is positive, so that one heavy particle among light ones leaves no rounding
/// below zero.
class PoseMoments
{
 public:
  void add(double weight, const Pose2D& mean, const Matrix3& cov)
  {
    if (!(weight > 0)) return;
    if (sum_ == 0) mean_ = mean;
    sum_ += weight;
    const double share = weight / sum_;
    const Vector3 d(mean.x - mean_.x, mean.y - mean_.y, math::wrapToPi(mean.phi - mean_.phi));
    mean_ = {mean_.x + share * d[0], mean_.y + share * d[1], mean_.phi + share * d[2]};
    second_ += weight * (cov + (1 - share) * d * d.transpose());
  }
  [[nodiscard]] Gaussian<Pose2D> gaussian() const
  {
    const Matrix3 cov = second_ / sum_;
    return {{mean_.x, mean_.y, math::wrapToPi(mean_.phi)}, 0.5 * (cov + cov.transpose())};
  }

 private:
  double sum_ = 0;
  Pose2D mean_;
  Matrix3 second_ = Matrix3::Zero();
};
}  // namespace slamot::filters
