#pragma once

#include "LowerMatrix.h"

#include <slamot/math/gaussian.h>
#include <slamot/math/intersection.h>
#include <slamot/models/NoiseLaw.h>

#include <memory>
#include <vector>

// The EKF's one Gaussian over all that it estimates.
namespace slamot::filters::ekf
{
/// Two rows of H: a sighting of an object by a robot, with its noise.
struct SightingRows
{
  int robot = 0, object = 0;  ///< coordinates of pose and place: where they begin
  // Derivatives of what is expected:
  Eigen::Matrix<double, 2, 3> byRobot = Eigen::Matrix<double, 2, 3>::Zero();
  Matrix2 byObject = Matrix2::Zero();
  Vector2 innovation = Vector2::Zero(), variance = Vector2::Zero();
  const models::NoiseLaw* law = nullptr;  ///< of its errors, by this variance; null: normal
  bool hasRange = true;                   ///< else the first row is inert
  double factor = 1;  ///< of the variance, that stands for the law: see soften()
};

/// \throws core::Error that says that the numbers of a log made no sense.
[[noreturn]] void failOverflow();

/// Mean and covariance of robots, targets and landmarks, in this order; landmarks in the order of
/// their discovery.  Room for targets comes in slots, and a free slot has zero covariance: targets
/// come and go without moving the landmarks behind them.
///
/// The compressed form: focus() makes some landmarks local, and from then on every operation
/// touches robots, targets and local landmarks (A) alone; what it means for the rest (B) is summed
/// up, and carried out by spread(): Guivant and Nebot, "Optimization of the Simultaneous
/// Localization and Map-Building Algorithm for Real-Time Implementation", 2001.  With P_AB = Phi
/// P_AB0 and P_BB = s (P_BB0 - P_BA0 Psi P_AB0), no inverse of P is needed, so that the numbers are
/// those of the plain form but for rounding.
class Belief
{
 public:
  Belief(int robots, int targetSize);
  Belief(const Belief& other);
  ~Belief();

  [[nodiscard]] const Eigen::VectorXd& x() const { return x_; }
  Eigen::VectorXd& x() { return x_; }
  [[nodiscard]] const LowerMatrix& P() const { return P_; }
  [[nodiscard]] int robots() const { return robots_; }
  [[nodiscard]] int robot(int r) const { return 3 * r; }
  [[nodiscard]] int target(int slot) const { return 3 * robots_ + targetSize_ * slot; }
  /// Where a landmark begins; -1: it is not local.
  [[nodiscard]] int landmark(int slot) const { return offset_[static_cast<std::size_t>(slot)]; }
  [[nodiscard]] int landmarks() const { return static_cast<int>(offset_.size()); }
  /// A landmark's place, local or not.
  [[nodiscard]] Gaussian<Point2D> place(int slot) const;

  /// A slot for a target, all its coordinates zero and known.
  int addTarget();
  void removeTarget(int slot);
  /// A new landmark's slot, at `place` and correlated as `byRobot` (2x3) says.
  int addLandmark(int robot, const Gaussian<Point2D>& place,
                  const Eigen::Matrix<double, 2, 3>& byRobot);
  /// Adds to the error of the place from j on, which has none in common with others, that of a
  /// robot's pose (at `robot`) times `byRobot`.
  void correlate(int j, int robot, const Eigen::Matrix<double, 2, 3>& byRobot);
  /// Frees the slot.  The landmark must be local.
  void removeLandmark(int slot);

  /// Sets coordinates from j on, uncorrelated with all others.
  void set(int j, const Eigen::Ref<const Eigen::VectorXd>& mean,
           const Eigen::Ref<const Eigen::MatrixXd>& cov);
  /// The coordinates from j on become `mean`, their errors F times the old ones plus Q.
  void move(int j, const Eigen::Ref<const Eigen::VectorXd>& mean,
            const Eigen::Ref<const Eigen::MatrixXd>& F, const Eigen::Ref<const Eigen::MatrixXd>& Q);
  /// Kalman update by all sightings at once, derivatives taken before it; those that may glint one
  /// by one, see updateOneByOne().  Angles of x are the caller's to wrap.
  /// \return log density of the innovations.
  double update(const std::vector<SightingRows>& rows);

  /// W = P Hᵀ of rows that are zero but for `columns`, which begin at `at`.
  struct Rows
  {
    std::vector<int> at;                   ///< where each block of columns begins
    std::vector<Eigen::MatrixXd> columns;  ///< blocks of H, all of as many rows
  };
  [[nodiscard]] Eigen::MatrixXd product(const Rows& H) const;
  /// H W.
  [[nodiscard]] static Eigen::MatrixXd innovationCov(const Rows& H, const Eigen::MatrixXd& W);
  /// E picks the places of all and robots' headings times `lever` [m].
  [[nodiscard]] math::IntersectionCriterion criterion(const Rows& H, const Eigen::MatrixXd& W,
                                                      double lever);
  void fuse(const Rows& H, const Eigen::MatrixXd& W, const math::IntersectionUpdate& update);
  /// The block from j on gets mean + shift, covariance C, and T times its covariance with others.
  void reshape(int j, const Eigen::Ref<const Eigen::VectorXd>& shift,
               const Eigen::Ref<const Eigen::MatrixXd>& T,
               const Eigen::Ref<const Eigen::MatrixXd>& C);

  [[nodiscard]] bool isFocused() const { return rest_ != nullptr; }
  /// Makes these landmarks local and no others.
  void focus(const std::vector<int>& slots);
  /// Carries out on the rest what was summed up; all landmarks are local then.
  void spread();

 private:
  struct Rest;
  [[nodiscard]] int front() const { return target(targetSlots_); }
  void makeRoomForTargets();
  void spanOf(const std::vector<SightingRows>& rows);
  double updateByLaw(const std::vector<SightingRows>& rows);
  /// x + W gain, scale (P - W reduction Wᵀ).
  /// \param U H times the compressed form's phi, if it is that.
  void take(const Eigen::MatrixXd& W, const Eigen::MatrixXd& U, const Eigen::VectorXd& gain,
            const Eigen::MatrixXd& reduction, double scale);
  void gatherRest(const std::vector<int>& slots);

  int robots_, targetSize_, targetSlots_ = 0;
  std::vector<int> freeTargets_, freeLandmarks_;
  std::vector<int> offset_;  // of each landmark slot
  Eigen::VectorXd x_;
  LowerMatrix P_;
  std::unique_ptr<Rest> rest_;
  Eigen::MatrixXd W_, column_;  // room for work
};
}  // namespace slamot::filters::ekf
