#pragma once

#include <slamot/models/TargetState.h>

#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/bayes/CParticleFilterData.h>

#include <functional>

namespace slamot::filters::trackers
{
/// A target's place [m] and velocity [m/s].
struct Sample
{
  double x = 0, y = 0, vx = 0, vy = 0;
};

/// Weighted samples of one target as MRPT's particle filter classes see them; MRPT decides when and
/// how to resample.
class Cloud
    : public ::mrpt::bayes::CParticleFilterData<Sample,
                                                ::mrpt::bayes::particle_storage_mode::VALUE>,
      public ::mrpt::bayes::CParticleFilterDataImpl<
          Cloud, ::mrpt::bayes::CParticleFilterData<
                     Sample, ::mrpt::bayes::particle_storage_mode::VALUE>::CParticleList>
{
 public:
  using Base = ::mrpt::bayes::CParticleFilterDataImpl<
      Cloud, ::mrpt::bayes::CParticleFilterData<
                 Sample, ::mrpt::bayes::particle_storage_mode::VALUE>::CParticleList>;
  using Options = ::mrpt::bayes::CParticleFilter::TParticleFilterOptions;

  explicit Cloud(std::size_t samples) { m_particles.resize(samples); }

  std::function<void()> weigh;  ///< the current step's work
  std::uint64_t key = 0;        ///< of its random streams: its own, for ever
  bool resampled = false;       ///< since somebody cleared it
  /// Mean and covariance (x, y, vx, vy), when settle() was called last.
  models::TargetState<4> belief;

  [[nodiscard]] std::size_t size() const { return m_particles.size(); }
  [[nodiscard]] Sample& operator[](std::size_t i) { return m_particles[i].d; }
  [[nodiscard]] const Sample& operator[](std::size_t i) const { return m_particles[i].d; }
  [[nodiscard]] double& logWeight(std::size_t i) { return m_particles[i].log_w; }
  /// Not normalised.
  [[nodiscard]] double logWeight(std::size_t i) const { return m_particles[i].log_w; }

  /// Takes the moments: before resampling, which would add to their error.
  void settle()
  {
    Eigen::Vector4d mean = Eigen::Vector4d::Zero();
    Eigen::Matrix4d second = Eigen::Matrix4d::Zero();
    double sum = 0;
    for (const auto& p : m_particles)  // West 1979, as PoseMoments
    {
      const double w = std::exp(p.log_w);
      if (!(w > 0)) continue;
      sum += w;
      const Eigen::Vector4d d = Eigen::Vector4d(p.d.x, p.d.y, p.d.vx, p.d.vy) - mean;
      mean += w / sum * d;
      second += w * (1 - w / sum) * d * d.transpose();
    }
    belief.x = mean;
    belief.P = 0.5 / sum * (second + second.transpose());
  }

  // MRPT 2.5.8 reaches the list by a dynamic_cast in each of these.
  [[nodiscard]] double getW(std::size_t i) const override { return m_particles.at(i).log_w; }
  void setW(std::size_t i, double w) override { m_particles.at(i).log_w = w; }

  void performSubstitution(const std::vector<std::size_t>& indices) override
  {
    Base::performSubstitution(indices);
    // MRPT 2.5.8 leaves the weights as they were, so that they would count twice.
    for (auto& p : m_particles) p.log_w = 0;
    resampled = true;
  }
  void prediction_and_update_pfStandardProposal(const ::mrpt::obs::CActionCollection*,
                                                const ::mrpt::obs::CSensoryFrame*,
                                                const Options&) override
  {
    weigh();
  }
};
}  // namespace slamot::filters::trackers
