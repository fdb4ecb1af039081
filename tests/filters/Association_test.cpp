#include "filterRig.h"

#include <slamot/math/random.h>
#include <slamot/models/RangeBearing.h>
#include <slamot/sim/World.h>

namespace slamot::filters
{
namespace
{
using test::landmarks;
using test::makeFilter;
using Outcome = core::Pairing::Outcome;

const std::string kTarget = "target_velocity_std_mps = 1\ntarget_velocity_time_s = 1\n";

std::unique_ptr<core::Filter> filter(const std::string& association, int particles = 10,
                                     const std::string& more = "",
                                     const core::FilterContext& context = {})
{
  return makeFilter("rbpf-slamot",
                    "proposal = informed\nassociation = " + association +
                        "\nparticles = " + std::to_string(particles) + "\n" + more + kTarget,
                    context);
}

/// What a robot that stands at the origin reports of (range, bearing, id).
core::Step scan(double time, const std::vector<std::tuple<double, double, int>>& seen)
{
  core::Step step;
  step.time = time;
  step.landmarks.emplace();
  for (const auto& [range, bearing, id] : seen)
    step.landmarks->sightings.push_back({range, bearing, 0.1, 0.02, id});
  return step;
}

std::vector<Outcome> outcomes(const core::Update& u)
{
  std::vector<Outcome> out;
  for (const core::Pairing& p : u.pairings)
  {
    EXPECT_EQ(p.index, static_cast<int>(out.size()));
    EXPECT_FALSE(p.isBlob);
    out.push_back(p.outcome);
  }
  return out;
}
std::vector<int> ids(const core::Update& u)
{
  std::vector<int> out;
  for (const core::Pairing& p : u.pairings) out.push_back(p.id);
  return out;
}
}  // namespace

TEST(KnownAssociation, KeepsIdentitiesAndTellsNewFromKnown)
{
  const auto f = filter("known");
  auto u = f->process(scan(1, {{2, 0.1, 900}, {3, 1, 0}}));
  EXPECT_EQ(outcomes(u), (std::vector<Outcome>{Outcome::kNew, Outcome::kNew}));
  EXPECT_EQ(ids(u), (std::vector<int>{900, 0}));
  u = f->process(scan(2, {{3, 1, 0}, {4, -1, 7}, {2, 0.1, 900}}));
  EXPECT_EQ(outcomes(u), (std::vector<Outcome>{Outcome::kKnown, Outcome::kNew, Outcome::kKnown}));
  EXPECT_EQ(ids(u), (std::vector<int>{0, 7, 900}));
  const auto map = landmarks(f->estimate());
  ASSERT_EQ(map.size(), 3u);
  EXPECT_EQ(map.at(0).sightings, 2);
  EXPECT_EQ(map.at(7).sightings, 1);
  EXPECT_NEAR(map.at(900).position.mean.x, 2 * std::cos(0.1), 1e-9);
}

TEST(KnownAssociation, UsesAnIdentityOnceAScan)
{
  const auto f = filter("known");
  auto u = f->process(scan(1, {{2, 0.1, 5}, {2.1, 0.1, 5}}));
  EXPECT_EQ(outcomes(u), (std::vector<Outcome>{Outcome::kNew, Outcome::kRejected}));
  u = f->process(scan(2, {{2, 0.1, 5}, {2, 0.1, 5}, {2, 0.1, 5}}));
  EXPECT_EQ(outcomes(u),
            (std::vector<Outcome>{Outcome::kKnown, Outcome::kRejected, Outcome::kRejected}));
  EXPECT_EQ(landmarks(f->estimate()).at(5).sightings, 2);
}

TEST(KnownAssociation, LeavesSightingsWithoutIdentityAlone)
{
  const auto f = filter("known");
  for (int i = 1; i <= 3; ++i)
  {
    const auto u = f->process(scan(i, {{2, 0.1, core::kNoId}, {3, 1, 4}, {1, 2, core::kNoId}}));
    EXPECT_EQ(outcomes(u)[0], Outcome::kRejected);
    EXPECT_EQ(outcomes(u)[2], Outcome::kRejected);
    EXPECT_EQ(ids(u), (std::vector<int>{core::kNoId, 4, core::kNoId}));
  }
  EXPECT_EQ(landmarks(f->estimate()).size(), 1u);
}

TEST(KnownAssociation, RejectsAnIdentityFarFromItsPlace)
{
  const auto f = filter("known");
  (void)f->process(scan(1, {{2, 0.1, 5}, {3, 1, 6}}));
  const auto before = landmarks(f->estimate()).at(5).position;
  const auto u = f->process(scan(2, {{6, -2, 5}}));
  EXPECT_EQ(outcomes(u), (std::vector<Outcome>{Outcome::kRejected}));
  const auto after = landmarks(f->estimate()).at(5);
  EXPECT_EQ(after.position.mean.x, before.mean.x);
  EXPECT_EQ(after.position.cov, before.cov);
  EXPECT_EQ(after.sightings, 1);
}

TEST(NearestNeighbour, ConfirmsALandmarkAtItsThirdSighting)
{
  const auto f = filter("nn");
  for (int i = 1; i <= 3; ++i)
  {
    const auto u = f->process(scan(i, {{2, 0.1, -1}, {3, 1, -1}}));
    EXPECT_EQ(outcomes(u), (std::vector<Outcome>(2, i == 1 ? Outcome::kNew : Outcome::kKnown)));
    EXPECT_EQ(landmarks(f->estimate()).size(), i < 3 ? 0u : 2u);
  }
  EXPECT_EQ(landmarks(f->estimate()).count(0), 1u);
  EXPECT_EQ(landmarks(f->estimate()).count(1), 1u);
}

TEST(NearestNeighbour, CallsASightingBetweenTheGatesNeitherKnownNorNew)
{
  const auto f = filter("nn", 10, "confirm_sightings = 1\n");
  (void)f->process(scan(1, {{3, 0, -1}}));
  // The landmark's own deviation and the sighting's: 0.14 m.  Gates at 3.03 and 4.80 of them.
  auto u = f->process(scan(2, {{3 + 0.1414 * 4, 0, -1}}));
  EXPECT_EQ(outcomes(u), (std::vector<Outcome>{Outcome::kRejected}));
  u = f->process(scan(3, {{3 + 0.1414 * 5, 0, -1}}));
  EXPECT_EQ(outcomes(u), (std::vector<Outcome>{Outcome::kNew}));
  u = f->process(scan(4, {{3 + 0.1414 * 0.5, 0, -1}}));
  EXPECT_EQ(outcomes(u), (std::vector<Outcome>{Outcome::kKnown}));
  EXPECT_EQ(landmarks(f->estimate()).size(), 2u);
}

TEST(NearestNeighbour, GivesALandmarkOneSightingAScan)
{
  const auto f = filter("nn", 10, "confirm_sightings = 1\n");
  (void)f->process(scan(1, {{3, 0, -1}}));
  const auto u = f->process(scan(2, {{3.05, 0, -1}, {3.01, 0, -1}}));
  EXPECT_EQ(outcomes(u), (std::vector<Outcome>{Outcome::kRejected, Outcome::kKnown}));
}

namespace
{
/// A robot on a circle among 25 landmarks at least 2 m apart.
sim::Scenario scenario(double clutter, double detection)
{
  core::Config c = core::Config::parse(
      "[world]\nwidth_m = 16\nheight_m = 16\nlandmarks = 25\nlandmark_spacing_min_m = 2\n"
      "dt_s = 0.05\nsteps = 480\nscan_every = 8\n"
      "[robot]\nfollowing = false\nmotion = circle\nspeed_mps = 1.5\ncircle_radius_m = 5\n"
      "start = path\nv_std_mps = 0.1\nomega_std_radps = 0.05\nstart_known = true\n"
      "[landmark_sensor]\nrange_min_m = 0\nrange_max_m = 6\nbearing_min_deg = -180\n"
      "bearing_max_deg = 180\nrange_std_m = 0.05\nbearing_std_rad = 0.01\n"
      "[target_sensor]\nrange_max_m = 1\nrange_std_m = 0.1\nbearing_std_rad = 0.1\n",
      "test");
  c.set("landmark_sensor", "detection_probability", std::to_string(detection));
  c.set("landmark_sensor", "clutter_per_scan", std::to_string(clutter));
  return sim::Scenario::from(c);
}

core::FilterContext contextOf(const sim::World& world, std::uint64_t seed)
{
  core::FilterContext c;
  c.starts = world.starts();
  c.seed = seed;
  return c;
}

// An identity keeps a pair up to the outer gate, a neighbour up to the inner one.
const char* const kSameGates =
    "confirm_sightings = 3\ngate_probability = 0.999999\nnew_gate_probability = 0.9999999\n";
}  // namespace

TEST(NearestNeighbour, EqualsKnownAssociationInACleanWorldWellApart)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
  {
    SCOPED_TRACE(seed);
    sim::World world(scenario(0, 1), seed);
    const auto known = filter("known", 20, kSameGates, contextOf(world, seed));
    const auto nn = filter("nn", 20, kSameGates, contextOf(world, seed));
    while (auto step = world.next())
    {
      const core::Estimate a = known->process(*step).estimate;
      if (step->landmarks)
        for (core::Sighting& s : step->landmarks->sightings) s.id = core::kNoId;
      const core::Estimate b = nn->process(*step).estimate;
      ASSERT_EQ(a.robot.mean, b.robot.mean) << step->time;
      ASSERT_EQ(a.robot.cov, b.robot.cov) << step->time;
    }
    const auto m = landmarks(known->estimate()), n = landmarks(nn->estimate());
    EXPECT_GT(m.size(), 15u);
    ASSERT_EQ(m.size(), n.size());
    for (const auto& [id, l] : n)
      EXPECT_TRUE(std::any_of(m.begin(), m.end(),
                              [&](const auto& other)
                              {
                                return other.second.position.mean == l.position.mean &&
                                       other.second.position.cov == l.position.cov;
                              }));
  }
}

TEST(NearestNeighbour, MapsAWorldWithClutterAndMissedDetections)
{
  int missing = 0, wrong = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
  {
    sim::World world(scenario(2, 0.9), seed);
    const auto f = filter("nn", 40, "detection_probability = 0.7\n", contextOf(world, seed));
    std::map<int, int> seen;
    while (auto step = world.next())
    {
      if (step->landmarks)
        for (core::Sighting& s : step->landmarks->sightings) ++seen[s.id], s.id = core::kNoId;
      (void)f->process(*step);
    }
    seen.erase(core::kNoId);
    const auto map = landmarks(f->estimate());
    std::map<int, int> hits;
    for (const auto& [id, l] : map)
    {
      bool true_ = false;
      for (const auto& [truth, at] : world.truth().landmarks)
        if (std::hypot(at.x - l.position.mean.x, at.y - l.position.mean.y) < 0.5)
          true_ = ++hits[truth] == 1;
      wrong += !true_;
    }
    for (const auto& [id, n] : seen) missing += n >= 10 && hits.count(id) == 0;
  }
  EXPECT_EQ(missing, 0);
  EXPECT_LE(wrong, 2);
}
}  // namespace slamot::filters
