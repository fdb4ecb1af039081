#include "Engine.h"

#include "sighting/intersectionOf.h"
#include "sighting/kinematicPrediction.h"

#include <slamot/core/Error.h>
#include <slamot/math/statistics.h>

#include <stdexcept>

// The part of the filter that takes part in a team.
namespace slamot::filters::ekf
{
namespace
{
constexpr int kRobot = core::RobotAndTarget::kRobot;
void checkEvidence(const core::Evidence& e, int size)
{
  const Eigen::Index m = e.H.rows();
  if (e.H.cols() != size) throw std::domain_error("it is of other coordinates");
  if (m < 1 || m > math::kMaxBlock || e.innovation.size() != m || e.cov.rows() != m ||
      e.cov.cols() != m || e.independent.rows() != m || e.independent.cols() != m)
    throw std::domain_error("its sizes do not agree");
  if (!e.H.allFinite() || !e.innovation.allFinite() || !e.cov.allFinite())
    throw std::domain_error("a value is not finite");
}

/// The paper fuses coordinates themselves: the place, if any, and the first ones of the target.
void checkSelection(const Eigen::MatrixXd& H, Eigen::Index first)
{
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(H.rows(), H.cols());
  for (Eigen::Index i = 0; i < H.rows(); ++i)
    if (const Eigen::Index j = i < first ? i : kRobot + i - first; j < H.cols()) expected(i, j) = 1;
  if (H.rows() < first || H != expected)
    throw std::domain_error("the paper's rule wants coordinates as they are");
}
}  // namespace

template <class Motion>
core::RobotAndTarget EngineOf<Motion>::robotAndTarget(int target) const
{
  core::RobotAndTarget out;
  out.time = times_[0];
  const Target* const found = target == core::kNoId ? nullptr : targetWith(target);
  const auto kinematics = Motion::kinematics(found ? stateOf(*found) : State{});
  const int k = found ? static_cast<int>(kinematics.value.size()) : 0;
  const auto& P = belief_.P();
  out.mean.resize(kRobot + k);
  out.cov.resize(kRobot + k, kRobot + k);
  out.mean.head<kRobot>() = belief_.x().template head<kRobot>();
  out.cov.topLeftCorner<kRobot, kRobot>() = P.template block<kRobot, kRobot>(0, 0);
  if (!found) return out;
  const int j = belief_.target(found->slot);
  const auto& J = kinematics.jacobian;
  out.target = target;
  out.mean.tail(k) = kinematics.value;
  out.cov.bottomLeftCorner(k, kRobot) = J * P.template block<kSize, kRobot>(j, 0);
  out.cov.topRightCorner(kRobot, k) = out.cov.bottomLeftCorner(k, kRobot).transpose();
  const Eigen::MatrixXd own = J * P.template block<kSize, kSize>(j, j) * J.transpose();
  out.cov.bottomRightCorner(k, k) = 0.5 * (own + own.transpose());
  return out;
}

template <class Motion>
Belief::Rows EngineOf<Motion>::rowsOf(const Eigen::MatrixXd& H, const Target* target) const
{
  Belief::Rows out{{0}, {H.leftCols<kRobot>()}};
  if (!target) return out;
  out.at.push_back(belief_.target(target->slot));
  out.columns.push_back(H.rightCols(H.cols() - kRobot) *
                        Motion::kinematics(stateOf(*target)).jacobian);
  return out;
}

template <class Motion>
core::Fusion EngineOf<Motion>::fuse(const core::Evidence& evidence,
                                    const core::FusionOptions& options)
{
  if (options.rule == core::FusionRule::kNone) return {};
  const Target* const target = targetWith(evidence.target);
  const int size =
      kRobot + (target ? static_cast<int>(Motion::kinematics(State{}).value.size()) : 0);
  try
  {
    checkEvidence(evidence, size);
    if (options.rule == core::FusionRule::kPaper) return fuseBlocks(evidence, options, target);
    const Belief::Rows H = rowsOf(evidence.H, target);
    const Eigen::MatrixXd W = belief_.product(H);
    const auto update =
        math::intersect(intersectionOf(options.rule), Belief::innovationCov(H, W),
                        evidence.innovation, evidence.cov, evidence.independent,
                        belief_.criterion(H, W, options.headingLever), options.omega);
    if (!update.pays) return {};
    belief_.fuse(H, W, update);
    wrapAngles();
    if (target) tracks_.hear(static_cast<std::size_t>(target - targets_.data()), time_);
    return {true, update.omega};
  }
  catch (const std::domain_error& e)
  {
    throw core::Error(core::ExitStatus::kNonsense, "evidence of another robot", e.what());
  }
}

// Equations (3)-(15) of the paper, as corrected: first the robot's place, then the target.
template <class Motion>
core::Fusion EngineOf<Motion>::fuseBlocks(const core::Evidence& evidence,
                                          const core::FusionOptions& options, const Target* target)
{
  const Eigen::Index rows = evidence.H.rows();
  const bool ofRobot = (evidence.H.leftCols<kRobot>().array() != 0).any();
  const Eigen::Index first = ofRobot ? 2 : 0, k = rows - first;
  checkSelection(evidence.H, first);
  if (k > 0 && (!target || k > kSize || Motion::kAngle >= 0))
    throw std::domain_error("the paper's rule wants the target's own coordinates");
  const auto block = [&](int j, Eigen::Index row, Eigen::Index size)
  {
    Eigen::MatrixXd A(size, size);
    for (int a = 0; a < size; ++a)
      for (int b = 0; b < size; ++b) A(a, b) = belief_.P()(j + a, j + b);
    return math::paperBlock(A, evidence.innovation.segment(row, size),
                            evidence.cov.block(row, row, size, size), options.omega);
  };
  // Neither changes the other's own covariance; both first, so that an error leaves all as it was.
  const int j = target ? belief_.target(target->slot) : 0;
  std::optional<math::PaperBlock> place, motion;
  if (ofRobot) place = block(0, 0, first);
  if (k > 0) motion = block(j, first, k);
  if (place) belief_.reshape(0, place->shift, place->crossFactor, place->cov);
  if (motion) belief_.reshape(j, motion->shift, motion->crossFactor, motion->cov);
  return {place || motion, std::max(place ? place->omega : 0, motion ? motion->omega : 0)};
}

template <class Motion>
void EngineOf<Motion>::predictTarget(core::RobotAndTarget& other, double dt) const
{
  predictKinematics(motion_, other, dt);
}

#define SLAMOT_TEAM_PART(Motion)                                                                   \
  template core::RobotAndTarget EngineOf<Motion>::robotAndTarget(int) const;                       \
  template core::Fusion EngineOf<Motion>::fuse(const core::Evidence&, const core::FusionOptions&); \
  template void EngineOf<Motion>::predictTarget(core::RobotAndTarget&, double) const
SLAMOT_TEAM_PART(models::DifferentialDriveTarget);
SLAMOT_TEAM_PART(models::DampedVelocityTarget);
SLAMOT_TEAM_PART(models::ConstantVelocityTarget);
SLAMOT_TEAM_PART(models::ConstantAccelerationTarget);
SLAMOT_TEAM_PART(models::ManoeuvringTarget);
#undef SLAMOT_TEAM_PART
}  // namespace slamot::filters::ekf
