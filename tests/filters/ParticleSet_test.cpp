#include "rbpf/ParticleSet.h"

#include <mrpt/random/RandomGenerators.h>

#include <gtest/gtest.h>

#include <set>

namespace slamot::filters::rbpf
{
namespace
{
using ::mrpt::bayes::CParticleFilter;

struct NoTarget
{
};
using Set = ParticleSet<NoTarget>;

/// n particles told apart by their pose's x and by a landmark at their number.
void fill(Set& set, maps::LandmarkPool& pool, std::size_t n)
{
  set.m_particles.resize(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    set[i].pose = {double(i), 0, 0};
    set[i].map.detach(pool.newToken());
    set[i].map.modify(pool, 0, 0).x = double(i);
    set.logWeight(i) = -double(i);
  }
}

/// A resampling as MRPT does it, by the scheme named.
CParticleFilter::TParticleFilterOptions options(
    CParticleFilter::TParticleResamplingAlgorithm scheme)
{
  CParticleFilter::TParticleFilterOptions o;
  o.PF_algorithm = CParticleFilter::pfStandardProposal;
  o.resamplingMethod = scheme;
  o.BETA = 0.5;
  o.adaptiveSampleSize = false;
  return o;
}
}  // namespace

TEST(ParticleSet, SubstitutionCopiesInOrderAndMakesWeightsEqual)
{
  maps::LandmarkPool pool;
  Set set(pool);
  fill(set, pool, 5);
  set.performSubstitution({4, 1, 1, 3, 1});
  const std::vector<double> expected{1, 1, 1, 3, 4};
  for (std::size_t i = 0; i < 5; ++i)
  {
    EXPECT_EQ(set[i].pose.x, expected[i]);
    EXPECT_EQ(set[i].map.find(0)->x, expected[i]);
    EXPECT_EQ(set.logWeight(i), 0);
  }
  EXPECT_EQ(set.substitutions, 1u);
  EXPECT_DOUBLE_EQ(set.ESS(), 1);
}

TEST(ParticleSet, CopiesDoNotShareWhatTheyChange)
{
  maps::LandmarkPool pool;
  Set set(pool);
  fill(set, pool, 6);
  for (const std::vector<std::size_t>& from : std::vector<std::vector<std::size_t>>{
           {0, 0, 2, 2, 2, 5}, {1, 1, 1, 1, 1, 1}, {0, 1, 2, 3, 4, 5}})
  {
    set.performSubstitution(from);
    for (std::size_t i = 0; i < 6; ++i) set[i].map.modify(pool, 0, 0).x = 10 + double(i);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(set[i].map.find(0)->x, 10 + double(i));
  }
}

TEST(ParticleSet, AParticleThatSurvivesAloneKeepsItsNodes)
{
  maps::LandmarkPool pool;
  Set set(pool);
  fill(set, pool, 3);
  const maps::Landmark* before = set[2].map.find(0);
  set.performSubstitution({0, 0, 2});
  EXPECT_EQ(&set[2].map.modify(pool, 0, 0), before);
  EXPECT_NE(&set[0].map.modify(pool, 0, 0), &set[1].map.modify(pool, 0, 0));
}

TEST(ParticleSet, MrptResamplesItWhereWeightsDiffer)
{
  for (const auto scheme : {CParticleFilter::prSystematic, CParticleFilter::prStratified,
                            CParticleFilter::prResidual, CParticleFilter::prMultinomial})
  {
    ::mrpt::random::getRandomGenerator().randomize(7u);
    maps::LandmarkPool pool;
    Set set(pool);
    fill(set, pool, 200);
    set.predictAndUpdate = [&]
    {
      for (std::size_t i = 0; i < set.size(); ++i) set.logWeight(i) = i % 2 ? -1000.0 : 0.0;
      for (std::size_t i = 0; i < 50; ++i) set.logWeight(i) = -1000;  // ESS 0.375 of all
    };
    CParticleFilter filter;
    filter.m_options = options(scheme);
    filter.executeOn(set, nullptr, nullptr, nullptr);
    EXPECT_EQ(set.substitutions, 1u);
    EXPECT_NEAR(set.ESS(), 1, 1e-12);
    std::set<double> survivors;
    for (std::size_t i = 0; i < set.size(); ++i)
    {
      EXPECT_EQ(std::fmod(set[i].pose.x, 2), 0);
      EXPECT_GE(set[i].pose.x, 50);
      survivors.insert(set[i].pose.x);
    }
    EXPECT_LE(survivors.size(), 75u);
    EXPECT_GE(survivors.size(), scheme == CParticleFilter::prSystematic ? 75u : 45u);
  }
}

TEST(ParticleSet, MrptLeavesItAloneWhereWeightsAreEven)
{
  maps::LandmarkPool pool;
  Set set(pool);
  fill(set, pool, 100);
  set.predictAndUpdate = [&]
  {
    for (std::size_t i = 0; i < set.size(); ++i) set.logWeight(i) = i % 5 ? -3.0 : -3.1;
  };
  CParticleFilter filter;
  filter.m_options = options(CParticleFilter::prSystematic);
  filter.executeOn(set, nullptr, nullptr, nullptr);
  EXPECT_EQ(set.substitutions, 0u);
  EXPECT_NEAR(set.logWeight(0) - set.logWeight(1), -0.1, 1e-12);
}
}  // namespace slamot::filters::rbpf
