#pragma once

#include <Eigen/Core>

#include <vector>

namespace slamot::sim
{
/// The errors of several states' estimates, as linear dynamics and observations change them: those
/// of the Kalman filter that linearises at the truth, which is efficient.  Their covariance, and
/// for the noises that were truly drawn the errors themselves, estimate less truth.  States are
/// blocks of coordinates.  Of the covariance one triangle is kept.  \see posteriorBound
class JointErrors
{
 public:
  using Matrix = Eigen::MatrixXd;
  using ConstMatrix = Eigen::Ref<const Eigen::MatrixXd>;
  using ConstVector = Eigen::Ref<const Eigen::VectorXd>;

  /// A part of an observation's Jacobian: by the coordinates from `at` on.
  struct Part
  {
    int at = 0;
    Matrix jacobian;
  };
  /// An observation: rows of H, the variances of their noises and what was drawn of these.
  struct Row
  {
    std::vector<Part> parts;   ///< at different coordinates, each of as many rows as noise
    Eigen::VectorXd variance;  ///< > 0
    Eigen::VectorXd noise;     ///< observation less what is true
  };

  /// Adds a state that is independent of all others.  \return its first coordinate.
  int add(const ConstMatrix& covariance, const ConstVector& error);

  /// Adds a state of which nothing is known but what `parts` of others and noise say of it: its
  /// error is the sum of jacobian * part, and a noise.  \return its first coordinate.
  int addFrom(const std::vector<Part>& parts, const ConstMatrix& noiseCovariance,
              const ConstVector& noise);

  /// The state at these coordinates moves: its error becomes F error - noise, and the noise has
  /// the covariance Q and is independent of all.
  void move(int at, const ConstMatrix& F, const ConstMatrix& Q, const ConstVector& noise);

  /// Takes in independent observations at once.
  void observe(const std::vector<Row>& rows);

  [[nodiscard]] int size() const { return size_; }
  /// Of the coordinates from `at` on; symmetric.
  [[nodiscard]] Matrix block(int at, int count) const;
  [[nodiscard]] double variance(int at) const { return P_(at, at); }
  [[nodiscard]] double error(int at) const { return error_[at]; }

 private:
  [[nodiscard]] Matrix columns(int at, int count) const;
  void reserve(int size);

  Matrix P_;  // of it, the first size_ rows and columns count, and of these the lower triangle
  Eigen::VectorXd error_;  // of it, the first size_
  int size_ = 0;
};
}  // namespace slamot::sim
