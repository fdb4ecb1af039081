#include "sighting/Matching.h"

#include <gtest/gtest.h>
#include <slamot/math/random.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace slamot::filters
{
namespace
{
using math::RandomStream;
using Matches = std::vector<std::int32_t>;

/// The definition, word by word: again and again the cheapest pair in the gate whose sighting and
/// thing are both free.  What is left over is new if nothing was near it, else rejected.
Matches byDefinition(std::vector<Candidate> candidates, std::size_t sightings)
{
  Matches matches(sightings, kNew);
  for (const Candidate& c : candidates) matches[static_cast<std::size_t>(c.sighting)] = kRejected;
  std::set<std::int32_t> taken;
  while (true)
  {
    const Candidate* best = nullptr;
    for (const Candidate& c : candidates)
      if (c.inGate && matches[static_cast<std::size_t>(c.sighting)] < 0 && !taken.count(c.thing) &&
          (!best || std::tie(c.cost, c.sighting, c.thing) <
                        std::tie(best->cost, best->sighting, best->thing)))
        best = &c;
    if (!best) return matches;
    matches[static_cast<std::size_t>(best->sighting)] = best->thing;
    taken.insert(best->thing);
  }
}

std::vector<Candidate> draw(RandomStream& random, int sightings, int things)
{
  std::vector<Candidate> out;
  const bool ties = random.uniform() < 0.3;
  for (std::int32_t s = 0; s < sightings; ++s)
    for (std::int32_t t = 0; t < things; ++t)
      if (random.uniform() < 0.5)
      {
        const double cost = random.uniform(-5, 20);
        out.push_back({ties ? std::floor(cost / 5) : cost, s, t, random.uniform() < 0.7});
      }
  return out;
}
}  // namespace

TEST(MatchGreedily, EqualsItsDefinition)
{
  RandomStream random{1};
  for (int trial = 0; trial < 3000; ++trial)
  {
    const int sightings = static_cast<int>(random.uniform(0, 7)),
              things = static_cast<int>(random.uniform(0, 7));
    auto candidates = draw(random, sightings, things);
    Matches matches(static_cast<std::size_t>(sightings), 99);
    const Matches expected = byDefinition(candidates, matches.size());
    matchGreedily(candidates, matches);
    ASSERT_EQ(matches, expected) << "trial " << trial;
  }
}

TEST(MatchGreedily, GivesAThingToOneSightingAtMost)
{
  RandomStream random{2};
  for (int trial = 0; trial < 500; ++trial)
  {
    auto candidates = draw(random, 6, 3);
    Matches matches(6);
    matchGreedily(candidates, matches);
    matches.erase(std::remove_if(matches.begin(), matches.end(), [](auto m) { return m < 0; }),
                  matches.end());
    EXPECT_EQ(std::set<std::int32_t>(matches.begin(), matches.end()).size(), matches.size());
  }
}

TEST(MatchGreedily, DoesNotDependOnTheOrderOfSightingsOrCandidates)
{
  RandomStream random{3};
  for (int trial = 0; trial < 500; ++trial)
  {
    std::vector<Candidate> candidates;
    for (std::int32_t s = 0; s < 5; ++s)
      for (std::int32_t t = 0; t < 5; ++t)
        if (random.uniform() < 0.6)
          candidates.push_back({random.uniform(), s, t, random.uniform() < 0.8});
    std::vector<std::int32_t> to(5);
    std::iota(to.begin(), to.end(), 0);
    std::shuffle(to.begin(), to.end(), random);
    auto permuted = candidates;
    for (Candidate& c : permuted) c.sighting = to[static_cast<std::size_t>(c.sighting)];
    std::shuffle(permuted.begin(), permuted.end(), random);
    Matches a(5), b(5);
    matchGreedily(candidates, a);
    matchGreedily(permuted, b);
    for (std::size_t s = 0; s < 5; ++s) EXPECT_EQ(a[s], b[static_cast<std::size_t>(to[s])]);
  }
}

TEST(MatchGreedily, CallsNewOnlyWhatNothingIsNear)
{
  std::vector<Candidate> candidates{{1.0, 0, 7, true}, {2.0, 1, 7, true}, {3.0, 2, 7, false}};
  Matches matches(4);
  matchGreedily(candidates, matches);
  EXPECT_EQ(matches, (Matches{7, kRejected, kRejected, kNew}));
}

TEST(MatchGreedily, GivesALoserItsNextBest)
{
  std::vector<Candidate> candidates{{1.0, 0, 7, true}, {2.0, 1, 7, true}, {9.0, 1, 8, true}};
  Matches matches(2);
  matchGreedily(candidates, matches);
  EXPECT_EQ(matches, (Matches{7, 8}));
}
}  // namespace slamot::filters
