#include "Engine.h"

#include <slamot/core/checkStep.h>
#include <slamot/math/random.h>

#include <mrpt/random/RandomGenerators.h>

#include <limits>

namespace slamot::filters::rbpf
{
namespace
{
constexpr double kLongestUnsampledTurn = 0.2;  // [rad] deviation of the pending heading
constexpr TargetSetSettings kNoSet{};

double meanStd(const Gaussian<Pose2D>& g)
{
  return std::sqrt(std::max(0.0, 0.5 * (g.cov(0, 0) + g.cov(1, 1))));
}
}  // namespace

template <class Motion>
EngineOf<Motion>::EngineOf(const Settings& settings, const Motion& motion,
                           const core::FilterContext& context)
    : settings_(settings),
      motion_(motion),
      seed_(context.seed),
      workers_(context.threads),
      pool_(workers_.lanes()),
      particles_(pool_),
      tracks_(settings.tracks),
      scan_(settings_, pool_, workers_.lanes()),
      intensity_(settings_, scan_, pool_),
      labels_(settings.targetSet.value_or(TargetSetSettings{}), settings.tracks),
      mixture_(settings_.targetSet ? *settings_.targetSet : kNoSet, settings_.gates, motion_,
               labels_),
      scratch_(static_cast<std::size_t>(workers_.lanes())),
      bestMap_(settings_, scan_)
{
  start(context);
}

template <class Motion>
void EngineOf<Motion>::start(const core::FilterContext& context)
{
  const auto n = static_cast<std::size_t>(settings_.particles);
  const Gaussian<Pose2D> robot = context.starts.robotPose();
  // Drawn in the robot's own axes, so that another map frame gives the same particles, rotated.
  const Matrix3 R = math::poseRotation(robot.mean.phi);
  const Matrix3 bodyCov = R.transpose() * robot.cov * R, L = R * math::squareRoot(bodyCov);
  particles_.m_particles.resize(n);
  outcomes_.resize(n);
  priors_.resize(n);
  weights_.assign(n, 1.0 / static_cast<double>(n));
  const double time = context.starts.time.value_or(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < n; ++i)
  {
    auto& p = particles_[i];
    particles_.logWeight(i) = 0;
    p.pose = robot.mean;
    p.map.detach(pool_.newToken());
    if (!settings_.isInformed())
    {
      math::RandomStream random{seed_, kStartStream, i};
      const Vector3 d = L * random.normal3();
      p.pose = {p.pose.x + d[0], p.pose.y + d[1], math::wrapToPi(p.pose.phi + d[2])};
    }
  }
  startTargets(context.starts);
  if (settings_.isInformed()) pending_.cov = bodyCov;
  particles_.beforeSubstitution = [this]
  {
    for (std::size_t t = 0; t < tracks_.list().size(); ++t)
      if (trackWith(tracks_.list()[t].id) == t) kept_.push_back(jointMoments(t));
  };
  estimate_.landmarks = &bestMap_;
  diagnostics_.particles = settings_.particles;
  updateEstimate(time, false);
}

template <class Motion>
void EngineOf<Motion>::startTargets(const core::Starts& starts)
{
  for (const auto& [id, start] : starts.targets)
  {
    if (!start.value[core::ObjectStart::kX] || !start.value[core::ObjectStart::kY]) continue;
    const double time = starts.time.value_or(0);
    const State state = motion_.start(start);
    if (hasTargetSet())
      labels_.addStart(id, time);
    else
      tracks_.addStart(id, time);
    for (std::size_t i = 0; i < particles_.size(); ++i)
      if (hasTargetSet())
        particles_[i].mixture.push_back({state, 1.0, labels_.key(labels_.list().size() - 1)});
      else
        particles_[i].targets.push_back(state);
  }
}

template <class Motion>
core::Update EngineOf<Motion>::process(const core::Step& step)
{
  core::checkStep(step, estimate_.time);
  const double dt = std::isfinite(estimate_.time) ? step.time - estimate_.time : 0.0;
  const bool hasScan =
      (step.landmarks && (!step.landmarks->sightings.empty() || settings_.detection > 0)) ||
      (step.blobs && (!step.blobs->blobs.empty() || hasTargetSet()));
  ++stepNumber_;
  kept_.clear();
  diagnostics_.ess.reset();
  diagnostics_.resampled = false;
  std::vector<core::Pairing> pairs;
  particles_.predictAndUpdate = [&]
  {
    if (step.odometry) move(*step.odometry);
    predictTargets(dt);
    if (hasScan) takeScan(step);
    if (step.blobs && hasTargetSet())
      dropLostLabels(step.time);
    else if (step.blobs)
      dropLostTracks(step.time);
    updateEstimate(step.time, hasScan);
    if (hasScan) pairs = pairings(step);
  };
  if (!hasScan)
    particles_.predictAndUpdate();  // weights stay: nothing to resample
  else
  {
    // MRPT resamples with its thread's own generator: seeded here, it depends on our seed alone.
    math::RandomStream random{seed_, kResampleStream, stepNumber_};
    ::mrpt::random::getRandomGenerator().randomize(static_cast<std::uint32_t>(random() >> 32));
    const std::uint64_t before = resamplings_;
    ::mrpt::bayes::CParticleFilter filter;
    filter.m_options = settings_.resampling;
    filter.setVerbosityLevel(::mrpt::system::LVL_ERROR);
    filter.executeOn(particles_, nullptr, nullptr, nullptr);
    diagnostics_.resampled = particles_.substitutions != before;
    resamplings_ = particles_.substitutions;
    collectGarbage();
  }
  return {estimate_, std::move(pairs), diagnostics_};
}

template <class Motion>
void EngineOf<Motion>::move(const Gaussian<Pose2D>& increment)
{
  pending_ = math::compose(pending_, increment);
  scan_.move(increment);
  if (settings_.isInformed() && std::sqrt(pending_.cov(2, 2)) < kLongestUnsampledTurn) return;
  placed_ = true;
  samplePending(kMoveStream);
}

template <class Motion>
void EngineOf<Motion>::samplePending(std::uint64_t stream)
{
  const Matrix3 L = math::squareRoot(pending_.cov);
  const Pose2D mean = pending_.mean;
  workers_.forEach(particles_.size(),
                   [&](std::size_t i, int)
                   {
                     math::RandomStream random{seed_, stream, stepNumber_, i};
                     const Vector3 d = L * random.normal3();
                     Pose2D& pose = particles_[i].pose;
                     pose = math::compose(pose, {mean.x + d[0], mean.y + d[1], mean.phi + d[2]});
                   });
  pending_ = {};
}

template <class Motion>
void EngineOf<Motion>::predictTargets(double dt)
{
  if (dt <= 0 || (tracks_.list().empty() && labels_.list().empty())) return;
  workers_.forEach(particles_.size(),
                   [&](std::size_t i, int)
                   {
                     for (State& t : particles_[i].targets) motion_.predict(t, dt);
                     mixture_.predict(particles_[i].mixture, dt);
                   });
}

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
  if (scan_.size() > 0 || blobRays_.rays.size() > 0) pending_ = {};

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
  particles_.logWeight(i) += gain;

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
        !innovateTarget(eye, ray, p.targets[t], o, nullptr, targetNoise_[t]))
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

template <class Motion>
void EngineOf<Motion>::normalise()
{
  particles_.normalizeWeights();
  double sum = 0;
  best_ = 0;
  for (std::size_t i = 0; i < particles_.size(); ++i)
  {
    weights_[i] = std::exp(particles_.logWeight(i));
    sum += weights_[i];
    if (weights_[i] > weights_[best_]) best_ = i;
  }
  double squares = 0;
  for (double& w : weights_)
  {
    w /= sum;
    squares += w * w;
  }
  diagnostics_.ess = 1.0 / squares;
}

template <class Motion>
std::vector<double> EngineOf<Motion>::voteShares(std::size_t blob, std::size_t known) const
{
  std::vector<double> share(known + 2, 0.0);  // the tracks, then new, then rejected
  for (std::size_t i = 0; i < outcomes_.size(); ++i)
  {
    const std::int32_t m = outcomes_[i].blobs[blob];
    const std::size_t at =
        m >= 0 ? static_cast<std::size_t>(m) : share.size() - (m == kNew ? 2 : 1);
    share[at] += weights_[i];
  }
  return share;
}

template <class Motion>
void EngineOf<Motion>::settleTracks(double time)
{
  const std::size_t known = tracks_.list().size();
  blobIds_.assign(blobRays_.rays.size(), core::kNoId);
  for (std::size_t k = 0; k < blobRays_.rays.size(); ++k)
  {
    const core::Blob& blob = (*blobRays_.blobs)[k];
    const auto share = voteShares(k, known);
    const auto winner =
        static_cast<std::size_t>(std::max_element(share.begin(), share.end()) - share.begin());
    if (winner < known)
    {
      tracks_.hit(winner, blob, time);
      blobIds_[k] = tracks_.list()[winner].id;
    }
    else if (winner == known)
    {
      const Ray& ray = blobRays_.rays[k];
      tracks_.add(blob, time);
      blobIds_[k] = tracks_.list().back().id;
      for (std::size_t i = 0; i < particles_.size(); ++i)
        particles_[i].targets.push_back(motion_.birth(invert(Eye(particles_[i].pose), ray)));
    }
    else if (winner == known + 1)
      tracks_.reject(blob);
  }
}

template <class Motion>
void EngineOf<Motion>::dropLostTracks(double time)
{
  for (std::size_t t = tracks_.list().size(); t-- > 0;)
  {
    TargetMoments<Motion> moments;
    for (std::size_t i = 0; i < particles_.size(); ++i)
      moments.add(weights_[i], particles_[i].targets[t]);
    const double std = meanStd(moments.estimate(tracks_.list()[t]).pose);
    if (!tracks_.isLost(t, time, std)) continue;
    tracks_.erase(t);
    for (std::size_t i = 0; i < particles_.size(); ++i)
      particles_[i].targets.erase(particles_[i].targets.begin() + static_cast<std::ptrdiff_t>(t));
  }
}

template <class Motion>
void EngineOf<Motion>::collectGarbage()
{
  if (!maps::LandmarkCollector::isDue(pool_)) return;
  maps::LandmarkCollector collector(pool_);
  for (std::size_t i = 0; i < particles_.size(); ++i) collector.mark(particles_[i].map);
  collector.mark(bestMap_.map);
  collector.sweep();
  scan_.releaseUnoccupied(collector.occupied());
}

template class EngineOf<models::DifferentialDriveTarget>;
template class EngineOf<models::DampedVelocityTarget>;
template class EngineOf<models::ConstantVelocityTarget>;
template class EngineOf<models::ConstantAccelerationTarget>;
}  // namespace slamot::filters::rbpf
