#include "Engine.h"
#include "relate.h"

// Targets of the one Gaussian: from their start or first blob to their loss.
namespace slamot::filters::ekf
{
using Kind = core::Pairing::Outcome;

template <class Motion>
void EngineOf<Motion>::startTarget(int id, const core::ObjectStart& start, double time)
{
  if (!start.value[core::ObjectStart::kX] || !start.value[core::ObjectStart::kY]) return;
  const State state = motion_.start(start);
  for (std::size_t t = 0; t < targets_.size(); ++t)
    if (tracks_.list()[t].id == id) return addKnowledge(targets_[t], state);
  tracks_.addStart(id, time);
  addTarget(state);
}

template <class Motion>
void EngineOf<Motion>::addTarget(const State& state)
{
  const int slot = belief_.addTarget();
  belief_.set(belief_.target(slot), state.x, state.P);
  targets_.push_back({slot, state});
}

// Another robot's knowledge of the same start, its error independent.
template <class Motion>
void EngineOf<Motion>::addKnowledge(const Target& target, const State& known)
{
  const int j = belief_.target(target.slot);
  const Belief::Rows H{{j}, {Eigen::MatrixXd::Identity(kSize, kSize)}};
  const Eigen::MatrixXd W = belief_.product(H);
  Eigen::Matrix<double, kSize, 1> innovation = known.x - belief_.x().template segment<kSize>(j);
  if constexpr (Motion::kAngle >= 0)
    innovation[Motion::kAngle] = math::wrapToPi(innovation[Motion::kAngle]);
  Eigen::Matrix<double, kSize, kSize> S = Belief::innovationCov(H, W) + known.P;
  S.diagonal().array() += 1e-12;  // both may know a coordinate exactly
  const Eigen::Matrix<double, kSize, kSize> inverse = S.inverse();
  math::IntersectionUpdate update;
  update.gain = inverse * innovation;
  update.reduction = 0.5 * (inverse + inverse.transpose());
  belief_.fuse(H, W, update);
  wrapAngles();
}

template <class Motion>
typename EngineOf<Motion>::State EngineOf<Motion>::stateOf(const Target& target) const
{
  State out = target.state;
  const int j = belief_.target(target.slot);
  out.x = belief_.x().template segment<kSize>(j);
  out.P = belief_.P().template block<kSize, kSize>(j, j);
  return out;
}

template <class Motion>
const typename EngineOf<Motion>::Target* EngineOf<Motion>::targetWith(int id) const
{
  for (std::size_t t = 0; t < targets_.size(); ++t)
  {
    const Track& track = tracks_.list()[t];
    if (track.confirmed && track.identified && track.id == id)
      return Motion::hasVelocity(targets_[t].state) ? &targets_[t] : nullptr;
  }
  return nullptr;
}

template <class Motion>
void EngineOf<Motion>::moveTargets(double dt)
{
  for (Target& t : targets_)
  {
    t.state = stateOf(t);
    const auto transition = motion_.move(t.state, dt);
    belief_.move(belief_.target(t.slot), t.state.x, transition.F, transition.Q);
  }
}

template <class Motion>
void EngineOf<Motion>::matchTargets(int robot, const core::BlobScan& scan, double time,
                                    BlobScan& out)
{
  for (std::size_t k = 0; k < scan.blobs.size(); ++k)
  {
    const core::Blob& blob = scan.blobs[k];
    if (!mates_.label.empty() && blob.label == mates_.label) continue;
    out.blobs.push_back(blob);
    out.index.push_back(static_cast<int>(k));
    out.rays.rays.push_back(settings_.ray(blob));
  }
  out.rays.blobs = &out.blobs;
  const Eye eye = eyeOf(belief_, robot);
  const auto noise = [&](std::size_t t)
  { return settings_.noiseAfter(time - tracks_.list()[t].lastSeen); };
  const auto innovation = [&](std::size_t k, std::size_t t, Innovation& o)
  {
    return relate(belief_, robot, belief_.target(targets_[t].slot), eye, out.rays.rays[k], o,
                  noise(t));
  };
  matchBlobs(out.rays, tracks_.list(), settings_.gates, innovation, candidates_, out.matches);
  for (std::size_t k = 0; k < out.matches.size(); ++k)
  {
    if (out.matches[k] < 0) continue;
    const auto t = static_cast<std::size_t>(out.matches[k]);
    Innovation o;
    if (!models::kHasModes<Motion> && innovation(k, t, o))
      rows_.push_back(
          ekf::rowsOf(robot, belief_.target(targets_[t].slot), o, out.rays.rays[k], noise(t)));
  }
}

// A bank of models in the one Gaussian, after what else the scan tells: the blob corrects all of
// the Gaussian as one, and each model by its own innovation; then the target takes the mean and
// covariance that its models have.  What it has in common with all else stays, but where less doubt
// is left.
template <class Motion>
void EngineOf<Motion>::updateBanks(int robot, const BlobScan& scan, double time)
{
  if constexpr (models::kHasModes<Motion>)
    for (std::size_t k = 0; k < scan.matches.size(); ++k)
    {
      if (scan.matches[k] < 0) continue;
      const auto t = static_cast<std::size_t>(scan.matches[k]);
      Target& target = targets_[t];
      const int j = belief_.target(target.slot);
      const double noise = settings_.noiseAfter(time - tracks_.list()[t].lastSeen);
      Innovation o;
      if (!relate(belief_, robot, j, eyeOf(belief_, robot), scan.rays.rays[k], o, noise)) continue;
      const SightingRows row = ekf::rowsOf(robot, j, o, scan.rays.rays[k], noise);
      State state = stateOf(target);
      Matrix2 S, E;
      S << o.s11, o.s12, o.s12, o.s22;
      E << o.e11, o.e12, o.e12, o.e22;
      const Eigen::Matrix<double, kSize, 2> across =
          belief_.P().template block<kSize, 2>(j, j) * row.byObject.transpose() +
          belief_.P().template block<kSize, 3>(j, robot) * row.byRobot.transpose();
      state.correct(row.innovation, S, row.byObject, E, across);
      belief_.update({row});
      const State asOne = stateOf(target);
      const auto F =
          models::transitionOf(asOne.P, state.P, Eigen::Matrix<double, 4, kSize>::Identity()).F;
      belief_.reshape(j, state.x - asOne.x, F, state.P);
      target.state = state;
      rows_.push_back(row);
    }
}

template <class Motion>
void EngineOf<Motion>::settleTargets(int robot, const BlobScan& scan, double time,
                                     std::vector<core::Pairing>& pairings)
{
  for (std::size_t k = 0; k < scan.matches.size(); ++k)
  {
    const Ray& ray = scan.rays.rays[k];
    core::Pairing pairing{true, scan.index[k], Kind::kRejected, core::kNoId};
    if (scan.matches[k] >= 0)
    {
      const auto t = static_cast<std::size_t>(scan.matches[k]);
      Target& target = targets_[t];
      State state = stateOf(target);
      const Gaussian<Point2D> seenAt = seenPlace(robot, ray);
      constexpr int kOther = kSize - 2;  // than the place, which stays as it is
      if (motion_.afterCorrection(state, ray.hasRange ? &seenAt : nullptr))
        belief_.set(belief_.target(target.slot) + 2, state.x.template tail<kOther>(),
                    state.P.template bottomRightCorner<kOther, kOther>());
      target.state = state;
      tracks_.hit(t, scan.blobs[k], time);
      pairing.outcome = Kind::kKnown;
      pairing.id = tracks_.list()[t].id;
    }
    else if (scan.matches[k] == kNew)
    {
      tracks_.add(scan.blobs[k], time);
      birth(robot, ray);
      pairing.outcome = Kind::kNew;
      pairing.id = tracks_.list().back().id;
    }
    else
      tracks_.reject(scan.blobs[k]);
    pairings.push_back(pairing);
  }
}

template <class Motion>
void EngineOf<Motion>::birth(int robot, const Ray& ray)
{
  const Eye eye = eyeOf(belief_, robot);
  const Gaussian<Point2D> place = invert(eye, ray);
  addTarget(motion_.birth(place));
  const int j = belief_.target(targets_.back().slot);
  belief_.correlate(j, robot, placeByRobot(eye, place.mean));
  if constexpr (Motion::kAngle >= 0) targets_.back().state.anchorCov = seenPlace(robot, ray).cov;
}

// The way from one such place to another gives a target its heading: what the robot's own errors
// share at both is left out, on the safe side.
template <class Motion>
Gaussian<Point2D> EngineOf<Motion>::seenPlace(int robot, const Ray& ray) const
{
  const Eye eye = eyeOf(belief_, robot);
  Gaussian<Point2D> out = invert(eye, ray);
  const auto J = placeByRobot(eye, out.mean);
  out.cov += J * belief_.P().template block<3, 3>(robot, robot) * J.transpose();
  return out;
}

template <class Motion>
void EngineOf<Motion>::dropLost(double time)
{
  for (std::size_t t = targets_.size(); t-- > 0;)
  {
    const int j = belief_.target(targets_[t].slot);
    const double std = std::sqrt(0.5 * (belief_.P()(j, j) + belief_.P()(j + 1, j + 1)));
    if (!tracks_.isLost(t, time, std)) continue;
    belief_.removeTarget(targets_[t].slot);
    tracks_.erase(t);
    targets_.erase(targets_.begin() + static_cast<std::ptrdiff_t>(t));
  }
}

#define SLAMOT_TARGETS_PART(Motion)                                                            \
  template void EngineOf<Motion>::startTarget(int, const core::ObjectStart&, double);          \
  template EngineOf<Motion>::State EngineOf<Motion>::stateOf(const Target&) const;             \
  template const EngineOf<Motion>::Target* EngineOf<Motion>::targetWith(int) const;            \
  template void EngineOf<Motion>::moveTargets(double);                                         \
  template void EngineOf<Motion>::matchTargets(int, const core::BlobScan&, double, BlobScan&); \
  template void EngineOf<Motion>::updateBanks(int, const BlobScan&, double);                   \
  template void EngineOf<Motion>::settleTargets(int, const BlobScan&, double,                  \
                                                std::vector<core::Pairing>&);                  \
  template void EngineOf<Motion>::dropLost(double)
SLAMOT_TARGETS_PART(models::DifferentialDriveTarget);
SLAMOT_TARGETS_PART(models::DampedVelocityTarget);
SLAMOT_TARGETS_PART(models::ConstantVelocityTarget);
SLAMOT_TARGETS_PART(models::ConstantAccelerationTarget);
SLAMOT_TARGETS_PART(models::ManoeuvringTarget);
#undef SLAMOT_TARGETS_PART
}  // namespace slamot::filters::ekf
