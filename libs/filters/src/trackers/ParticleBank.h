#pragma once

#include "Bank.h"
#include "Cloud.h"
#include "rbpf/Workers.h"

#include <slamot/core/Filter.h>
#include <slamot/math/random.h>

#include <memory>

namespace slamot::filters::trackers
{
/// A bootstrap particle filter for each target.  Weights are w^alpha p(z | x), from normalised w:
/// with alpha below 1 they forget.  Just resampled, all w are alike, and alpha changes nothing.
class ParticleBank : public Bank
{
 public:
  using Motion = models::ConstantVelocityTarget;
  struct Options
  {
    int particles;
    double weightExponent;  ///< alpha, in [0, 1]
    ::mrpt::bayes::CParticleFilter::TParticleFilterOptions resampling;
    static Options from(core::Params& p);
  };

  ParticleBank(const Options& options, const Motion& motion, const core::FilterContext& context);

  void predict(double dt) override;
  void start(const core::ObjectStart& told) override;
  void birth(const Eye& eye, const Seen& z) override;
  void drop(std::size_t target) override;
  void take(std::size_t target, const Eye& eye, const Seen& z) override;

  [[nodiscard]] std::size_t size() const override { return clouds_.size(); }
  bool innovate(std::size_t target, const Eye& eye, const Seen& z, Innovation& o) const override;
  [[nodiscard]] core::TargetEstimate estimate(std::size_t target,
                                              const Track& track) const override;
  [[nodiscard]] core::Diagnostics diagnostics() const override { return diagnostics_; }

 private:
  enum : std::uint64_t  // purposes of random streams
  {
    kStartStream = 101,
    kMoveStream,
    kResampleStream
  };
  Cloud& add();
  [[nodiscard]] math::RandomStream stream(std::uint64_t purpose, const Cloud& cloud,
                                          std::size_t sample) const
  {
    return {seed_, purpose, step_, cloud.key, sample};
  }
  void weigh(Cloud& cloud, const Eye& eye, const Seen& z);

  Options options_;
  Motion motion_;
  std::uint64_t seed_, step_ = 0, born_ = 0;
  Matrix2 axes_;  // in which noise is drawn: the robot's at its start
  rbpf::Workers workers_;
  std::vector<std::unique_ptr<Cloud>> clouds_;
  core::Diagnostics diagnostics_;
};
}  // namespace slamot::filters::trackers
