#pragma once

#include "PathTree.h"

#include <slamot/maps/LandmarkMap.h>

#include <mrpt/bayes/CParticleFilterData.h>

#include <algorithm>
#include <functional>

namespace slamot::filters::rbpf
{
/// A Gaussian of a particle's intensity of moving targets.
template <class TargetState>
struct TargetComponent
{
  TargetState state;
  double weight = 0;        ///< targets expected in it
  std::uint64_t label = 0;  ///< of TargetLabels: one birth's, whatever the particle
};

template <class TargetState>
struct Particle
{
  Pose2D pose;
  PathTree::Node path = PathTree::kNone;  // the end of its path
  Pose2D shift;  // what a team moved all of it by: pose, map and targets are given before this
  maps::LandmarkMap map;                              // a handle: nodes are shared
  std::vector<TargetState> targets;                   // one for each track, targets = tracks
  std::vector<TargetComponent<TargetState>> mixture;  // targets = gm-phd, heaviest first
  std::vector<std::int32_t> followed;  // the landmark that each track of sightings is of
};

/// The particles as MRPT's particle filter classes see them.  MRPT decides when and how to
/// resample; the step's work comes in as a function, since MRPT's own arguments (actions and
/// frames) don't carry what a Step does.
template <class TargetState>
class ParticleSet
    : public ::mrpt::bayes::CParticleFilterData<Particle<TargetState>,
                                                ::mrpt::bayes::particle_storage_mode::VALUE>,
      public ::mrpt::bayes::CParticleFilterDataImpl<
          ParticleSet<TargetState>,
          typename ::mrpt::bayes::CParticleFilterData<
              Particle<TargetState>, ::mrpt::bayes::particle_storage_mode::VALUE>::CParticleList>
{
 public:
  using Base = ::mrpt::bayes::CParticleFilterDataImpl<
      ParticleSet<TargetState>,
      typename ::mrpt::bayes::CParticleFilterData<
          Particle<TargetState>, ::mrpt::bayes::particle_storage_mode::VALUE>::CParticleList>;
  using Options = ::mrpt::bayes::CParticleFilter::TParticleFilterOptions;

  explicit ParticleSet(maps::LandmarkPool& pool) : pool_(pool) {}

  std::function<void()> predictAndUpdate;    ///< the current step's work
  std::function<void()> beforeSubstitution;  ///< if set, called before a resampling
  std::uint64_t substitutions = 0;           ///< resamplings so far

  [[nodiscard]] std::size_t size() const { return this->m_particles.size(); }
  [[nodiscard]] Particle<TargetState>& operator[](std::size_t i) { return this->m_particles[i].d; }
  [[nodiscard]] const Particle<TargetState>& operator[](std::size_t i) const
  {
    return this->m_particles[i].d;
  }
  [[nodiscard]] double& logWeight(std::size_t i) { return this->m_particles[i].log_w; }

  // MRPT 2.5.8 reaches the list by a dynamic_cast in each of these, once per particle: 2% of a step
  // with 1000 particles and 20 sightings, in the part that runs on one thread.
  [[nodiscard]] double getW(std::size_t i) const override { return this->m_particles.at(i).log_w; }
  void setW(std::size_t i, double w) override { this->m_particles.at(i).log_w = w; }

  void performSubstitution(const std::vector<std::size_t>& indices) override
  {
    if (beforeSubstitution) beforeSubstitution();
    Base::performSubstitution(indices);
    ++substitutions;
    std::vector<std::size_t> sorted(indices);  // as the base places them
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < sorted.size(); ++i)
    {
      // MRPT 2.5.8 (and 3.1) leaves the weights as they were, so that they would count twice.
      this->m_particles[i].log_w = 0;
      const bool shared = (i > 0 && sorted[i] == sorted[i - 1]) ||
                          (i + 1 < sorted.size() && sorted[i] == sorted[i + 1]);
      if (shared) this->m_particles[i].d.map.detach(pool_.newToken());
    }
  }

  void prediction_and_update_pfStandardProposal(const ::mrpt::obs::CActionCollection*,
                                                const ::mrpt::obs::CSensoryFrame*,
                                                const Options&) override
  {
    predictAndUpdate();
  }
  void prediction_and_update_pfOptimalProposal(const ::mrpt::obs::CActionCollection*,
                                               const ::mrpt::obs::CSensoryFrame*,
                                               const Options&) override
  {
    predictAndUpdate();
  }

 private:
  maps::LandmarkPool& pool_;
};
}  // namespace slamot::filters::rbpf
