#include "Engine.h"
#include "Rigid.h"

// What the filter tells of itself.
namespace slamot::filters::rbpf
{
template <class Motion>
Gaussian<Pose2D> EngineOf<Motion>::poseOf(std::size_t i) const
{
  const auto& p = particles_[i];
  Gaussian<Pose2D> pose;
  if (fromScan_)
  {
    const Vector3& m = outcomes_[i].mean;
    pose = {{m[0], m[1], m[2]}, outcomes_[i].cov};
  }
  else
  {
    const Matrix3 R = math::poseRotation(p.pose.phi);
    pose = {math::compose(p.pose, pending_.mean), R * pending_.cov * R.transpose()};
  }
  return isMoved_ ? moved(p.shift, pose) : pose;
}

template <class Motion>
void EngineOf<Motion>::updateEstimate(double time, bool afterScan)
{
  estimate_.time = time;
  const std::size_t n = particles_.size();
  const bool resampledBefore = !afterScan;
  if (resampledBefore)  // weights after a resampling are equal; outcomes_ are of the last scan
    for (std::size_t i = 0; i < n; ++i) weights_[i] = std::exp(particles_.logWeight(i));
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += weights_[i];
  fromScan_ = afterScan && scan_.size() + blobRays_.rays.size() > 0;
  PoseMoments robot;
  for (std::size_t i = 0; i < n; ++i)
  {
    weights_[i] /= sum;
    const Gaussian<Pose2D> pose = poseOf(i);
    robot.add(weights_[i], pose.mean, pose.cov);
  }
  estimate_.robot = robot.gaussian();
  spread_ = estimate_.robot.cov;
  bestMap_.frame.addTo(estimate_.robot);

  estimate_.targets.clear();
  if (hasTargetSet())
    estimateSet();
  else
    estimateTracks();
  std::sort(estimate_.targets.begin(), estimate_.targets.end(),
            [](const auto& a, const auto& b) { return a.id < b.id; });
  if (afterScan) showMap(best_);
}

template <class Motion>
void EngineOf<Motion>::estimateTracks()
{
  for (std::size_t t = 0; t < tracks_.list().size(); ++t)
  {
    if (!tracks_.list()[t].confirmed) continue;
    TargetMoments<Motion> moments;
    for (std::size_t i = 0; i < particles_.size(); ++i)
      if (isMoved_)
        moments.add(weights_[i], moved<Motion>(particles_[i].shift, particles_[i].targets[t]));
      else
        moments.add(weights_[i], particles_[i].targets[t]);
    estimate_.targets.push_back(moments.estimate(tracks_.list()[t]));
    bestMap_.frame.addTo(estimate_.targets.back());
  }
}

template <class Motion>
void EngineOf<Motion>::showMap(std::size_t particle)
{
  bestMap_.map = particles_[particle].map;
  bestMap_.shift = particles_[particle].shift;
  shown_ = particles_[particle].path;
}

template <class Motion>
std::vector<core::Pairing> EngineOf<Motion>::pairings(const core::Step& step) const
{
  using Kind = core::Pairing::Outcome;
  std::vector<core::Pairing> out;
  const auto outcome = [](std::int32_t m) {
    return m >= 0 ? Kind::kKnown : m == kNew ? Kind::kNew : Kind::kRejected;
  };
  const auto& landmarks = outcomes_[best_].landmarks;
  for (std::size_t j = 0; step.landmarks && j < landmarks.size(); ++j)
  {
    const std::int32_t m = landmarks[j];
    const int id = m >= 0      ? scan_.idOf(static_cast<std::uint32_t>(m))
                   : m == kNew ? scan_.idOf(scan_.newSlot(j))
                               : core::kNoId;
    out.push_back({false, static_cast<int>(j), outcome(m), id});
  }
  const auto& blobs = outcomes_[best_].blobs;
  for (std::size_t k = 0; step.blobs && k < blobs.size(); ++k)
    out.push_back({true, static_cast<int>(k), outcome(blobs[k]), blobIds_[k]});
  return out;
}

template <class Motion>
std::vector<core::WeightedPose> EngineOf<Motion>::particles() const
{
  std::vector<core::WeightedPose> out;
  for (std::size_t i = 0; i < weights_.size(); ++i)
  {
    const auto& p = particles_.m_particles[i].d;
    const Pose2D pose = math::compose(p.pose, pending_.mean);
    out.push_back({isMoved_ ? math::compose(p.shift, pose) : pose, 0});
  }
  double sum = 0;
  for (std::size_t i = 0; i < out.size(); ++i)
    sum += out[i].weight = std::exp(particles_.m_particles[i].log_w);
  for (auto& p : out) p.weight /= sum;
  return out;
}

template <class Motion>
std::vector<core::PathPose> EngineOf<Motion>::path() const
{
  if (drawn_) return {};  // before the first step
  const auto weightAndKin = [&](const auto& p)
  { return std::pair(p.log_w, paths_.descends(p.d.path, shown_)); };
  const auto& all = particles_.m_particles;
  const auto heaviest = std::max_element(all.begin(), all.end(),
                                         [&](const auto& a, const auto& b)
                                         { return weightAndKin(a) < weightAndKin(b); });
  std::vector<core::PathPose> out = paths_.path(heaviest->d.path);
  if (isMoved_)
    for (core::PathPose& p : out) p.pose = math::compose(heaviest->d.shift, p.pose);
  return out;
}

#define SLAMOT_ESTIMATE_PART(Motion)                                                       \
  template Gaussian<Pose2D> EngineOf<Motion>::poseOf(std::size_t) const;                   \
  template void EngineOf<Motion>::updateEstimate(double, bool);                            \
  template void EngineOf<Motion>::estimateTracks();                                        \
  template void EngineOf<Motion>::showMap(std::size_t);                                    \
  template std::vector<core::Pairing> EngineOf<Motion>::pairings(const core::Step&) const; \
  template std::vector<core::WeightedPose> EngineOf<Motion>::particles() const;            \
  template std::vector<core::PathPose> EngineOf<Motion>::path() const
SLAMOT_ESTIMATE_PART(models::DifferentialDriveTarget);
SLAMOT_ESTIMATE_PART(models::DampedVelocityTarget);
SLAMOT_ESTIMATE_PART(models::ConstantVelocityTarget);
SLAMOT_ESTIMATE_PART(models::ConstantAccelerationTarget);
SLAMOT_ESTIMATE_PART(models::ManoeuvringTarget);
#undef SLAMOT_ESTIMATE_PART
}  // namespace slamot::filters::rbpf
