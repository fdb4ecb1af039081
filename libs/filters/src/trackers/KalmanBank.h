#pragma once

#include "Bank.h"

namespace slamot::filters::trackers
{
/// One Gaussian a target, by any of the models of targets' motions.
template <class Motion>
class KalmanBank : public Bank
{
 public:
  explicit KalmanBank(const Motion& motion) : motion_(motion) {}

  void predict(double dt) override
  {
    if (dt > 0)
      for (auto& t : targets_) motion_.predict(t, dt);
  }
  void start(const core::ObjectStart& told) override { targets_.push_back(motion_.start(told)); }
  void birth(const Eye& eye, const Seen& z) override
  {
    targets_.push_back(motion_.birth(invert(eye, z.polar())));
  }
  void drop(std::size_t target) override
  {
    targets_.erase(targets_.begin() + static_cast<std::ptrdiff_t>(target));
  }
  void take(std::size_t target, const Eye& eye, const Seen& z) override
  {
    Innovation o;
    if (innovateSeen(eye, z, targets_[target], o))
      correctTarget(motion_, targets_[target], eye, z.polar(), o);
  }

  [[nodiscard]] std::size_t size() const override { return targets_.size(); }
  bool innovate(std::size_t target, const Eye& eye, const Seen& z, Innovation& o) const override
  {
    return innovateSeen(eye, z, targets_[target], o);
  }
  [[nodiscard]] core::TargetEstimate estimate(std::size_t target, const Track& track) const override
  {
    TargetMoments<Motion> moments;
    moments.add(1.0, targets_[target]);
    return moments.estimate(track);
  }

 private:
  Motion motion_;
  std::vector<typename Motion::State> targets_;
};
}  // namespace slamot::filters::trackers
