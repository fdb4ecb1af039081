#pragma once

#include <slamot/math/gaussian.h>

#include <vector>

namespace slamot::scans
{
/// A measurement of one pose from another.
struct Relation
{
  std::size_t from = 0;           ///< node that is measured from
  std::size_t to = 0;             ///< node that is measured
  Gaussian<Pose2D> pose_from_to;  ///< covariance in the axes of `from`
  bool doubtful = false;          ///< may be wrong altogether, as a loop closure
};

/// Poses and what was measured between them; the first pose is fixed.  Least squares by
/// Gauss-Newton on a sparse Cholesky factor.  Doubtful relations are scaled down as far as they
/// contradict the rest: Agarwal et al., "Robust map optimization using dynamic covariance scaling",
/// 2013.  MRPT's graphslam optimises the same graphs by Levenberg-Marquardt, but knows no such
/// scaling and gives no covariances.
class PoseGraph
{
 public:
  /// Node 0 is at this pose, for good.
  explicit PoseGraph(const Pose2D& first) : poses_{first} {}

  /// \returns the new node.
  std::size_t add(const Pose2D& pose)
  {
    poses_.push_back(pose);
    return poses_.size() - 1;
  }
  /// Adds a measurement between nodes that are there; optimise() heeds it.
  void relate(const Relation& relation) { relations_.push_back(relation); }
  /// Takes back the newest relations, and sets the poses as they were.
  void restore(std::size_t relations, std::vector<Pose2D> poses);

  /// By node, in map axes.
  [[nodiscard]] const std::vector<Pose2D>& poses() const { return poses_; }
  /// Of one node, in map axes.
  [[nodiscard]] const Pose2D& pose(std::size_t node) const { return poses_[node]; }
  /// In the order in which they came.
  [[nodiscard]] const std::vector<Relation>& relations() const { return relations_; }

  /// Squared deviations by which a relation is off, 3 degrees of freedom.
  [[nodiscard]] double chi2(const Relation& relation) const;
  /// What a doubtful relation's covariance is divided by for the fit, 0 to 1; 1 of others.
  [[nodiscard]] double trust(const Relation& relation) const;

  /// Moves the poses to where the relations are met best.  Those from the `trusted`-th on count in
  /// full whatever they contradict, as new ones must to have any effect.
  void optimise(std::size_t trusted);
  /// With no relation that counts in full whatever it contradicts.
  void optimise() { optimise(relations_.size()); }

  /// Covariance of a node's pose relative to the first, in map axes.
  [[nodiscard]] Matrix3 covariance(std::size_t node) const;

 private:
  struct System;
  [[nodiscard]] System linearise(std::size_t trusted) const;

  std::vector<Pose2D> poses_;
  std::vector<Relation> relations_;
};
}  // namespace slamot::scans
