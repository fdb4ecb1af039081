#include "Engine.h"
#include "Rigid.h"

// Targets as a random finite set: what the particles' mixtures have to do with poses, with one
// another, and with what is reported.
namespace slamot::filters::rbpf
{
template <class Motion>
void EngineOf<Motion>::beginSet(const core::Step& step)
{
  if (!step.blobs) return;
  std::vector<double> noise;
  for (const Track& t : labels_.list())
    noise.push_back(settings_.noiseAfter(step.time - t.lastSeen));
  mixture_.begin(*step.blobs, blobRays_, stepNumber_, std::move(noise));
}

// Of a confirmed target, the heaviest component stands for all; those not confirmed tell a pose
// nothing, but explain blobs in the weight.
template <class Motion>
void EngineOf<Motion>::matchSet(std::size_t i, const Eye& prior, Scratch& scratch)
{
  const Matrix3* poseCov = settings_.isInformed() ? &outcomes_[i].cov : nullptr;
  const auto innovate = [&](std::size_t k, std::size_t t, Innovation& o)
  {
    if (!labels_.list()[t].confirmed) return false;
    const auto* c = mixture_.heaviest(particles_[i].mixture, labels_.key(t));
    return c && innovateTarget(prior, blobRays_.rays[k], c->state, o, poseCov);
  };
  matchBlobs(blobRays_, labels_.list(), settings_.gates, innovate, scratch.match.candidates,
             outcomes_[i].blobs);
}

/// Takes the pairs into the proposal.  \return log of their likelihood at the prior pose.
template <class Motion>
double EngineOf<Motion>::shapeBySet(std::size_t i, const Eye& prior, PoseUpdate& update,
                                    Scratch& scratch) const
{
  double sum = 0;
  scratch.paired.clear();
  const auto& blobs = outcomes_[i].blobs;
  for (std::size_t k = 0; k < blobs.size(); ++k)
  {
    if (blobs[k] < 0) continue;
    const auto t = static_cast<std::size_t>(blobs[k]);
    const auto* c = mixture_.heaviest(particles_[i].mixture, labels_.key(t));
    Innovation o;
    if (!innovateTarget(prior, blobRays_.rays[k], c->state, o, nullptr, mixture_.noise(t),
                        &outcomes_[i].cov))
      continue;
    sum += logDensity(o, blobRays_.rays[k].hasRange);
    update.add(o);
    scratch.paired.emplace_back(o, blobRays_.rays[k].hasRange);
  }
  return sum;
}

/// Takes the blobs into a particle's mixture.  \return log of the particle's weight by them.
template <class Motion>
double EngineOf<Motion>::takeIntoSet(std::size_t i, const Eye& eye, Scratch& scratch)
{
  if (!blobRays_.blobs) return 0;
  return mixture_.update(particles_[i].mixture, eye, outcomes_[i].blobs, scratch.mixture);
}

/// The same at the sampled pose, less what the pairs that shaped it have in the marginal already:
/// a sample's weight is its likelihood times prior over proposal, and the proposal is prior times
/// pairs over the marginal.
template <class Motion>
double EngineOf<Motion>::takeOverPairs(std::size_t i, const Eye& prior, Scratch& scratch)
{
  const Pose2D& at = particles_[i].pose;
  const Vector3 d(at.x - prior.x, at.y - prior.y, math::wrapToPi(at.phi - prior.phi));
  double pairs = 0;
  for (const auto& [taken, hasRange] : scratch.paired)
  {
    Innovation o = shifted(taken, d);
    o.d2 = o.form() + o.excess;
    pairs += logDensity(o, hasRange);
  }
  return takeIntoSet(i, Eye(at), scratch) - pairs;
}

template <class Motion>
void EngineOf<Motion>::settleSet(double time)
{
  const std::size_t known = labels_.list().size();
  blobIds_.assign(blobRays_.rays.size(), core::kNoId);
  std::vector<std::uint64_t> keys(blobRays_.rays.size(), 0);
  for (std::size_t k = 0; k < keys.size(); ++k)
  {
    const auto share = voteShares(k, known);
    const auto winner =
        static_cast<std::size_t>(std::max_element(share.begin(), share.end()) - share.begin());
    keys[k] = winner < known ? labels_.key(winner) : mixture_.birthKey(k);
    if (winner < known) labels_.hit(winner, (*blobRays_.blobs)[k], time);
  }
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (mayStart(blobRays_, k)) labels_.add(mixture_.birthKey(k), (*blobRays_.blobs)[k], time);
  settleLabels();
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (const std::size_t at = labels_.find(keys[k]); at != TargetLabels::kNone)
      blobIds_[k] = labels_.list()[at].id;
}

// The older of two labels on one target stays: one not confirmed yet becomes part of it, one that
// is confirmed is hidden as long as they are near.
template <class Motion>
void EngineOf<Motion>::settleLabels()
{
  hidden_.clear();
  std::vector<Summary> of = summarise();
  std::vector<std::uint64_t> gone;
  std::vector<std::size_t> shown;
  for (std::size_t t = 0; t < of.size(); ++t)
  {
    if (!(of[t].existence > 0))
    {
      gone.push_back(labels_.key(t));
      continue;
    }
    const Track& track = labels_.list()[t];
    const core::TargetEstimate here = of[t].moments.estimate(track);
    const auto isSame = [&](std::size_t older)
    {
      const core::TargetEstimate there = of[older].moments.estimate(labels_.list()[older]);
      return of[older].existence + of[t].existence < kMostOfOneTarget &&
             areOne(there, here, *settings_.targetSet);
    };
    const auto older = std::find_if(shown.begin(), shown.end(), isSame);
    if (older != shown.end() && !track.confirmed)
    {
      absorb(t, *older);
      of[*older].existence += of[t].existence;
      gone.push_back(labels_.key(t));
      continue;
    }
    if (older != shown.end()) hidden_.push_back(labels_.key(t));
    shown.push_back(t);
  }
  for (const std::size_t t : shown) labels_.settle(t, of[t].existence);
  dropLabels(gone);
}

template <class Motion>
void EngineOf<Motion>::absorb(std::size_t younger, std::size_t older)
{
  const std::uint64_t from = labels_.key(younger), to = labels_.key(older);
  for (std::size_t i = 0; i < particles_.size(); ++i)
    for (auto& c : particles_[i].mixture)
      if (c.label == from) c.label = to;
}

template <class Motion>
std::vector<typename EngineOf<Motion>::Summary> EngineOf<Motion>::summarise() const
{
  std::vector<Summary> out(labels_.list().size());
  std::vector<std::size_t> last(out.size(), particles_.size());  // the particle seen last
  for (std::size_t i = 0; i < particles_.size(); ++i)
  {
    if (!(weights_[i] > 0)) continue;
    const auto& p = particles_[i];
    for (const auto& c : p.mixture)
    {
      const std::size_t t = labels_.find(c.label);
      out[t].existence += weights_[i] * c.weight;
      if (last[t] == i) continue;  // the heaviest comes first
      last[t] = i;
      out[t].moments.add(weights_[i] * c.weight,
                         isMoved_ ? moved<Motion>(p.shift, c.state) : c.state);
    }
  }
  return out;
}

template <class Motion>
void EngineOf<Motion>::dropLostLabels(double time)
{
  const std::vector<Summary> of = summarise();
  std::vector<std::uint64_t> lost;
  for (std::size_t t = 0; t < of.size(); ++t)
  {
    const Matrix3 cov = of[t].moments.estimate(labels_.list()[t]).pose.cov;
    if (labels_.isLost(t, time, std::sqrt(std::max(0.0, 0.5 * (cov(0, 0) + cov(1, 1))))))
      lost.push_back(labels_.key(t));
  }
  dropLabels(lost);
}

template <class Motion>
void EngineOf<Motion>::dropLabels(const std::vector<std::uint64_t>& keys)
{
  for (std::size_t i = 0; i < particles_.size() && !keys.empty(); ++i)
  {
    auto& mixture = particles_[i].mixture;
    const auto isLost = [&](const auto& c)
    { return std::find(keys.begin(), keys.end(), c.label) != keys.end(); };
    mixture.erase(std::remove_if(mixture.begin(), mixture.end(), isLost), mixture.end());
  }
  for (const std::uint64_t key : keys) labels_.erase(labels_.find(key));
}

template <class Motion>
void EngineOf<Motion>::estimateSet()
{
  const std::vector<Summary> of = summarise();
  for (std::size_t t = 0; t < of.size(); ++t)
  {
    const bool isHidden =
        std::find(hidden_.begin(), hidden_.end(), labels_.key(t)) != hidden_.end();
    if (!labels_.list()[t].confirmed || isHidden || !(of[t].existence > 0)) continue;
    estimate_.targets.push_back(of[t].moments.estimate(labels_.list()[t]));
    bestMap_.frame.addTo(estimate_.targets.back());
  }
}

#define SLAMOT_TARGET_SET_PART(Motion)                                                         \
  template void EngineOf<Motion>::beginSet(const core::Step&);                                 \
  template void EngineOf<Motion>::matchSet(std::size_t, const Eye&, Scratch&);                 \
  template double EngineOf<Motion>::shapeBySet(std::size_t, const Eye&, PoseUpdate&, Scratch&) \
      const;                                                                                   \
  template double EngineOf<Motion>::takeIntoSet(std::size_t, const Eye&, Scratch&);            \
  template double EngineOf<Motion>::takeOverPairs(std::size_t, const Eye&, Scratch&);          \
  template void EngineOf<Motion>::settleSet(double);                                           \
  template void EngineOf<Motion>::dropLostLabels(double);                                      \
  template void EngineOf<Motion>::estimateSet()
SLAMOT_TARGET_SET_PART(models::DifferentialDriveTarget);
SLAMOT_TARGET_SET_PART(models::DampedVelocityTarget);
SLAMOT_TARGET_SET_PART(models::ConstantVelocityTarget);
SLAMOT_TARGET_SET_PART(models::ConstantAccelerationTarget);
SLAMOT_TARGET_SET_PART(models::ManoeuvringTarget);
#undef SLAMOT_TARGET_SET_PART
}  // namespace slamot::filters::rbpf
