#include "Engine.h"

#include <slamot/math/random.h>

// What a scan does to each particle: association, proposal, weight, map and targets.
namespace slamot::filters::rbpf
{
template <class Motion>
void EngineOf<Motion>::takeScan(const core::Step& step)
{
  for (std::size_t i = 0; i < particles_.size(); ++i)
    priors_[i] = settings_.isInformed() ? math::compose(particles_[i].pose, pending_.mean)
                                        : particles_[i].pose;
  const bool seesAny = (step.landmarks && !step.landmarks->sightings.empty()) ||
                       (step.blobs && !step.blobs->blobs.empty());
  if (settings_.isInformed() && seesAny) settleFrame();
  if (settings_.isInformed()) pendingRoot_ = math::squareRoot(pending_.cov);
  scan_.begin(step.landmarks ? &*step.landmarks : nullptr, step.time, priors_, pending_);
  blobRays_.rays.clear();
  blobRays_.blobs = step.blobs ? &step.blobs->blobs : nullptr;
  if (step.blobs)
    for (const core::Blob& b : step.blobs->blobs) blobRays_.rays.push_back(settings_.ray(b));

  targetNoise_.clear();
  for (const Track& t : tracks_.list())
    targetNoise_.push_back(settings_.noiseAfter(step.time - t.lastSeen));
  if (hasTargetSet()) beginSet(step);

  workers_.forEach(particles_.size(), [&](std::size_t i, int lane) { updateParticle(i, lane); });
  if (scan_.size() > 0 || blobRays_.rays.size() > 0)
  {
    pending_ = {};
    drawn_ = drawn_ || settings_.isInformed();
  }

  std::vector<const std::vector<std::int32_t>*> matches;
  for (const Outcome& o : outcomes_) matches.push_back(&o.landmarks);
  scan_.finish(matches);
  normalise();
  if (step.blobs && hasTargetSet())
    settleSet(step.time);
  else if (step.blobs)
    settleTracks(step.time);
}

// Before there is a map, little can tell a pose: only targets whose start is known in the map. They
// are as uncertain as the frame then, seen from the robot, and that they may tell of it is left
// out.
template <class Motion>
void EngineOf<Motion>::settleFrame()
{
  if (placed_) return;
  placed_ = true;
  const Matrix3 R = math::poseRotation(particles_[0].pose.phi);
  bestMap_.frame = MapFrame({priors_[0], R * pending_.cov * R.transpose()});
  pending_.cov.setZero();
  const auto widen = [&](State& t) { motion_.widen(t, bestMap_.frame.covAt(t.x[0], t.x[1])); };
  for (std::size_t i = 0; i < particles_.size(); ++i)
  {
    for (State& t : particles_[i].targets) widen(t);
    for (auto& c : particles_[i].mixture) widen(c.state);
  }
}

template <class Motion>
void EngineOf<Motion>::updateParticle(std::size_t i, int lane)
{
  auto& p = particles_[i];
  Outcome& out = outcomes_[i];
  Scratch& scratch = scratch_[static_cast<std::size_t>(lane)];
  const Eye prior(priors_[i]);
  out.mean = {prior.x, prior.y, prior.phi};
  out.cov.setZero();
  Matrix3 root = Matrix3::Zero();
  if (settings_.isInformed())
  {
    root = math::poseRotation(p.pose.phi) * pendingRoot_;
    out.cov = root * root.transpose();
  }
  double gain = 0;
  if (scan_.hasTracks())
  {
    math::RandomStream random{seed_, kAssociateStream, stepNumber_, i};
    gain +=
        scan_.matchTracks(p.map, prior, root, p.followed, random, scratch.tracks, out.landmarks);
  }
  else
    scan_.match(p.map, prior, root, scratch.match, out.landmarks);
  matchTargets(i, prior, scratch);
  const bool sampled = settings_.isInformed() && scan_.size() + blobRays_.rays.size() > 0;
  gain += sampled && settings_.marginalWeight ? placeByMarginal(i, root, scratch)
                                              : placeBySample(i, root, scratch, sampled, lane);
  double& logWeight = particles_.logWeight(i);
  logWeight = settings_.weightExponent * logWeight + gain;

  const Eye eye = sampled ? Eye(p.pose) : prior;
  if (!settings_.intensity)
    scan_.apply(p.map, eye, out.landmarks,
                sampled && settings_.marginalWeight ? nullptr : &scratch.innovations, lane);
  for (std::size_t k = 0; k < out.blobs.size() && !hasTargetSet(); ++k)
    if (out.blobs[k] >= 0)
      correctTarget(motion_, p.targets[static_cast<std::size_t>(out.blobs[k])], eye,
                    blobRays_.rays[k]);
}

template <class Motion>
void EngineOf<Motion>::matchTargets(std::size_t i, const Eye& prior, Scratch& scratch)
{
  if (hasTargetSet()) return matchSet(i, prior, scratch);
  const Matrix3* poseCov = settings_.isInformed() ? &outcomes_[i].cov : nullptr;
  matchBlobs(prior, blobRays_, tracks_.list(), particles_[i].targets, settings_.gates, poseCov,
             scratch.match.candidates, outcomes_[i].blobs);
}

// The weight is what the proposal's Gaussian integrates to: it does not depend on the sample, but
// for a set of targets, of which the Gaussian knows the pairs alone.
template <class Motion>
double EngineOf<Motion>::placeByMarginal(std::size_t i, const Matrix3& root, Scratch& scratch)
{
  Outcome& out = outcomes_[i];
  const Eye prior(priors_[i]);
  PoseUpdate update;
  double gain =
      scan_.weigh(particles_[i].map, prior, out.cov, out.landmarks, scratch.innovations, &update);
  gain += weighTargets(i, prior, &update, scratch);
  const PoseUpdate::Result r = update.solve(root);
  samplePose(i, r);
  if (hasTargetSet()) gain += takeOverPairs(i, prior, scratch);
  return gain + r.logGain;
}

// The weight is the likelihood at the pose, times the prior's density there over the proposal's.
template <class Motion>
double EngineOf<Motion>::placeBySample(std::size_t i, const Matrix3& root, Scratch& scratch,
                                       bool sampled, int lane)
{
  auto& p = particles_[i];
  Outcome& out = outcomes_[i];
  double gain = 0;
  if (sampled)
  {
    const Eye prior(priors_[i]);
    PoseUpdate update = scan_.gather(p.map, prior, root, out.landmarks);
    (void)weighTargets(i, prior, &update, scratch);
    const PoseUpdate::Result r = update.solve(root);
    const Vector3 u = samplePose(i, r), w = r.white + r.whiteRoot * u;
    gain = 0.5 * (u.squaredNorm() - w.squaredNorm()) + r.logRoot;
  }
  const Eye eye(sampled ? p.pose : priors_[i]);
  gain += weighTargets(i, eye, nullptr, scratch);
  if (settings_.intensity)
    return gain + intensity_.update(p.map, eye, out.landmarks, scratch.intensity, lane);
  return gain +
         scan_.weigh(p.map, eye, Matrix3::Zero(), out.landmarks, scratch.innovations, nullptr);
}

template <class Motion>
double EngineOf<Motion>::weighTargets(std::size_t i, const Eye& eye, PoseUpdate* update,
                                      Scratch& scratch)
{
  if (hasTargetSet())
    return update ? shapeBySet(i, eye, *update, scratch) : takeIntoSet(i, eye, scratch);
  double sum = 0;
  const auto& p = particles_[i];
  const auto& blobs = outcomes_[i].blobs;
  for (std::size_t k = 0; k < blobs.size(); ++k)
  {
    const Ray& ray = blobRays_.rays[k];
    // A pair at the gate's edge: what a blob out of all gates counts, so that no particle gains by
    // losing a target.
    const double logNew =
        -0.5 * settings_.gates.outer - 0.5 * std::log(ray.varRange * ray.varBearing);
    Innovation o;
    const auto t = static_cast<std::size_t>(blobs[k]);
    if (blobs[k] < 0 || !tracks_.list()[t].confirmed ||
        !innovateTarget(eye, ray, p.targets[t], o, nullptr, targetNoise_[t],
                        update ? &outcomes_[i].cov : nullptr))
    {
      sum += blobs[k] == kNew || blobs[k] == kRejected ? logNew : 0.0;
      continue;
    }
    sum += logDensity(o, ray.hasRange);
    if (update) update->add(o);
  }
  return sum;
}

/// \return the standard normal numbers drawn.
template <class Motion>
Vector3 EngineOf<Motion>::samplePose(std::size_t i, const PoseUpdate::Result& r)
{
  Outcome& out = outcomes_[i];
  out.mean += r.shift;
  out.cov = r.root * r.root.transpose();
  math::RandomStream random{seed_, kSampleStream, stepNumber_, i};
  const Vector3 u = random.normal3(), x = out.mean + r.root * u;
  particles_[i].pose = {x[0], x[1], math::wrapToPi(x[2])};
  return u;
}

#define SLAMOT_SCAN_PART(Motion) template void EngineOf<Motion>::takeScan(const core::Step&)
SLAMOT_SCAN_PART(models::DifferentialDriveTarget);
SLAMOT_SCAN_PART(models::DampedVelocityTarget);
SLAMOT_SCAN_PART(models::ConstantVelocityTarget);
SLAMOT_SCAN_PART(models::ConstantAccelerationTarget);
SLAMOT_SCAN_PART(models::ManoeuvringTarget);
#undef SLAMOT_SCAN_PART
}  // namespace slamot::filters::rbpf
