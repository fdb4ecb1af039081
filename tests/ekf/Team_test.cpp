#include <slamot/filters/EkfSlamot.h>

#include "dense.h"
#include "filterRig.h"

#include <slamot/core/Error.h>
#include <slamot/laws/Drive.h>

namespace slamot::filters
{
namespace
{
const char* const kKeys =
    "target_velocity_std_mps = 1\ntarget_acceleration_std_mps2 = 0.5\n"
    "target_jerk_noise_mps3_per_sqrt_hz = 0.2\n";

/// A filter in the middle of a drive; the same for the same keys.
std::unique_ptr<EkfSlamot> underWay(const std::string& keys = kKeys)
{
  const laws::Drive drive = laws::drive({}, 3);
  core::FilterContext context;
  context.starts = drive.starts;
  core::Config config = core::Config::parse("[ekf-slamot]\n" + keys, "test");
  core::Params params(config, "ekf-slamot");
  auto out = std::make_unique<EkfSlamot>(params, context);
  for (const core::Step& step : drive.steps) out->process(step);
  return out;
}

core::Evidence evidence(const EkfSlamot& filter, math::RandomStream& random)
{
  const auto own = filter.robotAndTarget(0);
  core::Evidence out;
  out.target = 0;
  out.H = Eigen::MatrixXd::Zero(8, own.mean.size());
  out.H.block<2, 2>(0, 0).setIdentity();
  out.H.block<6, 6>(2, 3).setIdentity();
  out.innovation = 0.1 * ekf::randomMatrix(8, 1, random);
  out.cov = 0.01 * ekf::randomCov(8, random);
  out.independent = 0.3 * out.cov;
  return out;
}

std::string bytesOf(const EkfSlamot& filter)
{
  std::string out;
  const auto put = [&](const auto& m)
  { out.append(reinterpret_cast<const char*>(m.data()), sizeof(double) * std::size_t(m.size())); };
  const auto joint = filter.robotAndTarget(0);
  put(joint.mean), put(joint.cov);
  for (const auto& [id, l] : test::landmarks(filter.estimate()))
    put(Vector2(l.position.mean.x, l.position.mean.y)), put(l.position.cov);
  return out;
}
}  // namespace

TEST(EkfTeam, TellsWhatItEstimates)
{
  const auto filter = underWay();
  const auto joint = filter->robotAndTarget(0);
  const auto e = filter->estimate();
  ASSERT_EQ(joint.mean.size(), 9);
  EXPECT_EQ(joint.mean[2], e.robot.mean.phi);
  EXPECT_EQ(joint.mean[3], e.targets[0].pose.mean.x);
  EXPECT_EQ(joint.mean[5], e.targets[0].velocity[0]);
  EXPECT_LT((joint.cov.topLeftCorner<3, 3>() - e.robot.cov).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_GT(joint.cov(0, 3), 0);
  EXPECT_GT(math::smallestEigenvalue(joint.cov), 0);
  EXPECT_EQ(filter->robotAndTarget(99).mean.size(), 3);
}

// P+⁻¹ = w P⁻¹ + (1 - w) Hᵀ B⁻¹ H on the block that is told.
TEST(EkfTeam, IntersectsCovariances)
{
  math::RandomStream random{1};
  const auto filter = underWay();
  const auto before = filter->robotAndTarget(0);
  const auto told = evidence(*filter, random);
  core::FusionOptions options;
  options.omega = 0.6;
  ASSERT_TRUE(filter->fuse(told, options).fused);
  const auto after = filter->robotAndTarget(0);
  const Eigen::MatrixXd information =
      0.6 * before.cov.inverse() + 0.4 * told.H.transpose() * told.cov.inverse() * told.H;
  const Eigen::MatrixXd cov = information.inverse();
  EXPECT_LT((after.cov - cov).cwiseAbs().maxCoeff(), 1e-9 * cov.cwiseAbs().maxCoeff());
  const Eigen::VectorXd mean =
      before.mean + 0.4 * cov * told.H.transpose() * told.cov.inverse() * told.innovation;
  EXPECT_LT((after.mean - mean).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(EkfTeam, FusesAlikeInTheCompressedForm)
{
  for (const auto rule : {core::FusionRule::kCi, core::FusionRule::kSplitCi, core::FusionRule::kIci,
                          core::FusionRule::kPaper})
  {
    const auto plain = underWay(), compressed = underWay(std::string(kKeys) + "local_radius_m=4\n");
    math::RandomStream random{2}, same{2};
    core::FusionOptions options;
    options.rule = rule;
    options.omega = 0.7;
    plain->fuse(evidence(*plain, random), options);
    compressed->fuse(evidence(*compressed, same), options);
    const auto a = test::landmarks(plain->estimate()), b = test::landmarks(compressed->estimate());
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [id, l] : a)
    {
      EXPECT_NEAR(l.position.mean.x, b.at(id).position.mean.x, 1e-9);
      EXPECT_LT((l.position.cov - b.at(id).position.cov).cwiseAbs().maxCoeff(), 1e-10);
    }
  }
}

// The method page: other means untouched, cross-covariances scaled.
TEST(EkfTeam, ThePapersRuleLeavesOtherMeansAlone)
{
  math::RandomStream random{1};
  const auto filter = underWay();
  const auto before = filter->robotAndTarget(0);
  const auto map = test::landmarks(filter->estimate());
  core::FusionOptions options;
  options.rule = core::FusionRule::kPaper;
  options.omega = 0.5;
  filter->fuse(evidence(*filter, random), options);
  const auto after = filter->robotAndTarget(0);
  EXPECT_EQ(after.mean[2], before.mean[2]);
  EXPECT_NE(after.mean[0], before.mean[0]);
  EXPECT_GT(math::smallestEigenvalue(after.cov), 0);
  for (const auto& [id, l] : test::landmarks(filter->estimate()))
    EXPECT_EQ(l.position.mean.x, map.at(id).position.mean.x);
}

TEST(EkfTeam, WhatDoesNotPayChangesNothing)
{
  math::RandomStream random{1};
  const auto filter = underWay();
  const std::string before = bytesOf(*filter);
  auto told = evidence(*filter, random);
  told.cov *= 1e8;
  told.independent *= 1e8;
  EXPECT_FALSE(filter->fuse(told, {}).fused);
  EXPECT_TRUE(bytesOf(*filter) == before);
  core::FusionOptions none;
  none.rule = core::FusionRule::kNone;
  EXPECT_FALSE(filter->fuse(evidence(*filter, random), none).fused);
  EXPECT_TRUE(bytesOf(*filter) == before);
}

TEST(EkfTeam, RefusesNonsenseAndStaysAsItWas)
{
  math::RandomStream random{1};
  const auto filter = underWay();
  const std::string before = bytesOf(*filter);
  const auto sound = evidence(*filter, random);
  auto nan = sound, small = sound, indefinite = sound, short_ = sound, turned = sound;
  short_.innovation = sound.innovation.head(2).eval();
  turned.H(0, 1) = 0.5;
  nan.innovation[3] = std::nan("");
  small.H = sound.H.leftCols(8).eval();
  indefinite.cov(0, 0) = -1;
  for (const auto rule : {core::FusionRule::kCi, core::FusionRule::kIci, core::FusionRule::kPaper})
    for (const auto* wrong : {&nan, &small, &indefinite, &short_})
    {
      core::FusionOptions options;
      options.rule = rule;
      EXPECT_THROW(filter->fuse(*wrong, options), core::Error);
      EXPECT_TRUE(bytesOf(*filter) == before);
    }
  core::FusionOptions paper;
  paper.rule = core::FusionRule::kPaper;
  EXPECT_THROW(filter->fuse(turned, paper), core::Error);
  EXPECT_TRUE(bytesOf(*filter) == before);
}

TEST(EkfTeam, PredictsAForeignTargetAsItsOwn)
{
  const auto filter = underWay();
  auto other = filter->robotAndTarget(0);
  const Eigen::MatrixXd before = other.cov;
  const Eigen::VectorXd mean = other.mean;
  filter->predictTarget(other, 0.5);
  EXPECT_NEAR(other.mean[3], mean[3] + 0.5 * mean[5] + 0.125 * mean[7], 1e-12);
  EXPECT_EQ(other.mean[0], mean[0]);
  EXPECT_NEAR(other.cov(0, 3), before(0, 3) + 0.5 * before(0, 5) + 0.125 * before(0, 7), 1e-12);
  EXPECT_GT(other.cov(3, 3), before(3, 3));
  core::Step step;
  step.time = filter->estimate().time + 0.5;
  filter->process(step);
  EXPECT_LT((filter->robotAndTarget(0).cov.bottomRightCorner<6, 6>() -
             other.cov.bottomRightCorner<6, 6>())
                .cwiseAbs()
                .maxCoeff(),
            1e-12);
}

// A target that waits for its heading has no velocity to tell, whatever its state holds.
TEST(EkfTeam, DoesNotTellOfATargetWithoutHeading)
{
  core::Config config = core::Config::parse(
      "[ekf-slamot]\ntarget_motion=differential-drive\ntarget_speed_mps=2\n"
      "target_turn_rate_deg_per_s=0\ntarget_speed_noise_mps=0.1\n"
      "target_turn_rate_noise_deg_per_s=1\n",
      "test");
  core::Params params(config, "ekf-slamot");
  EkfSlamot filter(params, {});
  int told = 0;
  for (int k = 0; k < 20; ++k)
  {
    core::Step step;
    step.time = 0.2 * k;
    core::Blob blob;
    blob.label = "target";
    blob.id = 4;
    const double x = 10 - 2 * step.time, y = 3;  // westwards
    blob.range = std::hypot(x, y);
    blob.bearing = std::atan2(y, x);
    blob.rangeStd = 0.1;
    blob.bearingStd = 0.01;
    step.blobs.emplace().blobs = {blob};
    EXPECT_EQ(filter.process(step).estimate.targets.size(), 1u);
    const auto joint = filter.robotAndTarget(4);
    EXPECT_TRUE(k > 0 || joint.targetSize() == 0);
    if (joint.targetSize() == 0) continue;
    ++told;
    EXPECT_LT(joint.mean[5], -1) << k;
  }
  EXPECT_GT(told, 5);
}

// A robot that shares one EKF with another is the two of them: each sees landmarks of the other.
TEST(CentralizedEkf, OneRobotAloneIsEkfSlamot)
{
  const laws::Drive drive = laws::drive({}, 3);
  core::FilterContext context;
  context.starts = drive.starts;
  core::Config config = core::Config::parse(std::string("[ekf-slamot]\n") + kKeys, "test");
  core::Params params(config, "ekf-slamot");
  EkfSlamot alone(params, context);
  CentralizedEkf shared(params, {context}, "robot", {0});
  for (const core::Step& step : drive.steps)
  {
    const auto a = alone.process(step).estimate, b = shared.process(0, step).estimate;
    ASSERT_EQ(a.robot.mean.x, b.robot.mean.x);
    ASSERT_EQ(a.robot.cov, b.robot.cov);
  }
}

TEST(CentralizedEkf, ARobotThatIsSeenIsPlacedByItsMate)
{
  core::Config config = core::Config::parse(std::string("[ekf-slamot]\n") + kKeys, "test");
  core::Params params(config, "ekf-slamot");
  std::vector<core::FilterContext> contexts(2);
  core::ObjectStart& lost = contexts[1].starts.robot.emplace();
  for (const auto f : {core::ObjectStart::kX, core::ObjectStart::kY})
    lost.value[f] = 3, lost.std[f] = 1;
  lost.value[core::ObjectStart::kTheta] = 0;
  CentralizedEkf shared(params, contexts, "robot", {core::kNoId, core::kNoId});
  core::Step step;
  step.time = 0;
  core::Blob mate;
  mate.label = "robot";
  mate.range = 5;
  mate.bearing = 0.6435011087932844;  // at (4, 3)
  mate.rangeStd = 0.01;
  mate.bearingStd = 0.001;
  core::Blob clutter = mate;
  clutter.bearing = -2;
  step.blobs.emplace().blobs = {mate, clutter};
  shared.process(0, step);
  const auto placed = shared.estimate(1).robot;
  EXPECT_NEAR(placed.mean.x, 4, 1e-2);
  EXPECT_NEAR(placed.mean.y, 3, 1e-2);
  EXPECT_LT(placed.cov(0, 0), 1e-3);
}
}  // namespace slamot::filters
