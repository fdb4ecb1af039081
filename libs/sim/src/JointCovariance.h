#pragma once

#include <Eigen/Core>

#include <vector>

namespace slamot::sim
{
/// The covariance of several states' errors, as linear dynamics and observations change it: what a
/// Kalman filter would know that linearises at the truth.  States are blocks of coordinates.
/// One triangle is kept.  \see posteriorBound
class JointCovariance
{
 public:
  using Matrix = Eigen::MatrixXd;
  using ConstMatrix = Eigen::Ref<const Eigen::MatrixXd>;

  /// A part of an observation's Jacobian: by the coordinates from `at` on.
  struct Part
  {
    int at = 0;
    Matrix jacobian;
  };
  /// Independent observations at once: rows of H, and their noises' variances.
  struct Row
  {
    std::vector<Part> parts;   ///< at different coordinates, each with as many rows as noise
    Eigen::VectorXd variance;  ///< > 0
  };

  /// Adds a state that is independent of all others.  \return its first coordinate.
  int add(const ConstMatrix& covariance);

  /// Adds a state of which nothing is known but what `parts` of others and noise say of it:
  /// new = sum of jacobian * part + noise.  \return its first coordinate.
  int addFrom(const std::vector<Part>& parts, const ConstMatrix& noise);

  /// The state at these coordinates becomes F state + noise of covariance Q, independent of all.
  void move(int at, const ConstMatrix& F, const ConstMatrix& Q);

  void observe(const std::vector<Row>& rows);

  [[nodiscard]] int size() const { return size_; }
  /// Of the coordinates from `at` on; symmetric.
  [[nodiscard]] Matrix block(int at, int count) const;
  [[nodiscard]] double variance(int at) const { return P_(at, at); }

 private:
  [[nodiscard]] Matrix columns(int at, int count) const;
  void reserve(int size);

  Matrix P_;  // of it, the first size_ rows and columns count, and of these the lower triangle
  int size_ = 0;
};
}  // namespace slamot::sim
