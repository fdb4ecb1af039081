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
  diagnostics_.largestWeight.reset();
  diagnostics_.resampled = false;
  std::vector<core::Pairing> pairs;
  particles_.predictAndUpdate = [&]
  {
    if (step.odometry) move(*step.odometry);
    predictTargets(dt);
    if (hasScan) takeScan(step);
    notePath(step.time, step.odometry.has_value());
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
  drawn_ = true;
}

template <class Motion>
void EngineOf<Motion>::notePath(double time, bool isNew)
{
  if (drawn_)
  {
    for (std::size_t i = 0; i < particles_.size(); ++i)
      particles_[i].path = paths_.add(particles_[i].path, particles_[i].pose);
    paths_.endDraw();
    drawn_ = false;
  }
  paths_.step(time, pending_.mean, isNew);
  if (!paths_.isDue(particles_.size())) return;
  std::vector<PathTree::Node*> ends = {&shown_};
  for (std::size_t i = 0; i < particles_.size(); ++i) ends.push_back(&particles_[i].path);
  paths_.sweep(ends);
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
  diagnostics_.largestWeight = weights_[best_];
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
template class EngineOf<models::ManoeuvringTarget>;
}  // namespace slamot::filters::rbpf
