#include "../results/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <slamot/core/Error.h>
#include <slamot/core/FilterRegistry.h>
#include <slamot/filters/registerAll.h>
#include <slamot/mrpt/CLandmarkGaussianMap.h>
#include <slamot/mrpt/MapBuilder.h>
#include <slamot/mrpt/RawlogSource.h>
#include <slamot/mrpt/RawlogWriter.h>
#include <slamot/results/RunPlan.h>

namespace slamot::mrpt
{
namespace
{
const std::string kSource = SLAMOT_SOURCE_DIR;
const std::string kLog = kSource + "/share/datasets/experiment1.rawlog";

core::Config config(const std::string& name)
{
  return core::Config::load(kSource + "/config-ini/" + name);
}

/// What slamot's own pipeline believes after each step of the log.
std::vector<Gaussian<Pose2D>> expected(core::Config ini, const std::string& log)
{
  filters::registerAll();
  RawlogSource source(log, RawlogSource::Options::from(ini));
  const auto plan = results::planRun(ini, source.starts());
  core::FilterContext context;
  context.starts = plan.starts, context.seed = plan.seed;
  const auto filter = core::FilterRegistry::instance().make(plan.method, ini, context);
  std::vector<Gaussian<Pose2D>> poses;
  while (const auto step = source.next()) poses.push_back(filter->process(*step).estimate.robot);
  return poses;
}

core::Starts startsOf(const std::string& log, const RawlogSource::Options& options = {})
{
  return RawlogSource(log, options).starts();
}

void expectPose(const MapBuilder& builder, const Gaussian<Pose2D>& pose, std::size_t step)
{
  const auto [cov, mean] = builder.getCurrentPoseEstimation()->getCovarianceAndMean();
  ASSERT_NEAR(mean.x(), pose.mean.x, 1e-12) << "step " << step;
  ASSERT_NEAR(mean.y(), pose.mean.y, 1e-12) << "step " << step;
  ASSERT_NEAR(math::wrapToPi(mean.yaw() - pose.mean.phi), 0, 1e-12) << "step " << step;
  ASSERT_NEAR(cov(0, 1), pose.cov(0, 1), 1e-12) << "step " << step;
  ASSERT_NEAR(cov(3, 3), pose.cov(2, 2), 1e-12) << "step " << step;
}

/// Feeds a log of pairs; `after` is called after each.
template <class After>
void feed(MapBuilder& builder, const std::string& path, After after)
{
  ::mrpt::obs::CRawlog log;
  ASSERT_TRUE(log.loadFromRawLogFile(path));
  ::mrpt::obs::CActionCollection::Ptr actions;
  ::mrpt::obs::CSensoryFrame::Ptr frame;
  for (std::size_t at = 0; at < log.size() && log.getActionObservationPair(actions, frame, at);)
  {
    builder.processActionObservation(*actions, *frame);
    after();
  }
}

class MapBuilderOf : public ::testing::TestWithParam<std::string>
{
};

TEST_P(MapBuilderOf, BelievesWhatSlamotRunDoes)
{
  const auto poses = expected(config(GetParam()), kLog);
  MapBuilder builder(config(GetParam()), startsOf(kLog));
  std::size_t step = 0;
  feed(builder, kLog, [&] { expectPose(builder, poses.at(step), step), ++step; });
  EXPECT_EQ(step, poses.size());
}

INSTANTIATE_TEST_SUITE_P(Filters, MapBuilderOf,
                         ::testing::Values("rbpf-slamot.experiment1.ini",
                                           "ekf-slamot.experiment1.ini",
                                           "odometry.experiment1.ini"),
                         [](const auto& p) { return "config" + std::to_string(p.index); });

TEST(MapBuilder, TakesObservationsOneByOne)
{
  // The same log as observations only: odometry without covariance has the noise of a model.
  const slamot::test::TemporaryFolder folder;
  const std::string log = folder.file("observations.rawlog");
  RawlogSource pairs(kLog, {});
  {
    RawlogWriter writer(log, RawlogWriter::Format::kObservations, pairs.starts());
    while (const auto step = pairs.next()) writer.write(*step);
    writer.close();
  }
  core::Config ini = config("ekf-slamot.experiment1.ini");
  ini.set("odometer.noise=model");
  ini.set("odometer.v_std_mps=0.1");
  ini.set("odometer.omega_std_deg_per_s=5");
  const auto poses = expected(ini, log);
  const core::Starts starts = startsOf(log, RawlogSource::Options::from(ini));
  MapBuilder builder(ini, starts);
  ::mrpt::obs::CRawlog raw;
  ASSERT_TRUE(raw.loadFromRawLogFile(log));
  for (const auto& object : raw)
    if (const auto o = std::dynamic_pointer_cast<::mrpt::obs::CObservation>(object))
      builder.processObservation(o);
  builder.flush();
  expectPose(builder, poses.back(), poses.size() - 1);

  MapBuilder unsure(config("ekf-slamot.experiment1.ini"), starts);
  const auto feedAll = [&]
  {
    for (const auto& object : raw)
      if (const auto o = std::dynamic_pointer_cast<::mrpt::obs::CObservation>(object))
        unsure.processObservation(o);
  };
  EXPECT_THROW(feedAll(), core::Error) << "nobody tells how sure the odometry is";
}

TEST(MapBuilder, HandsOutItsMaps)
{
  MapBuilder builder(config("rbpf-slamot.experiment1.ini"), startsOf(kLog));
  feed(builder, kLog, [] {});
  const auto* metric = builder.getCurrentlyBuiltMetricMap();
  const auto landmarks = metric->mapByClass<maps::CLandmarkGaussianMap>();
  ASSERT_TRUE(landmarks);
  EXPECT_EQ(landmarks->landmarks().size(), 20u);
  ::mrpt::maps::CSimpleMap frames;
  builder.getCurrentlyBuiltMap(frames);
  EXPECT_EQ(frames.size(), builder.getCurrentlyBuiltMapSize());
  EXPECT_GT(frames.size(), 30u);
  EXPECT_LT(frames.size(), 160u) << "not those where it has hardly moved";

  builder.initialize();
  EXPECT_EQ(builder.getCurrentlyBuiltMapSize(), 0u);
  EXPECT_TRUE(landmarks->isEmpty());
}

TEST(MapBuilder, KeepsNoFramesWhenItsMapIsNotToGrow)
{
  MapBuilder builder(config("rbpf-slamot.experiment1.ini"), startsOf(kLog));
  builder.enableMapUpdating(false);
  feed(builder, kLog, [] {});
  EXPECT_EQ(builder.getCurrentlyBuiltMapSize(), 0u);
}

TEST(MapBuilder, BeginsWhereItIsTold)
{
  MapBuilder builder(config("odometry.experiment1.ini"));
  ::mrpt::poses::CPosePDFGaussian x0(::mrpt::poses::CPose2D(1, 2, 0.5));
  x0.cov(0, 0) = 0.04;
  builder.initialize({}, &x0);
  const auto [cov, mean] = builder.getCurrentPoseEstimation()->getCovarianceAndMean();
  EXPECT_DOUBLE_EQ(mean.x(), 1);
  EXPECT_DOUBLE_EQ(mean.yaw(), 0.5);
  EXPECT_NEAR(cov(0, 0), 0.04, 1e-12);
}

TEST(MapBuilder, RefusesWhatMakesNoSense)
{
  EXPECT_THROW(MapBuilder(core::Config::parse("[no-such-filter]\n", "a.ini")), core::Error);
  core::Config misspelt = config("odometry.experiment1.ini");
  misspelt.set("odometry.no_such_key=1");
  EXPECT_THROW(MapBuilder{misspelt}, core::Error);
  MapBuilder builder(config("odometry.experiment1.ini"));
  ::mrpt::maps::CSimpleMap map;
  map.insert(std::make_shared<::mrpt::poses::CPose3DPDFGaussian>(),
             std::make_shared<::mrpt::obs::CSensoryFrame>());
  EXPECT_THROW(builder.initialize(map), core::Error);
}

TEST(MapBuilder, DrawsWhatItBelieves)
{
  const slamot::test::TemporaryFolder folder;
  MapBuilder builder(config("rbpf-slamot.experiment1.ini"), startsOf(kLog));
  feed(builder, kLog, [] {});
  try
  {
    builder.saveCurrentEstimationToImage(folder.file("a.png"));
  }
  catch (const core::Error& e)
  {
    if (e.status() == core::ExitStatus::kInternal) GTEST_SKIP() << e.what();
    throw;
  }
  EXPECT_EQ(folder.read("a.png").substr(1, 3), "PNG");
}
}  // namespace
}  // namespace slamot::mrpt
