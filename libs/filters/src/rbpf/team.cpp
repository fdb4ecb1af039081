#include "Engine.h"
#include "Rigid.h"
#include "sighting/kinematicPrediction.h"

#include <slamot/core/Error.h>
#include <slamot/math/eigensystem.h>

#include <algorithm>
#include <stdexcept>

// The part of the filter that takes part in a team.
//
// Which of its particles is right, the filter tells by sightings of things relative to the robot;
// where all of it lies in the map axes, they can't tell, but a team can.  So a fusion leaves each
// particle as it is relative to its robot, path, map and all, and moves it as one rigid body, its
// `shift`, by what the moments of robot and target say; the target alone moves besides.  Landmarks'
// covariances, given a particle's path, stay: what was told knows of landmarks by the path only.
// The next scan finds the particle in its map where it was, and no particle is lost by a fusion.
namespace slamot::filters::rbpf
{
namespace
{
constexpr int kRobot = core::RobotAndTarget::kRobot;

/// Of a covariance, where it is not exact.
template <int N>
Eigen::Matrix<double, N, N> inverseOf(const Eigen::Matrix<double, N, N>& cov)
{
  const auto [values, vectors] = math::eigensystem<N>(cov);
  const double least = 1e-14 * values[N - 1];
  const Eigen::Matrix<double, N, 1> inverses =
      values.unaryExpr([least](double v) { return v > least ? 1 / v : 0.0; });
  return vectors * inverses.asDiagonal() * vectors.transpose();
}

/// The linear map, near the identity, that gives errors of covariance `from` that of `to`.
Matrix3 transport(const Matrix3& from, const Matrix3& to)
{
  const auto [values, vectors] = math::eigensystem<3>(from);
  Vector3 inverses = Vector3::Zero();
  for (int j = 0; j < 3; ++j)
    if (values[j] > 1e-12 * values[2]) inverses[j] = 1 / std::sqrt(values[j]);
  return math::squareRoot(to) * vectors * inverses.asDiagonal() * vectors.transpose();
}
}  // namespace

template <class Motion>
std::optional<std::size_t> EngineOf<Motion>::trackWith(int id) const
{
  for (std::size_t t = 0; id != core::kNoId && t < tracks_.list().size(); ++t)
  {
    const Track& track = tracks_.list()[t];
    if (!track.confirmed || !track.identified || track.id != id) continue;
    for (const auto& p : particles_.m_particles)
      if (!Motion::hasVelocity(p.d.targets[t])) return {};
    return t;
  }
  return {};
}

template <class Motion>
typename EngineOf<Motion>::Joint EngineOf<Motion>::jointOf(const Particle<State>& p,
                                                           std::optional<std::size_t> track) const
{
  const Pose2D pose = math::compose(p.shift, math::compose(p.pose, pending_.mean));
  Joint out = Joint::Zero();
  out.template head<kRobot>() << pose.x, pose.y,
      estimate_.robot.mean.phi + math::wrapToPi(pose.phi - estimate_.robot.mean.phi);
  if (track)
    out.template tail<kTarget>() =
        Motion::kinematics(moved<Motion>(p.shift, p.targets[*track])).value;
  return out;
}

template <class Motion>
core::RobotAndTarget EngineOf<Motion>::robotAndTarget(int target) const
{
  for (const auto& kept : kept_)
    if (kept.target == target) return kept;
  if (const auto track = trackWith(target)) return jointMoments(*track);
  const Pose2D& pose = estimate_.robot.mean;
  core::RobotAndTarget out;
  out.time = estimate_.time;
  out.mean = Vector3(pose.x, pose.y, pose.phi);
  out.cov = estimate_.robot.cov;
  return out;
}

// The robot's part is the estimate's, which after a scan is of the Gaussians that poses were drawn
// from: less rough than that of the poses drawn, which the targets go with.
template <class Motion>
core::RobotAndTarget EngineOf<Motion>::jointMoments(std::size_t track) const
{
  double sum = 0;
  Joint mean = Joint::Zero();
  Eigen::Matrix<double, kRobot + kTarget, kRobot + kTarget> cov;
  cov.setZero();
  for (std::size_t i = 0; i < particles_.size(); ++i)
  {
    if (!(weights_[i] > 0)) continue;
    const auto& p = particles_[i];
    const Joint d = jointOf(p, track) - mean;
    sum += weights_[i];
    const double share = weights_[i] / sum;
    mean += share * d;
    cov += weights_[i] * (1 - share) * d * d.transpose();
    const State s = moved<Motion>(p.shift, p.targets[track]);
    const auto k = Motion::kinematics(s);
    cov.template bottomRightCorner<kTarget, kTarget>() +=
        weights_[i] * (k.jacobian * s.P * k.jacobian.transpose()).eval();
  }
  cov /= sum;
  if (fromScan_)
  {
    const Matrix3 B = transport(cov.template topLeftCorner<kRobot, kRobot>(), spread_);
    cov.template topRightCorner<kRobot, kTarget>() =
        (B * cov.template topRightCorner<kRobot, kTarget>()).eval();
  }
  const Pose2D& pose = estimate_.robot.mean;
  mean.template head<kRobot>() << pose.x, pose.y, pose.phi;
  core::RobotAndTarget out;
  out.time = estimate_.time;
  out.target = tracks_.list()[track].id;
  out.mean = mean;
  out.cov = cov;
  const Matrix3 frame = bestMap_.frame.covAt(pose.x, pose.y);
  // Here and below sizes are told: products of unknown ones take a second each to build.
  const Eigen::Matrix<double, kTarget, kRobot> T = lever(out.mean.tail(kTarget), {pose.x, pose.y});
  out.cov.template topRightCorner<kRobot, kTarget>() += frame * T.transpose();
  out.cov.template bottomRightCorner<kTarget, kTarget>() += T * frame * T.transpose();
  out.cov = out.cov.template selfadjointView<Eigen::Upper>();
  out.cov.template topLeftCorner<kRobot, kRobot>() = estimate_.robot.cov;
  return out;
}

template <class Motion>
CommonErrors EngineOf<Motion>::commonErrors(const core::RobotAndTarget& own,
                                            std::optional<std::size_t> track) const
{
  const Point2D at(own.mean[0], own.mean[1]);
  CommonErrors out;
  out.frame = bestMap_.frame.covAt(at.x, at.y);
  out.lever = lever(own.mean.tail(own.targetSize()), at);
  Eigen::Matrix<double, kTarget, kTarget> target;
  target.setZero();
  double sum = 0;
  for (std::size_t i = 0; track && i < particles_.size(); ++i)
  {
    const auto& p = particles_[i];
    const double weight = std::exp(particles_.m_particles[i].log_w);
    const State s = moved<Motion>(p.shift, p.targets[*track]);
    const auto J = Motion::kinematics(s).jacobian;
    target += weight * (J * s.P * J.transpose()).eval();
    sum += weight;
  }
  if (track)
    out.target = target / sum;
  else
    out.target.setZero(own.targetSize(), own.targetSize());
  return out;
}

template <class Motion>
core::Fusion EngineOf<Motion>::fuse(const core::Evidence& evidence,
                                    const core::FusionOptions& options)
{
  if (options.rule == core::FusionRule::kNone) return {};
  try
  {
    if (settings_.isInformed() && !placed_)
      throw std::domain_error("it comes before the robot's first scan");
    const std::optional<std::size_t> track = trackWith(evidence.target);
    const core::RobotAndTarget own = robotAndTarget(track ? evidence.target : core::kNoId);
    const JointFusion fusion = fuseJoint(own, commonErrors(own, track), evidence, options);
    if (!fusion.pays) return {};
    carryOut(fusion, track, own);
    return {true, fusion.omega};
  }
  catch (const std::domain_error& e)
  {
    throw core::Error(core::ExitStatus::kNonsense, "evidence of another robot", e.what());
  }
}

template <class Motion>
void EngineOf<Motion>::carryOut(const JointFusion& fusion, std::optional<std::size_t> track,
                                const core::RobotAndTarget& own)
{
  const bool atRest = pending_.mean == Pose2D() && pending_.cov.isZero(0);
  if (!atRest) samplePending(kFuseStream);
  notePath(estimate_.time, false);  // poses as they were left, before all is moved
  const Eigen::Index size = own.mean.size();
  double sum = 0;
  Joint mean = Joint::Zero();
  for (std::size_t i = 0; i < particles_.size(); ++i)
  {
    const double weight = std::exp(particles_.logWeight(i));
    sum += weight;
    mean += weight / sum * (jointOf(particles_[i], track) - mean);
  }
  workers_.forEach(particles_.size(),
                   [&](std::size_t i, int)
                   {
                     auto& p = particles_[i];
                     const Joint d = jointOf(p, track) - mean;
                     Joint by = Joint::Zero();
                     by.head(size) = fusion.shift - fusion.gain * d.head(size);
                     shiftParticle(p, track, by, fusion);
                   });
  bestMap_.frame = MapFrame({{own.mean[0] + fusion.shift[0], own.mean[1] + fusion.shift[1],
                              own.mean[2] + fusion.shift[2]},
                             fusion.frame});
  isMoved_ = true;
  kept_.clear();
  updateEstimate(estimate_.time, false);
  const auto heaviest = std::max_element(weights_.begin(), weights_.end());
  showMap(static_cast<std::size_t>(heaviest - weights_.begin()));
}

template <class Motion>
void EngineOf<Motion>::shiftParticle(Particle<State>& p, std::optional<std::size_t> track,
                                     const Joint& by, const JointFusion& fusion) const
{
  const Joint joint = jointOf(p, track) + by;
  const Pose2D pose(joint[0], joint[1], math::wrapToPi(joint[2]));
  p.shift = motionBetween(p.pose, pose);
  if (!track) return;
  State& s = p.targets[*track];
  const auto R = pairRotation<kTarget>(-p.shift.phi);
  Kinematics value = joint.template tail<kTarget>();
  value[0] -= p.shift.x;
  value[1] -= p.shift.y;
  value = (R * value).eval();
  const Eigen::Matrix<double, kTarget, kTarget> own = fusion.target, cov = R * own * R.transpose();
  if constexpr (Motion::kAngle < 0)
  {
    s.x = value;
    s.P = 0.5 * (cov + cov.transpose());
  }
  else  // the other coordinates follow by regression
  {
    const auto now = Motion::kinematics(s);
    const Eigen::Matrix<double, State::kSize, kTarget> PJt = s.P * now.jacobian.transpose();
    const Eigen::Matrix<double, kTarget, kTarget> Y = now.jacobian * PJt;
    const Eigen::Matrix<double, State::kSize, kTarget> G = PJt * inverseOf<kTarget>(Y);
    s.x += G * (value - now.value);
    s.x[Motion::kAngle] = math::wrapToPi(s.x[Motion::kAngle]);
    s.P += G * (cov - Y) * G.transpose();
    s.P = (0.5 * (s.P + s.P.transpose())).eval();
  }
}

template <class Motion>
void EngineOf<Motion>::predictTarget(core::RobotAndTarget& other, double dt) const
{
  predictKinematics(motion_, other, dt);
}

#define SLAMOT_TEAM_PART(Motion)                                                                   \
  template std::optional<std::size_t> EngineOf<Motion>::trackWith(int) const;                      \
  template core::RobotAndTarget EngineOf<Motion>::jointMoments(std::size_t) const;                 \
  template core::RobotAndTarget EngineOf<Motion>::robotAndTarget(int) const;                       \
  template core::Fusion EngineOf<Motion>::fuse(const core::Evidence&, const core::FusionOptions&); \
  template void EngineOf<Motion>::predictTarget(core::RobotAndTarget&, double) const
SLAMOT_TEAM_PART(models::DifferentialDriveTarget);
SLAMOT_TEAM_PART(models::DampedVelocityTarget);
SLAMOT_TEAM_PART(models::ConstantVelocityTarget);
SLAMOT_TEAM_PART(models::ConstantAccelerationTarget);
SLAMOT_TEAM_PART(models::ManoeuvringTarget);
#undef SLAMOT_TEAM_PART
}  // namespace slamot::filters::rbpf
