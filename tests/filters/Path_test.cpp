#include "rbpf/PathTree.h"

#include <slamot/core/Team.h>
#include <slamot/math/random.h>

#include "drives.h"
#include "filterRig.h"

namespace slamot::filters
{
namespace
{
using rbpf::PathTree;

class Path : public ::testing::TestWithParam<test::Way>
{
};
INSTANTIATE_TEST_SUITE_P(Each, Path, ::testing::ValuesIn(test::kWays), test::nameOf);

std::unique_ptr<core::Filter> filterOf(const test::Way& way, const laws::Drive& drive,
                                       int particles)
{
  core::FilterContext context;
  context.starts = drive.starts;
  return test::makeFilter("rbpf-slamot", test::keysOf(way, particles), context);
}

bool isNear(const Pose2D& a, const Pose2D& b)
{
  const Pose2D d = math::between(a, b);
  return std::hypot(d.x, d.y) < 1e-9 && std::abs(d.phi) < 1e-9;
}

bool isOneOf(const std::vector<core::WeightedPose>& particles, const Pose2D& pose)
{
  return std::any_of(particles.begin(), particles.end(),
                     [&](const auto& p) { return isNear(p.pose, pose); });
}

/// A drive whose sightings come in steps of their own, of the odometry's time.
std::vector<core::Step> parted(const std::vector<core::Step>& steps)
{
  std::vector<core::Step> out;
  for (const core::Step& step : steps)
  {
    out.push_back(step);
    out.back().landmarks.reset();
    out.back().blobs.reset();
    if (!step.landmarks && !step.blobs) continue;
    out.push_back(step);
    out.back().odometry.reset();
  }
  return out;
}
}  // namespace

// Against copies of whole paths, over random births.
TEST(PathTree, KeepsThePathsOfAllThatLivesAndLittleElse)
{
  constexpr std::size_t kParticles = 30, kDraws = 2000;
  math::RandomStream random{11};
  PathTree tree;
  std::vector<PathTree::Node> ends(kParticles, PathTree::kNone);
  std::vector<std::vector<double>> whole(kParticles);
  for (std::size_t draw = 0; draw < kDraws; ++draw)
  {
    for (std::size_t i = 0; i < kParticles; ++i)
    {
      whole[i].push_back(random.normal());
      ends[i] = tree.add(ends[i], {whole[i].back(), 0, 0});
    }
    tree.endDraw();
    tree.step(double(draw), {1, 0, 0}, true);
    const auto oldEnds = ends;
    const auto oldWhole = whole;
    for (std::size_t i = 0; i < kParticles && draw % 3 == 0; ++i)
    {
      const auto from = static_cast<std::size_t>(random.uniform(0, double(kParticles)));
      ends[i] = oldEnds[from], whole[i] = oldWhole[from];
    }
    if (!tree.isDue(kParticles)) continue;
    std::vector<PathTree::Node*> all;
    for (auto& end : ends) all.push_back(&end);
    tree.sweep(all);
  }
  EXPECT_LT(tree.size(), 3 * kDraws + 100 * kParticles) << "of " << kDraws * kParticles;
  for (std::size_t i = 0; i < kParticles; ++i)
  {
    const auto path = tree.path(ends[i]);
    ASSERT_EQ(path.size(), kDraws);
    for (std::size_t draw = 0; draw < kDraws; ++draw)
    {
      EXPECT_EQ(path[draw].time, double(draw));
      ASSERT_EQ(path[draw].pose.x, whole[i][draw] + 1) << i << " " << draw;
    }
  }
}

TEST_P(Path, OfOneParticleIsThatOfItsPoses)
{
  const laws::Drive drive = test::drive(GetParam(), 5);
  for (const auto& steps : {drive.steps, parted(drive.steps)})
  {
    const auto filter = filterOf(GetParam(), drive, 1);
    EXPECT_TRUE(filter->path().empty());
    std::vector<core::PathPose> expected;
    for (const core::Step& step : steps)
    {
      (void)filter->process(step);
      const core::PathPose now{step.time, filter->particles()[0].pose};
      if (step.odometry)
        expected.push_back(now);
      else
        expected.back() = now;
      const auto path = filter->path();
      ASSERT_EQ(path.size(), expected.size());
      EXPECT_TRUE(isNear(path.back().pose, now.pose)) << step.time;
    }
    const auto path = filter->path();
    for (std::size_t i = 0; i < path.size(); ++i)
    {
      EXPECT_EQ(path[i].time, expected[i].time);
      EXPECT_TRUE(isNear(path[i].pose, expected[i].pose)) << i;
    }
  }
}

// Each of its poses was a particle's then; its last is the heaviest one's.
TEST_P(Path, IsThatOfAParticleThroughResampling)
{
  laws::World world = test::worldOf(GetParam());
  world.steps = 300;
  const laws::Drive drive = laws::drive(world, 6);
  const auto filter = filterOf(GetParam(), drive, 25);
  std::vector<std::vector<core::WeightedPose>> particles;
  int resampled = 0;
  for (const core::Step& step : drive.steps)
  {
    resampled += filter->process(step).diagnostics.resampled;
    particles.push_back(filter->particles());
  }
  EXPECT_GT(resampled, 5);
  const auto path = filter->path();
  ASSERT_EQ(path.size(), drive.steps.size());
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    EXPECT_TRUE(isOneOf(particles[i], path[i].pose)) << i;
    const Pose2D error = math::between(drive.robot[i], path[i].pose);
    EXPECT_LT(std::hypot(error.x, error.y), 2.0) << i;
  }
  double most = 0;
  for (const auto& p : particles.back()) most = std::max(most, p.weight);
  const auto& last = particles.back();
  EXPECT_TRUE(std::any_of(last.begin(), last.end(),
                          [&](const auto& p)
                          { return p.weight == most && isNear(p.pose, path.back().pose); }));
}

TEST_P(Path, IsMovedAsAWholeByATeam)
{
  const laws::Drive drive = test::drive(GetParam(), 7);
  const auto filter = filterOf(GetParam(), drive, 30);
  for (std::size_t i = 0; i < 40; ++i) (void)filter->process(drive.steps[i]);
  const auto before = filter->path();
  auto& team = dynamic_cast<core::TeamFilter&>(*filter);
  const core::RobotAndTarget own = team.robotAndTarget(core::kNoId);
  core::Evidence e;  // of this robot's place, from afar
  e.H = Eigen::MatrixXd::Identity(2, own.mean.size());
  e.cov = 1e-4 * Eigen::MatrixXd::Identity(2, 2);
  e.independent = e.cov;
  e.innovation = Eigen::VectorXd::Constant(2, 0.2);
  ASSERT_TRUE(team.fuse(e, {core::FusionRule::kCi, 0.01, 5}).fused);
  for (int more = 0; more < 2; ++more)
  {
    const auto path = filter->path();
    ASSERT_EQ(path.size(), before.size() + static_cast<std::size_t>(more));
    EXPECT_TRUE(isOneOf(filter->particles(), path.back().pose)) << more;
    EXPECT_GT(std::hypot(path[0].pose.x - before[0].pose.x, path[0].pose.y - before[0].pose.y),
              0.05);
    if (more == 0) (void)filter->process(drive.steps[40]);
  }
}

TEST(PathOfAFilter, IsKeptByParticleFiltersAlone)
{
  const laws::Drive drive = test::drive(test::kWays[0], 8);
  const std::string target =
      "target_motion = damped-velocity\ntarget_velocity_std_mps = 0.8\n"
      "target_velocity_time_s = 2\n";
  for (const std::string name : {"fastslam1", "ufastslam", "slamot", "dead-reckoning"})
  {
    core::FilterContext context;
    context.starts = drive.starts;
    const bool hasParticles = name.find("fastslam") != std::string::npos;
    const auto filter = test::makeFilter(name, name == "dead-reckoning" ? "" : target, context);
    for (const core::Step& step : drive.steps) (void)filter->process(step);
    EXPECT_EQ(filter->path().size(), hasParticles ? drive.steps.size() : 0) << name;
  }
}
}  // namespace slamot::filters
