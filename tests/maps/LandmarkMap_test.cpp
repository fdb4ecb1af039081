#include <gtest/gtest.h>
#include <slamot/maps/LandmarkMap.h>
#include <slamot/math/random.h>

#include <map>

namespace slamot::maps
{
namespace
{
using Oracle = std::map<std::uint32_t, Landmark>;

bool equal(const Landmark& a, const Landmark& b)
{
  return a.x == b.x && a.y == b.y && a.cxx == b.cxx && a.cxy == b.cxy && a.cyy == b.cyy &&
         a.sightings == b.sightings && a.existence == b.existence;
}

/// Maps as a particle filter uses them, each beside what it must hold.
class Population
{
 public:
  Population(std::uint64_t seed, std::size_t maps, std::uint32_t slots, int lanes)
      : random_{seed}, slots_(slots), lanes_(lanes), pool_(lanes), maps_(maps), oracles_(maps)
  {
    for (LandmarkMap& m : maps_) m.detach(pool_.newToken());
  }

  void modify()
  {
    const std::size_t i = draw(maps_.size());
    const std::uint32_t slot = drawSlot();
    Landmark& m = maps_[i].modify(pool_, lane(), slot);
    Landmark& o = oracles_[i][slot];
    ASSERT_TRUE(equal(m, o));  // a new one is a default one, also in memory that was used
    o = {random_.normal(),
         random_.normal(),
         1,
         0.5,
         2,
         static_cast<std::uint32_t>(o.sightings + 1),
         0,
         0.5f};
    m = o;
  }
  void erase()
  {
    const std::size_t i = draw(maps_.size());
    const std::uint32_t slot = drawSlot();
    maps_[i].erase(pool_, lane(), slot);
    oracles_[i].erase(slot);
  }
  /// Each map becomes a copy of some other one; those that several came from get new tokens.
  void resample()
  {
    std::vector<std::size_t> from(maps_.size()), copies(maps_.size());
    for (std::size_t& f : from) ++copies[f = draw(maps_.size())];
    const auto maps = maps_;
    const auto oracles = oracles_;
    for (std::size_t i = 0; i < from.size(); ++i)
    {
      maps_[i] = maps[from[i]];
      oracles_[i] = oracles[from[i]];
      if (copies[from[i]] > 1) maps_[i].detach(pool_.newToken());
    }
  }
  void collect()
  {
    LandmarkCollector collector(pool_);
    for (const LandmarkMap& m : maps_) collector.mark(m);
    collector.sweep();
    std::vector<bool> occupied(collector.occupied().size());
    for (const Oracle& o : oracles_)
      for (const auto& [slot, m] : o) occupied.at(slot) = true;
    EXPECT_EQ(collector.occupied(), occupied);
  }
  /// Every map holds what it must: no more, no less, nothing of another's.
  void check() const
  {
    for (std::size_t i = 0; i < maps_.size(); ++i)
    {
      ASSERT_EQ(maps_[i].size(), oracles_[i].size());
      auto expected = oracles_[i].begin();
      maps_[i].visit(
          [&](std::uint32_t slot, const Landmark& m)
          {
            ASSERT_NE(expected, oracles_[i].end());
            ASSERT_EQ(slot, expected->first);
            ASSERT_TRUE(equal(m, expected->second));
            ++expected;
          });
      ASSERT_EQ(expected, oracles_[i].end());
    }
  }
  void checkFinds()
  {
    for (std::size_t i = 0; i < maps_.size(); ++i)
      for (int k = 0; k < 20; ++k)
      {
        const std::uint32_t slot = k < 18 ? drawSlot() : 1u << (k + 8);
        const Landmark* m = maps_[i].find(slot);
        const auto it = oracles_[i].find(slot);
        ASSERT_EQ(m != nullptr, it != oracles_[i].end());
        ASSERT_TRUE(!m || equal(*m, it->second));
      }
  }
  std::size_t draw(std::size_t n)
  {
    return static_cast<std::size_t>(random_.uniform() * static_cast<double>(n));
  }
  [[nodiscard]] const LandmarkPool& pool() const { return pool_; }

 private:
  int lane() { return static_cast<int>(draw(static_cast<std::size_t>(lanes_))); }
  /// Most are low, so that scripts come back to them; a few are anywhere.
  std::uint32_t drawSlot()
  {
    return static_cast<std::uint32_t>(
        draw(random_.uniform() < 0.8 ? std::min(slots_, 24u) : slots_));
  }

  math::RandomStream random_;
  std::uint32_t slots_;
  int lanes_;
  LandmarkPool pool_;
  std::vector<LandmarkMap> maps_;
  std::vector<Oracle> oracles_;
};
}  // namespace

TEST(LandmarkMap, EqualsAMapOfItsOwnOverRandomScripts)
{
  for (std::uint64_t seed = 1; seed <= 150; ++seed)
  {
    SCOPED_TRACE(seed);
    math::RandomStream random{seed, 99};
    const std::uint32_t slots = seed % 3 == 0 ? 40 : seed % 3 == 1 ? 600 : 50000;
    Population p(seed, 1 + seed % 9, slots, 1 + static_cast<int>(seed % 3));
    for (int i = 0; i < 300; ++i)
    {
      const double u = random.uniform();
      if (u < 0.75)
        p.modify();
      else if (u < 0.9)
        p.erase();
      else if (u < 0.95)
        p.resample();
      else if (u < 0.97)
        p.collect();
      if (i % 10 == 0) p.check();
      if (HasFatalFailure()) return;
    }
    p.checkFinds();
    p.check();
  }
}

TEST(LandmarkMap, CopiesTakeNoMemoryUntilTheyDiffer)
{
  LandmarkPool pool;
  LandmarkMap first;
  first.detach(pool.newToken());
  for (std::uint32_t slot = 0; slot < 5000; ++slot) first.modify(pool, 0, slot).x = slot;
  const std::size_t one = pool.bytes();
  std::vector<LandmarkMap> copies(1000, first);
  for (LandmarkMap& m : copies) m.detach(pool.newToken());
  EXPECT_EQ(pool.bytes(), one);
  // A change of one landmark costs its path: a leaf and one inner node a level.
  for (LandmarkMap& m : copies) m.modify(pool, 0, 2500).x = -1;
  EXPECT_LT(pool.bytes() - one,
            1000 * (sizeof(detail::Leaf) + 3 * sizeof(detail::Inner)) * 13 / 10);
  EXPECT_EQ(first.find(2500)->x, 2500);
  for (const LandmarkMap& m : copies) EXPECT_EQ(m.find(2500)->x, -1);
}

TEST(LandmarkMap, CollectsWhatResamplingLeavesBehind)
{
  Population p(1, 20, 400, 2);
  std::size_t afterWarmUp = 0;
  for (int round = 0; round < 300; ++round)
  {
    for (int i = 0; i < 100; ++i) p.modify();
    p.resample();
    if (LandmarkCollector::isDue(p.pool())) p.collect();
    if (round == 100) afterWarmUp = p.pool().bytes();
  }
  p.check();
  // Without collection it would be thrice that of the warm-up.
  EXPECT_LT(p.pool().bytes(), afterWarmUp * 3 / 2);
}

TEST(LandmarkMap, OfNothingHoldsNothing)
{
  LandmarkPool pool;
  LandmarkMap m;
  m.detach(pool.newToken());
  EXPECT_EQ(m.find(0), nullptr);
  EXPECT_EQ(m.find(~0u), nullptr);
  EXPECT_EQ(m.size(), 0u);
  m.erase(pool, 0, 7);
  m.visit([](std::uint32_t, const Landmark&) { FAIL(); });
  EXPECT_EQ(pool.bytes(), 0u);
  LandmarkCollector collector(pool);
  collector.mark(m);
  collector.sweep();
  EXPECT_TRUE(collector.occupied().empty());
}

TEST(Landmark, GivesItsPlaceAndCovariance)
{
  const Landmark m{1, 2, 3, 4, 5, 0, 0};
  EXPECT_EQ(m.point(), Point2D(1, 2));
  EXPECT_EQ(m.cov(), (Matrix2() << 3, 4, 4, 5).finished());
}
}  // namespace slamot::maps
