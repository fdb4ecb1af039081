#pragma once

#include "Matching.h"
#include "Moments.h"
#include "Sighting.h"
#include "Tracks.h"
#include "soften.h"

#include <slamot/core/Estimate.h>
#include <slamot/models/TargetMotion.h>

#include <algorithm>

// What one pose (a particle's, or a filter's mean with covariance) makes of a scan's blobs.
namespace slamot::filters
{
/// Chi-square bounds for two degrees of freedom: within `inner` a pair may be true; a sighting
/// between the two of anything is neither known nor new.
struct Gates
{
  double inner, outer;
  double inner1, outer1;  ///< for one degree of freedom (bearing only)
  static Gates from(core::Params& p);
};

struct BlobRays
{
  const std::vector<core::Blob>* blobs = nullptr;
  std::vector<Ray> rays;
};

/// Innovation of a blob of a target; the pose's own covariance, if given, adds to S; `noise`
/// multiplies the sighting's variances.
/// \param doubt the pose's covariance where it does not add to S, for whether the blob glints.
template <class State>
bool innovateTarget(const Eye& eye, const Ray& ray, const State& t, Innovation& o,
                    const Matrix3* poseCov = nullptr, double noise = 1,
                    const Matrix3* doubt = nullptr)
{
  if (!innovate(eye, ray, t.x[0], t.x[1], t.P(0, 0), t.P(0, 1), t.P(1, 1), o, noise)) return false;
  soften(ray, noise, poseCov ? poseCov : doubt, o);
  if (poseCov) o = withPose(o, *poseCov);
  return true;
}

/// Whether blob k may start a target: its place is known, and its identity was not seen before in
/// this scan.
inline bool mayStart(const BlobRays& scan, std::size_t k)
{
  if (!scan.rays[k].hasRange) return false;
  const auto same = [&](const core::Blob& earlier)
  { return earlier.id == (*scan.blobs)[k].id && earlier.label == (*scan.blobs)[k].label; };
  const auto begin = scan.blobs->begin(), end = begin + static_cast<std::ptrdiff_t>(k);
  return (*scan.blobs)[k].id == core::kNoId || std::none_of(begin, end, same);
}

/// Gives each blob a track's index, kNew or kRejected.  innovate(k, t, o) sets the innovation of
/// blob k if it is of track t, or returns false.
template <class Innovate>
void matchBlobs(const BlobRays& scan, const std::vector<Track>& tracks, const Gates& gates,
                const Innovate& innovate, std::vector<Candidate>& candidates,
                std::vector<std::int32_t>& matches)
{
  candidates.clear();
  matches.assign(scan.rays.size(), kNew);
  for (std::size_t k = 0; k < scan.rays.size(); ++k)
  {
    const core::Blob& blob = (*scan.blobs)[k];
    const Ray& ray = scan.rays[k];
    for (std::size_t t = 0; t < tracks.size(); ++t)
    {
      Innovation o;
      if (!Tracks::fits(tracks[t], blob) || !innovate(k, t, o)) continue;
      const bool identified = blob.id != core::kNoId;
      const double inner = ray.hasRange ? gates.inner : gates.inner1;
      const double outer = ray.hasRange ? gates.outer : gates.outer1;
      const bool inGate = o.d2 <= (identified ? outer : inner);
      // An identity leaves no other target to be: out of the gate it is an outlier, never a new
      // one.
      if (inGate || identified || o.d2 <= outer)
        candidates.push_back({o.d2 + std::log(o.det), static_cast<std::int32_t>(k),
                              static_cast<std::int32_t>(t), inGate});
    }
  }
  matchGreedily(candidates, matches);
  for (std::size_t k = 0; k < matches.size(); ++k)
    if (matches[k] == kNew && !mayStart(scan, k)) matches[k] = kRejected;
}

/// The same for targets with covariances of their own, seen from a pose whose covariance, if given,
/// is independent of theirs.
template <class State>
void matchBlobs(const Eye& eye, const BlobRays& scan, const std::vector<Track>& tracks,
                const std::vector<State>& targets, const Gates& gates, const Matrix3* poseCov,
                std::vector<Candidate>& candidates, std::vector<std::int32_t>& matches)
{
  matchBlobs(
      scan, tracks, gates,
      [&](std::size_t k, std::size_t t, Innovation& o)
      { return innovateTarget(eye, scan.rays[k], targets[t], o, poseCov); },
      candidates, matches);
}

/// Takes a blob into a target by the innovation of it.
template <class Motion>
void correctTarget(const Motion& motion, typename Motion::State& t, const Eye& eye, const Ray& ray,
                   const Innovation& o)
{
  Matrix2 S, H;
  S << o.s11, o.s12, o.s12, o.s22;
  H << o.h11, o.h12, o.h21, o.h22;
  const Vector2 nu(o.nuR, o.nuB);
  Matrix2 E;
  E << o.e11, o.e12, o.e12, o.e22;
  t.template correct<2>(nu, S, H, E);
  const Gaussian<Point2D> seenAt = invert(eye, ray);
  motion.afterCorrection(t, ray.hasRange ? &seenAt : nullptr);
}

/// Takes a blob into a target, seen from a known pose.
template <class Motion>
void correctTarget(const Motion& motion, typename Motion::State& t, const Eye& eye, const Ray& ray,
                   const Matrix3* poseCov = nullptr)
{
  Innovation o;
  if (innovateTarget(eye, ray, t, o, poseCov)) correctTarget(motion, t, eye, ray, o);
}

/// log of the density of an innovation of (range, bearing), or of the bearing alone.
inline double logDensity(const Innovation& o, bool hasRange)
{
  constexpr double kLogTwoPi = 1.8378770664093453;
  return -0.5 * (o.d2 + std::log(o.det)) - (hasRange ? kLogTwoPi : 0.5 * kLogTwoPi);
}

/// Moments of one target over weighted particles: adds up, then gives the estimate.
template <class Motion>
class TargetMoments
{
 public:
  void add(double weight, const typename Motion::State& state)
  {
    const Gaussian<Pose2D> pose = Motion::pose(state);
    pose_.add(weight, pose.mean, pose.cov);
    if (!(weight > 0)) return;
    Matrix2 vCov;
    const Vector2 d = Motion::velocity(state, vCov) - velocity_;
    weightSum_ += weight;
    const double share = weight / weightSum_;
    velocity_ += share * d;
    velocitySecond_ += weight * (vCov + (1 - share) * d * d.transpose());
  }
  [[nodiscard]] core::TargetEstimate estimate(const Track& track) const
  {
    core::TargetEstimate out;
    out.id = track.id;
    out.label = track.label;
    out.identified = track.identified;
    out.lastSeen = track.lastSeen;
    out.pose = pose_.gaussian();
    out.velocity = velocity_;
    out.velocityCov = velocitySecond_ / weightSum_;
    return out;
  }

 private:
  PoseMoments pose_;
  double weightSum_ = 0;
  Vector2 velocity_ = Vector2::Zero();
  Matrix2 velocitySecond_ = Matrix2::Zero();
};
}  // namespace slamot::filters
