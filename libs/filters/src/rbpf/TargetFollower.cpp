#include "TargetFollower.h"

#include "Settings.h"

#include <algorithm>

namespace slamot::filters::rbpf
{
namespace
{
template <class Motion>
class FollowerOf : public TargetFollower
{
 public:
  FollowerOf(const TargetSettings& settings, const Motion& motion, const core::Starts& starts)
      : settings_(settings), motion_(motion), tracks_(settings.tracks)
  {
    for (const auto& [id, start] : starts.targets)
    {
      if (!start.value[core::ObjectStart::kX] || !start.value[core::ObjectStart::kY]) continue;
      tracks_.addStart(id, starts.time.value_or(0));
      targets_.push_back(motion_.start(start));
    }
  }

  void process(const core::Step& step, double dt, const Pose2D& pose) override
  {
    pairings_.clear();
    if (dt > 0)
      for (auto& t : targets_) motion_.predict(t, dt);
    if (!step.blobs) return;
    BlobRays rays{&step.blobs->blobs, {}};
    for (const core::Blob& b : step.blobs->blobs) rays.rays.push_back(settings_.ray(b));
    const Eye eye(pose);
    matchBlobs(eye, rays, tracks_.list(), targets_, settings_.gates, nullptr, candidates_,
               matches_);
    for (std::size_t k = 0; k < matches_.size(); ++k) settle(step, k, eye, rays.rays[k]);
    dropLost(step.time);
  }

  [[nodiscard]] std::vector<core::TargetEstimate> estimates(
      const Gaussian<Pose2D>& pose) const override
  {
    std::vector<core::TargetEstimate> out;
    for (std::size_t t = 0; t < targets_.size(); ++t)
    {
      if (!tracks_.list()[t].confirmed) continue;
      TargetMoments<Motion> moments;
      moments.add(1.0, targets_[t]);
      out.push_back(moments.estimate(tracks_.list()[t]));
      Matrix3 T = Matrix3::Identity();  // of the target's pose by the robot's
      T(0, 2) = pose.mean.y - out.back().pose.mean.y;
      T(1, 2) = out.back().pose.mean.x - pose.mean.x;
      out.back().pose.cov += T * pose.cov * T.transpose();
    }
    std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    return out;
  }
  [[nodiscard]] const std::vector<core::Pairing>& pairings() const override { return pairings_; }

 private:
  void settle(const core::Step& step, std::size_t k, const Eye& eye, const Ray& ray)
  {
    const core::Blob& blob = step.blobs->blobs[k];
    core::Pairing pairing{true, static_cast<int>(k), core::Pairing::Outcome::kRejected,
                          core::kNoId};
    if (matches_[k] >= 0)
    {
      const auto t = static_cast<std::size_t>(matches_[k]);
      correctTarget(motion_, targets_[t], eye, ray);
      tracks_.hit(t, blob, step.time);
      pairing.outcome = core::Pairing::Outcome::kKnown;
      pairing.id = tracks_.list()[t].id;
    }
    else if (matches_[k] == kNew)
    {
      tracks_.add(blob, step.time);
      targets_.push_back(motion_.birth(invert(eye, ray)));
      pairing.outcome = core::Pairing::Outcome::kNew;
      pairing.id = tracks_.list().back().id;
    }
    else if (matches_[k] == kRejected)
      tracks_.reject(blob);
    pairings_.push_back(pairing);
  }

  void dropLost(double time)
  {
    for (std::size_t t = targets_.size(); t-- > 0;)
    {
      if (!tracks_.isLost(t, time, std::sqrt(0.5 * targets_[t].pointCov().trace()))) continue;
      tracks_.erase(t);
      targets_.erase(targets_.begin() + static_cast<std::ptrdiff_t>(t));
    }
  }

  TargetSettings settings_;
  Motion motion_;
  Tracks tracks_;
  std::vector<typename Motion::State> targets_;
  std::vector<Candidate> candidates_;
  std::vector<std::int32_t> matches_;
  std::vector<core::Pairing> pairings_;
};
}  // namespace

std::unique_ptr<TargetFollower> TargetFollower::make(core::Params& params,
                                                     const core::Starts& starts)
{
  const TargetSettings settings = TargetSettings::from(params);
  return std::visit(
      [&](const auto& motion) -> std::unique_ptr<TargetFollower> {
        return std::make_unique<FollowerOf<std::decay_t<decltype(motion)>>>(settings, motion,
                                                                            starts);
      },
      models::targetMotionFrom(params));
}
}  // namespace slamot::filters::rbpf
