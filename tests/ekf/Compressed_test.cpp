#include "dense.h"
#include "filterRig.h"

#include <slamot/filters/EkfSlamot.h>
#include <slamot/sim/World.h>

namespace slamot::filters::ekf
{
namespace
{
/// Does the same to a plain and to a compressed belief.
class Twins
{
 public:
  template <class F>
  void both(F&& f)
  {
    math::RandomStream same = random;
    f(plain, same);
    f(compressed, random);
  }
  void expectEqual()
  {
    compressed.spread();
    ASSERT_EQ(plain.P().size(), compressed.P().size());
    const double scale = dense(plain.P()).cwiseAbs().maxCoeff();
    EXPECT_LT((dense(plain.P()) - dense(compressed.P())).cwiseAbs().maxCoeff(), 1e-11 * scale);
    EXPECT_LT((plain.x() - compressed.x()).cwiseAbs().maxCoeff(),
              1e-10 * (1 + plain.x().cwiseAbs().maxCoeff()));
  }

  Belief plain{1, 4}, compressed{1, 4};
  math::RandomStream random{3};
};

void start(Belief& b, math::RandomStream& random)
{
  const int slot = b.addTarget();
  b.set(b.robot(0), randomMatrix(3, 1, random), randomCov(3, random));
  b.set(b.target(slot), randomMatrix(4, 1, random), randomCov(4, random));
}

void addLandmark(Belief& b, math::RandomStream& random)
{
  const Gaussian<Point2D> place{{random.normal(), random.normal()}, randomCov(2, random)};
  b.addLandmark(0, place, randomMatrix(2, 3, random));
}

void step(Belief& b, math::RandomStream& random, const std::vector<int>& seen,
          const models::NoiseLaw* law = nullptr)
{
  b.move(0, b.x().segment<3>(0), randomMatrix(3, 3, random), randomCov(3, random));
  b.move(b.target(0), b.x().segment<4>(b.target(0)), 0.5 * randomMatrix(4, 4, random),
         randomCov(4, random));
  std::vector<SightingRows> rows{randomRows(0, b.target(0), random)};
  for (const int slot : seen) rows.push_back(randomRows(0, b.landmark(slot), random));
  for (SightingRows& r : rows) r.law = law;
  b.update(rows);
}

void intersect(Belief& b, math::RandomStream& random, math::Intersection rule)
{
  Belief::Rows H{{0, b.target(0)}, {randomMatrix(4, 3, random), randomMatrix(4, 4, random)}};
  const Eigen::MatrixXd W = b.product(H), B = randomCov(4, random);
  const Eigen::VectorXd nu = randomMatrix(4, 1, random);
  b.fuse(H, W,
         math::intersect(rule, Belief::innovationCov(H, W), nu, B, 0.5 * B, b.criterion(H, W, 2),
                         0.7));
}

/// As the paper's rule does it.
void shrink(Belief& b, math::RandomStream& random)
{
  const Eigen::MatrixXd C = 0.7 * b.P().block<2, 2>(0, 0);
  b.reshape(0, randomMatrix(2, 1, random), 0.8 * Eigen::MatrixXd::Identity(2, 2), C);
}
}  // namespace

TEST(Compressed, EqualsThePlainFormWhateverIsLocal)
{
  Twins t;
  t.both(start);
  for (int k = 0; k < 12; ++k) t.both(addLandmark);
  int freed = -1;  // kept local, so that both give its slot to the next landmark
  for (int round = 0; round < 20; ++round)
  {
    std::vector<int> local;
    for (int s = 0; s < t.plain.landmarks(); ++s)
      if (s == freed || t.random.uniform() < 0.4) local.push_back(s);
    t.compressed.focus(local);
    for (int k = 0; k < 5; ++k)
    {
      std::vector<int> seen;
      for (const int s : local)
        if (s != freed && t.random.uniform() < 0.5) seen.push_back(s);
      t.both([&](Belief& b, math::RandomStream& random) { step(b, random, seen); });
    }
    t.both(addLandmark);
    freed = -1;
    if (!local.empty() && round % 4 == 0)
    {
      freed = local.front();
      t.both([&](Belief& b, math::RandomStream&) { b.removeLandmark(freed); });
    }
    const auto last = t.plain.landmarks() - 1;
    for (int s = 0; s <= last; ++s)
    {
      const Gaussian<Point2D> a = t.plain.place(s), b = t.compressed.place(s);
      EXPECT_NEAR(a.mean.x, b.mean.x, 1e-9);
      EXPECT_LT((a.cov - b.cov).cwiseAbs().maxCoeff(), 1e-9);
    }
    t.expectEqual();
  }
}

TEST(Compressed, TakesGlintAsThePlainFormDoes)
{
  const models::NoiseLaw law({0.3, models::NoiseLaw::Tail::kStudent, 3, 2});
  Twins t;
  t.both(start);
  for (int k = 0; k < 8; ++k) t.both(addLandmark);
  for (const std::vector<int>& local : {std::vector<int>{0, 3, 4}, std::vector<int>{1, 4, 7}})
  {
    t.compressed.focus(local);
    for (int k = 0; k < 4; ++k)
      t.both([&](Belief& b, math::RandomStream& random) { step(b, random, local, &law); });
  }
  t.expectEqual();
}

TEST(Compressed, FusesAsThePlainFormDoes)
{
  for (const auto rule :
       {math::Intersection::kCovariance, math::Intersection::kSplit, math::Intersection::kInverse})
  {
    Twins t;
    t.both(start);
    for (int k = 0; k < 8; ++k) t.both(addLandmark);
    t.compressed.focus({1, 4, 6});
    for (int k = 0; k < 10; ++k)
    {
      t.both([&](Belief& b, math::RandomStream& random) { step(b, random, {4, 1}); });
      t.both([&](Belief& b, math::RandomStream& random) { intersect(b, random, rule); });
      t.both(shrink);
      const Belief::Rows H{{0}, {Eigen::MatrixXd::Identity(3, 3)}};
      const auto a = t.plain.criterion(H, t.plain.product(H), 3);
      const auto b = t.compressed.criterion(H, t.compressed.product(H), 3);
      EXPECT_NEAR(a.trace, b.trace, 1e-10 * a.trace);
      EXPECT_LT((a.gram - b.gram).cwiseAbs().maxCoeff(), 1e-10 * a.gram.cwiseAbs().maxCoeff());
    }
    t.expectEqual();
  }
}

TEST(Compressed, MakesRoomForTargetsWhileSomeAreLocal)
{
  Twins t;
  t.both(start);
  for (int k = 0; k < 6; ++k) t.both(addLandmark);
  t.compressed.focus({0, 2});
  t.both([](Belief& b, math::RandomStream& random) { step(b, random, {2}); });
  t.both(
      [](Belief& b, math::RandomStream& random)
      {
        const int slot = b.addTarget();
        b.set(b.target(slot), randomMatrix(4, 1, random), randomCov(4, random));
      });
  t.expectEqual();
}

/// What another robot could have told, the same for filters that believe the same.
static core::Evidence evidenceFor(const core::RobotAndTarget& own)
{
  core::Evidence out;
  out.H = Eigen::MatrixXd::Zero(2, own.mean.size());
  out.H.leftCols<2>().setIdentity();
  out.innovation = Vector2(0.01, -0.02);
  out.cov = 0.5 * own.cov.topLeftCorner<2, 2>() + 1e-4 * Matrix2::Identity();
  out.independent = Matrix2::Zero();
  return out;
}

/// Hundreds of metres among landmarks, with targets, births, many changes of what is local, and
/// now and then a fusion.
static void expectEqualDrives(const std::string& association, const std::string& more = "")
{
  core::Config scenario = core::Config::parse(
      "[world]\nwidth_m=120\nheight_m=60\nlandmarks=120\nsteps=900\ndt_s=0.2\nscan_every=1\n"
      "[robot]\nmotion=waypoints\nspeed_mps=2\nturn_gain_per_s=1\nturn_max_radps=0.7\n"
      "waypoints_m=10,10, 110,12, 108,50, 12,48\nloop=true\nwaypoint_reached_m=2\nstart=path\n"
      "v_std_mps=0.1\nomega_std_radps=0.02\n"
      "[target_0]\nmotion=circle\nspeed_mps=1.5\ncircle_radius_m=20\ncentre_x_m=60\n"
      "centre_y_m=30\nstart=path\nv_std_mps=0.2\nomega_std_radps=0.05\nstart_known=false\n"
      "[landmark_sensor]\nrange_max_m=15\nrange_std_m=0.2\nbearing_std_rad=0.01\n"
      "detection_probability=0.9\n[target_sensor]\nrange_max_m=15\nrange_std_m=0.2\n"
      "bearing_std_rad=0.01\n",
      "test");
  scenario.set("landmark_sensor", "identities", association == "known" ? "true" : "false");
  const auto keys = [&](const std::string& radius)
  {
    return "target_velocity_std_mps=2\ntarget_acceleration_std_mps2=1\n"
           "target_jerk_noise_mps3_per_sqrt_hz=0.3\nlandmark_tentative_s=6\nassociation=" +
           association + "\nlocal_radius_m=" + radius + "\n" + more;
  };
  const sim::Scenario s = sim::Scenario::from(scenario);
  sim::World world(s, 1);
  core::FilterContext context;
  context.starts = world.starts();
  std::vector<std::unique_ptr<core::Filter>> filters;
  for (const char* radius : {"0", "8", "20", "40"})
    filters.push_back(test::makeFilter("ekf-slamot", keys(radius), context));
  std::size_t steps = 0, tracked = 0;
  while (const auto step = world.next())
  {
    ++steps;
    std::vector<core::Estimate> estimates;
    for (auto& f : filters)
    {
      f->process(*step);
      auto& member = dynamic_cast<core::TeamFilter&>(*f);
      core::FusionOptions options;
      options.omega = 0.95;
      if (steps % 60 == 0) member.fuse(evidenceFor(member.robotAndTarget(core::kNoId)), options);
      estimates.push_back(f->estimate());
    }
    tracked += estimates[0].targets.size();
    for (std::size_t k = 1; k < estimates.size(); ++k)
    {
      const auto &a = estimates[0], &b = estimates[k];
      ASSERT_NEAR(a.robot.mean.x, b.robot.mean.x, 1e-8) << steps;
      ASSERT_NEAR(a.robot.mean.phi, b.robot.mean.phi, 1e-9) << steps;
      ASSERT_LT((a.robot.cov - b.robot.cov).cwiseAbs().maxCoeff(),
                1e-8 * a.robot.cov.cwiseAbs().maxCoeff());
      ASSERT_EQ(a.targets.size(), b.targets.size()) << steps;
      for (std::size_t i = 0; i < a.targets.size(); ++i)
        ASSERT_NEAR(a.targets[i].pose.mean.x, b.targets[i].pose.mean.x, 1e-7) << steps;
    }
  }
  EXPECT_GT(tracked, 100u);
  const auto map = test::landmarks(filters[0]->estimate());
  EXPECT_GT(map.size(), 80u);
  for (std::size_t k = 1; k < filters.size(); ++k)
  {
    const auto other = test::landmarks(filters[k]->estimate());
    ASSERT_EQ(map.size(), other.size());
    for (const auto& [id, l] : map)
    {
      EXPECT_NEAR(l.position.mean.x, other.at(id).position.mean.x, 1e-7);
      EXPECT_LT((l.position.cov - other.at(id).position.cov).cwiseAbs().maxCoeff(),
                1e-7 * l.position.cov.cwiseAbs().maxCoeff());
    }
  }
}

TEST(Compressed, EqualsThePlainFormOverALongDrive)
{
  expectEqualDrives("known");
  expectEqualDrives("known", "first_estimates=true\n");
}

TEST(Compressed, EqualsThePlainFormWithoutIdentities)
{
  expectEqualDrives("nn");
  expectEqualDrives("jcbb");
  expectEqualDrives("mht", "detection_probability=0.9\nfirst_estimates=true\n");
}
}  // namespace slamot::filters::ekf
