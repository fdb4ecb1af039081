#pragma once

#include <Eigen/Core>
#include <optional>

namespace slamot::math
{
/// Sizes of what is told at once: at most a place and a target's six coordinates.  They live on the
/// stack.
inline constexpr int kMaxBlock = 8;
using BlockVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxBlock,
                                  1>;  ///< of at most kMaxBlock entries
/// Of at most kMaxBlock rows and columns.
using BlockMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxBlock, kMaxBlock>;

/// How an estimate (x, P) takes in b = H x + e, cov(e) = B, when e and the errors of x are
/// correlated in an unknown way.  omega is the weight of one's own estimate: 1 changes nothing.
enum class Intersection
{
  /// Covariance intersection, P+⁻¹ = omega P⁻¹ + (1 - omega) Hᵀ B⁻¹ H: consistent whatever the
  /// correlation.  Julier, Uhlmann, "A non-divergent estimation algorithm in the presence of
  /// unknown correlations", 1997.
  kCovariance,
  /// The same, but the part I of B that is noise of its own is not inflated: with
  /// (B - I) / (1 - omega) + I for B / (1 - omega).  Consistent if I is what it is said to be.
  kSplit,
  /// Inverse covariance intersection on the block a = H x of covariance A,
  /// A+⁻¹ = A⁻¹ + B⁻¹ - ((1 - omega) A + omega B)⁻¹, regressed on the rest of the state.  Noack,
  /// Sijs, Reinhardt, Hanebeck, "Decentralized data fusion with inverse covariance intersection",
  /// 2017.  NOT guaranteed: consistent for correlations by common information only.
  kInverse
};

/// What is to be made small: tr(E P+ Eᵀ), E picking the coordinates that count.
struct IntersectionCriterion
{
  double trace = 0;  ///< tr(E P Eᵀ)
  BlockMatrix gram;  ///< Wᵀ Eᵀ E W with W = P Hᵀ
};

/// The new estimate, in terms of W = P Hᵀ:  x+ = x + W gain,  P+ = scale (P - W reduction Wᵀ).
struct IntersectionUpdate
{
  bool pays = false;      ///< false: no omega is better than 1; the rest then says "no change"
  double omega = 1;       ///< weight of one's own estimate
  double scale = 1;       ///< at least 1
  BlockVector gain;       ///< linear in the innovation
  BlockMatrix reduction;  ///< symmetric; positive semidefinite but for kInverse, where it can be
                          ///< indefinite; P+ is positive semidefinite always
};

/// The update for A = H P Hᵀ, innovation = b - H x, B and its part `independent` (read by kSplit
/// only).  Without an omega, the one in [1e-4, 1] that makes the criterion smallest, which is
/// convex in omega for all rules; where it is flat (equal covariances), 0.5.  A given omega in (0,
/// 1] is used as it is, and pays unless 1.  Costs a few 8x8 operations, and no memory. \throws
/// std::domain_error if sizes disagree or exceed kMaxBlock, a value is not finite, B is not
/// positive definite, A, `independent` or B - `independent` (kSplit) is not positive semidefinite,
/// or omega is out of range.
[[nodiscard]] IntersectionUpdate intersect(Intersection rule,
                                           const Eigen::Ref<const Eigen::MatrixXd>& A,
                                           const Eigen::Ref<const Eigen::VectorXd>& innovation,
                                           const Eigen::Ref<const Eigen::MatrixXd>& B,
                                           const Eigen::Ref<const Eigen::MatrixXd>& independent,
                                           const IntersectionCriterion& criterion,
                                           std::optional<double> omega = {});

/// One block a of an estimate, of covariance A, fused with b of covariance B as published by the
/// paper on EKF-SLAMOT teams (equations (3)-(15), corrected): C⁻¹ = omega A⁻¹ + (1 - omega) B⁻¹.
/// INCONSISTENT: it takes b for independent of all other coordinates and leaves their means and
/// covariances as they are, so that estimates become too sure of themselves.  Kept to reproduce
/// the paper.
struct PaperBlock
{
  double omega = 1;         ///< weight of one's own estimate; 1 changes nothing
  BlockVector shift;        ///< to be added to the block's mean
  BlockMatrix cov;          ///< C, the block's new covariance
  BlockMatrix crossFactor;  ///< omega C A⁻¹: left factor of the block's cross-covariances with
                            ///< everything else
};

/// Without an omega, the one in [0, 1] that makes the spectral norm of C smallest; 0.5 where all
/// are equal.
/// \throws std::domain_error as intersect(), and if A is not positive definite.
[[nodiscard]] PaperBlock paperBlock(const Eigen::Ref<const Eigen::MatrixXd>& A,
                                    const Eigen::Ref<const Eigen::VectorXd>& innovation,
                                    const Eigen::Ref<const Eigen::MatrixXd>& B,
                                    std::optional<double> omega = {});
}  // namespace slamot::math
