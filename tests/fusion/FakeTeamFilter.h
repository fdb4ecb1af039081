#pragma once

#include <slamot/core/Error.h>
#include <slamot/core/Team.h>
#include <slamot/math/intersection.h>

#include <cstring>
#include <vector>

namespace slamot::fusion
{
/// A robot and one target, without motion of the robot: what a Receiver needs of a filter.
class FakeTeamFilter : public core::TeamFilter
{
 public:
  explicit FakeTeamFilter(core::RobotAndTarget state) : state_(std::move(state)) {}

  core::Update process(const core::Step& step) override
  {
    state_.time = step.time;
    return {};
  }
  [[nodiscard]] core::Estimate estimate() const override { return {}; }

  [[nodiscard]] core::RobotAndTarget robotAndTarget(int target) const override
  {
    if (target != core::kNoId && target == state_.target) return state_;
    return {state_.time, core::kNoId, state_.mean.head(3), state_.cov.topLeftCorner(3, 3)};
  }

  core::Fusion fuse(const core::Evidence& e, const core::FusionOptions& options) override
  {
    evidence.push_back(e);
    if (refuses) throw core::Error(core::ExitStatus::kNonsense, "fake", "told to refuse");
    const Eigen::Index n = e.H.cols();  // 3: of the robot alone
    const Eigen::MatrixXd W = state_.cov.leftCols(n) * e.H.transpose();
    const math::IntersectionCriterion criterion{state_.cov.trace(), W.transpose() * W};
    const auto u = math::intersect(math::Intersection::kCovariance, e.H * W.topRows(n),
                                   e.innovation, e.cov, e.independent, criterion, options.omega);
    if (!u.pays) return {};
    state_.mean += W * u.gain;
    state_.cov = (u.scale * (state_.cov - W * u.reduction * W.transpose())).eval();
    return {true, u.omega};
  }

  // Constant velocity.
  void predictTarget(core::RobotAndTarget& other, double dt) const override
  {
    Eigen::MatrixXd F = Eigen::MatrixXd::Identity(other.mean.size(), other.mean.size());
    F(3, 5) = F(4, 6) = dt;
    other.mean = (F * other.mean).eval();
    other.cov = (F * other.cov * F.transpose()).eval();
    other.time += dt;
  }

  /// Its whole state, to be compared to the bit.
  [[nodiscard]] std::vector<unsigned char> bytes() const
  {
    std::vector<unsigned char> out(
        sizeof(double) * static_cast<std::size_t>(1 + state_.mean.size() + state_.cov.size()));
    std::memcpy(out.data(), &state_.time, sizeof(double));
    auto* at = out.data() + sizeof(double);
    const auto mean = sizeof(double) * static_cast<std::size_t>(state_.mean.size());
    std::memcpy(at, state_.mean.data(), mean);
    std::memcpy(at + mean, state_.cov.data(),
                sizeof(double) * static_cast<std::size_t>(state_.cov.size()));
    return out;
  }

  std::vector<core::Evidence> evidence;  ///< all that was told
  bool refuses = false;

 private:
  core::RobotAndTarget state_;
};

/// A robot at (1, 2, 0.5) with target 7 at (4, 6), of 4 or 6 coordinates (0: no target).
inline core::RobotAndTarget someEstimate(int targetSize, double time = 10)
{
  core::RobotAndTarget e;
  e.time = time;
  e.target = targetSize > 0 ? 7 : core::kNoId;
  Eigen::VectorXd mean(9);
  mean << 1, 2, 0.5, 4, 6, 0.3, -0.2, 0.01, 0.02;
  Eigen::MatrixXd root = Eigen::MatrixXd::Identity(9, 9) * 0.1;
  root.row(3).head(3) << 0.05, 0.01, -0.02;
  root.row(4).head(3) << -0.01, 0.04, 0.03;
  root.bottomRows(4) *= 0.5;
  const int n = 3 + targetSize;
  e.mean = mean.head(n);
  e.cov = (root * root.transpose()).topLeftCorner(n, n);
  return e;
}
}  // namespace slamot::fusion
