#pragma once

#include "Matching.h"
#include "Sighting.h"
#include "Tracks.h"

#include <slamot/core/Estimate.h>
#include <slamot/models/TargetMotion.h>

// What one pose (a particle's, or a filter's mean with covariance) makes of a scan's blobs.
namespace slamot::filters::rbpf
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
template <class State>
bool innovateTarget(const Eye& eye, const Ray& ray, const State& t, Innovation& o,
                    const Matrix3* poseCov = nullptr, double noise = 1)
{
  if (!innovate(eye, ray, t.x[0], t.x[1], t.P(0, 0), t.P(0, 1), t.P(1, 1), o, noise)) return false;
  if (poseCov) o = withPose(o, *poseCov);
  return true;
}

/// Gives each blob a track's index, kNew or kRejected.
template <class State>
void matchBlobs(const Eye& eye, const BlobRays& scan, const std::vector<Track>& tracks,
                const std::vector<State>& targets, const Gates& gates, const Matrix3* poseCov,
                std::vector<Candidate>& candidates, std::vector<std::int32_t>& matches)
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
      if (!Tracks::fits(tracks[t], blob) || !innovateTarget(eye, ray, targets[t], o, poseCov)) continue;
      const bool identified = blob.id != core::kNoId;
      const double inner = ray.hasRange ? gates.inner : gates.inner1;
      const double outer = ray.hasRange ? gates.outer : gates.outer1;
      const bool inGate = o.d2 <= (identified ? outer : inner);
      // An identity leaves no other target to be: out of the gate it is an outlier, never a new one.
      if (inGate || identified || o.d2 <= outer)
        candidates.push_back({o.d2 + std::log(o.det), static_cast<std::int32_t>(k),
                              static_cast<std::int32_t>(t), inGate});
    }
  }
  matchGreedily(candidates, matches);
}

/// Takes a blob into a target, seen from a known pose.
template <class Motion>
void correctTarget(const Motion& motion, typename Motion::State& t, const Eye& eye, const Ray& ray,
                   const Matrix3* poseCov = nullptr)
{
  Innovation o;
  if (!innovateTarget(eye, ray, t, o, poseCov)) return;
  Matrix2 S, H;
  S << o.s11, o.s12, o.s12, o.s22;
  H << o.h11, o.h12, o.h21, o.h22;
  const Vector2 nu(o.nuR, o.nuB);
  t.template correct<2>(nu, S, H);
  if (!ray.hasRange) return motion.afterCorrection(t, nullptr);
  const Gaussian<Point2D> seenAt = invert(eye, ray);
  motion.afterCorrection(t, &seenAt);
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
    Matrix2 vCov;
    const Vector2 v = Motion::velocity(state, vCov);
    if (weightSum_ == 0) origin_ = pose.mean;
    const Vector3 d(pose.mean.x - origin_.x, pose.mean.y - origin_.y,
                    math::wrapToPi(pose.mean.phi - origin_.phi));
    weightSum_ += weight;
    first_ += weight * d;
    second_ += weight * (d * d.transpose() + pose.cov);
    velocity_ += weight * v;
    velocitySecond_ += weight * (v * v.transpose() + vCov);
  }
  [[nodiscard]] core::TargetEstimate estimate(const Track& track) const
  {
    core::TargetEstimate out;
    out.id = track.id;
    out.label = track.label;
    out.identified = track.identified;
    out.lastSeen = track.lastSeen;
    const Vector3 m = first_ / weightSum_;
    out.pose.mean = {origin_.x + m[0], origin_.y + m[1], math::wrapToPi(origin_.phi + m[2])};
    out.pose.cov = second_ / weightSum_ - m * m.transpose();
    out.pose.cov = (0.5 * (out.pose.cov + out.pose.cov.transpose())).eval();
    out.velocity = velocity_ / weightSum_;
    out.velocityCov = velocitySecond_ / weightSum_ - out.velocity * out.velocity.transpose();
    return out;
  }

 private:
  Pose2D origin_;  // the first particle's: differences stay small, and angles unwrapped
  double weightSum_ = 0;
  Vector3 first_ = Vector3::Zero();
  Matrix3 second_ = Matrix3::Zero();
  Vector2 velocity_ = Vector2::Zero();
  Matrix2 velocitySecond_ = Matrix2::Zero();
};
}  // namespace slamot::filters::rbpf
