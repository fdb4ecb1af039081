#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/poses/CPosePDFGaussianInf.h>
#include <mrpt/poses/CPosePDFParticles.h>
#include <mrpt/poses/CPosePDFSOG.h>
#include <mrpt/random/RandomGenerators.h>
#include <slamot/core/Error.h>

#include <cmath>
#include <ctime>

#include "bytes.h"
#include "exampleLog.h"

// Logs that others wrote: made here with MRPT's own classes.
namespace slamot::tests
{
namespace
{
using namespace ::mrpt::obs;
using ::mrpt::poses::CPose2D;
using ::mrpt::poses::CPose3D;
using slamot::mrpt::RawlogSource;

/// Reads what `bytes` hold.
std::vector<core::Step> readBytes(const std::string& bytes,
                                  const RawlogSource::Options& options = {})
{
  const TemporaryFolder folder;
  savePacked(folder.file("x.rawlog"), bytes);
  RawlogSource source(folder.file("x.rawlog"), options);
  return readAll(source);
}

std::string pairOf(CActionRobotMovement2D movement,
                   const std::vector<CObservation::Ptr>& observations = {})
{
  CActionCollection actions;
  actions.insert(movement);
  CSensoryFrame frame;
  for (const auto& o : observations) frame.insert(o);
  return serialized(actions) + serialized(frame);
}

CActionRobotMovement2D odometry(
    const Pose2D& increment,
    CActionRobotMovement2D::TDrawSampleMotionModel model = CActionRobotMovement2D::mmGaussian)
{
  CActionRobotMovement2D::TMotionModelOptions options;
  options.modelSelection = model;
  CActionRobotMovement2D movement;
  movement.computeFromOdometry(CPose2D(increment), options);
  movement.timestamp = ::mrpt::Clock::fromDouble(1);
  return movement;
}

CActionRobotMovement2D matched(const ::mrpt::poses::CPosePDF::Ptr& pdf)
{
  CActionRobotMovement2D movement;
  movement.estimationMethod = CActionRobotMovement2D::emScan2DMatching;
  movement.poseChange = pdf;
  movement.hasVelocities = movement.hasEncodersInfo = true;
  movement.timestamp = ::mrpt::Clock::fromDouble(1);
  return movement;
}

::mrpt::math::CMatrixDouble33 exampleCov()
{
  ::mrpt::math::CMatrixDouble33 cov;
  cov.setZero();
  cov(0, 0) = 0.04, cov(1, 1) = 0.01, cov(2, 2) = 0.0025;
  cov(0, 1) = cov(1, 0) = 0.003, cov(1, 2) = cov(2, 1) = 0.001;
  return cov;
}

std::vector<::mrpt::poses::CPosePDF::Ptr> pdfs()
{
  using namespace ::mrpt::poses;
  const CPose2D mean(0.5, 0.1, 0.2);
  auto inf = CPosePDFGaussianInf::Create(mean);
  inf->cov_inv = exampleCov().inverse_LLt();
  auto particles = CPosePDFParticles::Create(50);
  for (std::size_t i = 0; i < 50; ++i)
    particles->m_particles[i].d = {0.01 * static_cast<double>(i), 0.2,
                                   0.001 * static_cast<double>(i * i)};
  auto modes = CPosePDFSOG::Create(2);
  for (std::size_t i = 0; i < 2; ++i)
  {
    modes->get(i).mean = CPose2D(0.1 + 0.1 * static_cast<double>(i), 0, 0.1);
    modes->get(i).cov = exampleCov();
    modes->get(i).log_w = -static_cast<double>(i);
  }
  return {CPosePDFGaussian::Create(mean, exampleCov()), inf, particles, modes};
}

void expectIncrement(const core::Step& step, const ::mrpt::poses::CPosePDF& pdf)
{
  const auto [cov, mean] = pdf.getCovarianceAndMean();
  ASSERT_TRUE(step.odometry);
  EXPECT_NEAR(step.odometry->mean.x, mean.x(), 1e-12);
  EXPECT_NEAR(step.odometry->mean.y, mean.y(), 1e-12);
  EXPECT_NEAR(step.odometry->mean.phi, mean.phi(), 1e-12);
  EXPECT_LT((step.odometry->cov - cov.asEigen()).norm(), 1e-9);
}

TEST(RawlogReading, EveryKindOfMovementPdfGivesMeanAndCovariance)
{
  for (const auto& pdf : pdfs())
  {
    SCOPED_TRACE(pdf->GetRuntimeClass()->className);
    const auto steps = readBytes(pairOf(matched(pdf)));
    ASSERT_EQ(steps.size(), 1u);
    EXPECT_EQ(steps[0].time, 1);
    if (!dynamic_cast<const ::mrpt::poses::CPosePDFParticles*>(pdf.get()))
      expectIncrement(steps[0], *pdf);
  }
}

TEST(RawlogReading, ParticlesKeepTheCorrelationOfHeadingAndPosition)
{
  auto particles = ::mrpt::poses::CPosePDFParticles::Create(2);
  particles->m_particles[0].d = {1, 0, 3.1};
  particles->m_particles[1].d = {2, 0, -3.1};  // 2 pi - 6.2 further to the left
  const auto steps = readBytes(pairOf(matched(particles)));
  const Gaussian<Pose2D>& odometry = steps.at(0).odometry.value();
  const double half = math::kPi - 3.1;
  EXPECT_NEAR(odometry.mean.x, 1.5, 1e-12);
  EXPECT_NEAR(std::abs(odometry.mean.phi), math::kPi, 1e-12);
  EXPECT_NEAR(odometry.cov(2, 2), half * half, 1e-12);
  EXPECT_NEAR(odometry.cov(0, 2), 0.5 * half, 1e-12);
}

TEST(RawlogReading, GaussianMotionModelGivesWhatMrptComputes)
{
  const auto movement = odometry({0.7, 0.1, 0.3});
  const auto steps = readBytes(pairOf(movement));
  ASSERT_EQ(steps.size(), 1u);
  ASSERT_TRUE(steps[0].odometry);
  // The model's parameters are floats in the file.
  const auto [cov, mean] = movement.poseChange->getCovarianceAndMean();
  EXPECT_EQ(steps[0].odometry->mean, mean.asTPose());
  EXPECT_LT((steps[0].odometry->cov - cov.asEigen()).norm(), 1e-6 * cov.asEigen().norm());
}

/// Moments of the particles that MRPT draws from Thrun's model.
Gaussian<Pose2D> sampled(const Pose2D& increment)
{
  CActionRobotMovement2D::TMotionModelOptions options;
  options.modelSelection = CActionRobotMovement2D::mmThrun;
  options.thrunModel.nParticlesCount = 50000;
  CActionRobotMovement2D movement;
  ::mrpt::random::getRandomGenerator().randomize(7);
  movement.computeFromOdometry(CPose2D(increment), options);
  const auto steps = readBytes(pairOf(matched(movement.poseChange.get_ptr())));
  return steps.at(0).odometry.value();
}

TEST(RawlogReading, ThrunMotionModelHasTheMomentsOfItsSamples)
{
  for (const Pose2D& increment : {Pose2D(0.7, 0.1, 0.3), Pose2D(0, 0, 1), Pose2D(-0.5, 0, 0)})
  {
    const Gaussian<Pose2D> drawn = sampled(increment);
    const auto steps = readBytes(pairOf(odometry(increment, CActionRobotMovement2D::mmThrun)));
    ASSERT_EQ(steps.size(), 1u);
    ASSERT_TRUE(steps[0].odometry);
    const Gaussian<Pose2D>& exact = *steps[0].odometry;
    EXPECT_NEAR(exact.mean.x, drawn.mean.x, 2e-3);
    EXPECT_NEAR(exact.mean.y, drawn.mean.y, 2e-3);
    EXPECT_NEAR(exact.mean.phi, drawn.mean.phi, 5e-3);
    EXPECT_LT((exact.cov - drawn.cov).norm(), 0.03 * exact.cov.norm()) << exact.cov << "\n\n"
                                                                       << drawn.cov;
  }
}

TEST(RawlogReading, ThrunMotionModelIsTheSameEveryTime)
{
  const std::string bytes = pairOf(odometry({0.7, 0.1, 0.3}, CActionRobotMovement2D::mmThrun));
  EXPECT_EQ(readBytes(bytes)[0].odometry->cov, readBytes(bytes)[0].odometry->cov);
}

TEST(RawlogReading, ScanMatchingGoesBeforeOdometry)
{
  CActionCollection actions;
  auto wheels = odometry({1, 0, 0});
  auto laser = matched(pdfs()[0]);
  actions.insert(wheels);
  actions.insert(laser);
  const auto steps = readBytes(serialized(actions) + serialized(CSensoryFrame()));
  ASSERT_EQ(steps.size(), 1u);
  expectIncrement(steps[0], *pdfs()[0]);
}

TEST(RawlogReading, MovementIn3DIsRefused)
{
  CActionCollection actions;
  CActionRobotMovement3D movement;
  actions.insert(movement);
  try
  {
    readBytes(serialized(actions) + serialized(CSensoryFrame()));
    FAIL();
  }
  catch (const core::Error& e)
  {
    EXPECT_EQ(e.status(), core::ExitStatus::kUnreadable);
    EXPECT_NE(std::string(e.what()).find("3D"), std::string::npos);
  }
}

TEST(RawlogReading, ActionsWithoutFramesAreSteps)
{
  CActionCollection actions;
  auto movement = odometry({1, 0, 0});
  actions.insert(movement);
  EXPECT_EQ(
      readBytes(serialized(actions) + serialized(actions) + serialized(CSensoryFrame())).size(),
      2u);
}

std::shared_ptr<CObservationBearingRange> sighting(double time, float range, float yaw)
{
  auto o = std::make_shared<CObservationBearingRange>();
  o->timestamp = ::mrpt::Clock::fromDouble(time);
  o->fieldOfView_yaw = 6.3f;
  o->sensor_std_range = 0.1f, o->sensor_std_yaw = o->sensor_std_pitch = 0.02f;
  o->sensedData.push_back({range, yaw, 0, 4, {}});
  return o;
}

TEST(RawlogReading, DisplacedSensorsSightingsGoToTheRobotsFrame)
{
  auto o = sighting(1, 2, 0);
  o->sensorLocationOnRobot = CPose3D(1, 0, 0.5, 0, 0, 0);
  const auto ahead = readBytes(serialized(*o));
  ASSERT_EQ(ahead.size(), 1u);
  const core::Sighting s = ahead[0].landmarks->sightings.at(0);
  EXPECT_NEAR(s.range, 3, 1e-6);
  EXPECT_NEAR(s.bearing, 0, 1e-6);
  EXPECT_NEAR(s.rangeStd, 0.1, 1e-6);
  EXPECT_NEAR(s.bearingStd, 0.02 * 2 / 3, 1e-6);  // the same arc from further away

  o->sensorLocationOnRobot = CPose3D(0, 1, 0, math::kPi / 2, 0, 0);
  const core::Sighting left = readBytes(serialized(*o))[0].landmarks->sightings.at(0);
  EXPECT_NEAR(left.range, 3, 1e-6);
  EXPECT_NEAR(left.bearing, math::kPi / 2, 1e-6);
}

TEST(RawlogReading, SightingsFromAboveAreLaidIntoThePlane)
{
  auto o = sighting(1, 2, 0.3f);
  o->sensedData[0].pitch = 0.5f;
  o->sensorLocationOnRobot = CPose3D(0, 0, 1, 0, 0, 0);
  const core::Sighting s = readBytes(serialized(*o))[0].landmarks->sightings.at(0);
  EXPECT_NEAR(s.range, 2 * std::cos(0.5), 1e-6);
  EXPECT_NEAR(s.bearing, 0.3, 1e-6);
  EXPECT_NEAR(s.rangeStd, std::hypot(0.1 * std::cos(0.5), 0.02 * 2 * std::sin(0.5)), 1e-6);
}

TEST(RawlogReading, CovariancesOfSightingsAreUsed)
{
  auto o = sighting(1, 2, 0);
  o->validCovariances = true;
  o->sensedData[0].covariance.setDiagonal(0.25);
  const core::Sighting s = readBytes(serialized(*o))[0].landmarks->sightings.at(0);
  EXPECT_NEAR(s.rangeStd, 0.5, 1e-9);
  EXPECT_NEAR(s.bearingStd, 0.5, 1e-9);
}

TEST(RawlogReading, ViewTurnsWithTheSensorAndIsNeverClaimedTooLarge)
{
  auto o = sighting(1, 2, 0);
  o->fieldOfView_yaw = 1;
  o->maxSensorDistance = 5;
  o->sensorLocationOnRobot = CPose3D(0, 0, 0, 1, 0, 0);
  const auto left = readBytes(serialized(*o))[0].landmarks->fov;
  EXPECT_NEAR(left.bearingMin, 0.5, 1e-6);
  EXPECT_NEAR(left.bearingMax, 1.5, 1e-6);
  EXPECT_NEAR(left.rangeMax, 5, 1e-6);

  o->sensorLocationOnRobot = CPose3D(0, 0, 0, math::kPi - 0.2, 0, 0);
  o->sensedData[0].yaw = 0.4f;  // beyond the robot's back, still in view of the sensor
  const auto back = *readBytes(serialized(*o))[0].landmarks;
  EXPECT_NEAR(back.fov.bearingMin, math::kPi - 0.7, 1e-6);
  EXPECT_NEAR(back.fov.bearingMax, math::kPi, 1e-6);
  ASSERT_EQ(back.sightings.size(), 1u);
  EXPECT_NEAR(back.sightings[0].bearing, -math::kPi + 0.2, 1e-6);
}

TEST(RawlogReading, GivenDeviationsStandInForMissingOnes)
{
  auto o = sighting(1, 2, 0);
  o->sensor_std_range = o->sensor_std_yaw = 0;
  RawlogSource::Options options;
  options.sensor = {0.3, 0.05};
  const core::Sighting s = readBytes(serialized(*o), options)[0].landmarks->sightings.at(0);
  EXPECT_NEAR(s.rangeStd, 0.3, 1e-12);
  EXPECT_NEAR(s.bearingStd, 0.05, 1e-12);
}

TEST(RawlogReading, LaserBeamsRunCounterClockwiseHoweverTheSensorTurns)
{
  CObservation2DRangeScan scan;
  scan.timestamp = ::mrpt::Clock::fromDouble(1);
  scan.aperture = 2;
  scan.maxRange = 10;
  const float ranges[] = {1, 2, 3};
  const char valid[] = {1, 0, 1};
  scan.loadFromVectors(3, ranges, valid);
  scan.setScanHasIntensity(true);
  const auto first = [&](bool rightToLeft, double roll)
  {
    scan.rightToLeft = rightToLeft;
    scan.sensorPose = CPose3D(0, 0, 0, 0, 0, roll);
    const auto laser = readBytes(serialized(scan))[0].lasers.at(0);
    EXPECT_NEAR(laser->angleMin, -1, 1e-6);
    EXPECT_NEAR(laser->angleStep, 1, 1e-6);
    EXPECT_GT(laser->ranges[1], laser->rangeMax);  // not valid: no return
    return laser->ranges[0];
  };
  EXPECT_EQ(first(true, 0), 1);
  EXPECT_EQ(first(false, 0), 3);
  EXPECT_EQ(first(true, math::kPi), 3);
  EXPECT_EQ(first(false, math::kPi), 1);
}

std::vector<CObservation::Ptr> others()
{
  auto imu = std::make_shared<CObservationIMU>();
  imu->sensorLabel = "IMU";
  auto image = std::make_shared<CObservationImage>();
  image->image.resize(40, 30, ::mrpt::img::CH_RGB);
  // All pixels of the byte that ends objects.
  image->image.filledRectangle(0, 0, 39, 29, ::mrpt::img::TColor(0x88, 0x88, 0x88));
  return {imu, image};
}

TEST(RawlogReading, ObservationsOfOtherKindsAreSkipped)
{
  for (const auto& other : others())
  {
    SCOPED_TRACE(other->GetRuntimeClass()->className);
    const auto inFrame =
        readBytes(pairOf(odometry({1, 0, 0}), {other, sighting(3, 2, 0), other, other}) +
                  pairOf(odometry({1, 0, 0}), {sighting(4, 2, 0)}));
    ASSERT_EQ(inFrame.size(), 2u);
    EXPECT_EQ(inFrame[0].landmarks->sightings.size(), 1u);
    EXPECT_EQ(inFrame[1].time, 4);

    const std::string o = serialized(*other);
    EXPECT_EQ(
        readBytes(o + serialized(*sighting(3, 2, 0)) + o + o + serialized(*sighting(4, 2, 0)) + o)
            .size(),
        2u);
  }
}

TEST(RawlogReading, OtherKindCutShortIsTruncated)
{
  for (const auto& other : others())
  {
    const std::string o = serialized(*other);
    try
    {
      readBytes(serialized(*sighting(3, 2, 0)) + o.substr(0, o.size() - 1));
      FAIL();
    }
    catch (const core::Error& e)
    {
      EXPECT_EQ(e.status(), core::ExitStatus::kTruncated) << e.what();
    }
  }
}

TEST(RawlogReading, ObservationsOfOneTimeAreOneStep)
{
  const auto steps = readBytes(serialized(*sighting(3, 2, 0)) + serialized(*others()[0]) +
                               serialized(*sighting(3, 4, 1)) + serialized(*sighting(5, 2, 0)));
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].landmarks->sightings.size(), 2u);
}

std::string wheels(double time, const Pose2D& pose, const std::string& label = "ODO",
                   std::optional<::mrpt::math::TTwist2D> velocity = {})
{
  CObservationOdometry o;
  o.timestamp = ::mrpt::Clock::fromDouble(time);
  o.sensorLabel = label;
  o.odometry = CPose2D(pose);
  o.hasEncodersInfo = true;
  o.hasVelocities = velocity.has_value();
  if (velocity) o.velocityLocal = *velocity;
  return serialized(o);
}

TEST(RawlogReading, OdometryPosesGiveIncrementsOfOneSensor)
{
  const auto steps = readBytes(wheels(1, {5, 5, math::kPi / 2}) + wheels(2, {9, 9, 0}, "OTHER") +
                                   wheels(3, {5, 6, math::kPi / 2}),
                               model());
  ASSERT_EQ(steps.size(), 1u);  // the first pose is where the robot starts from
  EXPECT_EQ(steps[0].time, 3);
  EXPECT_NEAR(steps[0].odometry->mean.x, 1, 1e-12);
  EXPECT_NEAR(steps[0].odometry->mean.y, 0, 1e-12);
  const double v = 0.2 * 2;  // the model's 0.2 m/s over 2 s
  EXPECT_NEAR(steps[0].odometry->cov(0, 0), v * v, 1e-9);
}

TEST(RawlogReading, VelocitiesAreIntegratedWhereNoPoseEverChanges)
{
  const ::mrpt::math::TTwist2D v(2, 0, 0.5);
  const auto steps = readBytes(wheels(1, {}, "ODO", v) + wheels(1.5, {}, "ODO", v), model());
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_NEAR(steps[0].odometry->mean.phi, 0.25, 1e-12);
  EXPECT_NEAR(steps[0].odometry->mean.x, std::cos(0.125), 1e-12);
  EXPECT_NEAR(steps[0].odometry->mean.y, std::sin(0.125), 1e-12);
}

TEST(RawlogReading, VelocitiesDoNotCountTwiceWherePosesChange)
{
  const ::mrpt::math::TTwist2D v(2, 0, 0);
  const auto steps = readBytes(
      wheels(1, {}, "ODO", v) + wheels(2, {}, "ODO", v) + wheels(3, {4, 0, 0}, "ODO", v), model());
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].odometry->mean.x, 0);
  EXPECT_EQ(steps[1].odometry->mean.x, 4);
}

TEST(RawlogReading, VelocitiesOfPairsToo)
{
  auto movement = odometry({});
  movement.hasVelocities = true;
  movement.velocityLocal = {1, 0, 0};
  std::string bytes;
  for (const double time : {1.0, 1.5, 2.5})
  {
    movement.timestamp = ::mrpt::Clock::fromDouble(time);
    bytes += pairOf(movement);
  }
  const auto steps = readBytes(bytes);
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_NEAR(steps[0].odometry->mean.x, 0.5, 1e-12);  // over the first period that is known
  EXPECT_NEAR(steps[1].odometry->mean.x, 0.5, 1e-12);
  EXPECT_NEAR(steps[2].odometry->mean.x, 1, 1e-12);
}

TEST(RawlogReading, FramesMayHoldTheOdometryPoses)
{
  const auto pose = [](double time, double x)
  {
    auto o = std::make_shared<CObservationOdometry>();
    o->timestamp = ::mrpt::Clock::fromDouble(time);
    o->odometry = CPose2D(x, 0, 0);
    CSensoryFrame frame;
    frame.insert(o);
    return serialized(CActionCollection()) + serialized(frame);
  };
  const auto steps = readBytes(pose(1, 0) + pose(2, 3), model());
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_FALSE(steps[0].odometry);
  EXPECT_EQ(steps[1].odometry->mean.x, 3);
  EXPECT_THROW(readBytes(pose(1, 0) + pose(2, 3)), core::Error);  // no covariance, no model
}

TEST(RawlogReading, LogWithoutTimesIsStillRead)
{
  auto movement = odometry({1, 0, 0});
  movement.timestamp = {};
  auto o = sighting(0, 2, 0);
  o->timestamp = {};
  const std::string pair = pairOf(movement, {o});
  const auto steps = readBytes(pair + pair + pair);
  ASSERT_EQ(steps.size(), 3u);
  for (std::size_t i = 1; i < 3; ++i)
    EXPECT_NEAR(steps[i].time - steps[i - 1].time, RawlogSource::kPeriodWithoutTimes, 1e-12);
}

// Pairs whose times stand still, jump ahead, and go back.
std::string pairsOfBadTimes(int count)
{
  std::string bytes;
  for (int i = 0; i < count; ++i)
    bytes += pairOf(odometry({1, 0, 0}), {sighting(i == 1 ? 1e6 : 5, 2, 0)});
  return bytes;
}

TEST(RawlogReading, StepPeriodReplacesTheLogsTimes)
{
  RawlogSource::Options options;
  options.stepPeriod = 0.1;
  const auto steps = readBytes(pairsOfBadTimes(249), options);
  ASSERT_EQ(steps.size(), 249u);
  EXPECT_EQ(steps[0].time, 0.1);
  EXPECT_EQ(steps[6].time, 0.7);  // not 0.7000000000000001
  EXPECT_EQ(steps[248].time, 24.9);
  EXPECT_THROW(readBytes(pairsOfBadTimes(3)), core::Error);
}

TEST(RawlogReading, StepPeriodIsTheTimeThatTheOdometryModelTakes)
{
  RawlogSource::Options options = model();
  options.stepPeriod = 0.5;
  const auto steps = readBytes(pairsOfBadTimes(2), options);
  ASSERT_EQ(steps.size(), 2u);
  for (const core::Step& step : steps)
    EXPECT_NEAR(std::sqrt(step.odometry->cov(0, 0)), 0.2 * 0.5, 0.002);
}

TEST(RawlogReading, ClockOfOurOwnStartsAtZero)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("x.rawlog");
  RawlogSource::Options options;
  options.stepPeriod = 0.1;
  for (const Pose2D& first : {Pose2D(), Pose2D(1, 0, 0)})
  {
    savePacked(path, pairOf(odometry(first), {sighting(7, 2, 0)}));
    RawlogSource source(path, options);
    EXPECT_EQ(source.starts().time, 0);
    EXPECT_EQ(source.next()->time, 0.1);
  }
}

TEST(RawlogReading, UntimedRestBeforeTimedStepsIsAtTheFirstTime)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("x.rawlog");
  auto rest = odometry({});
  rest.timestamp = {};
  savePacked(path, pairOf(rest) + pairOf(odometry({1, 0, 0}), {sighting(7, 2, 0)}));
  RawlogSource source(path, {});
  EXPECT_EQ(source.starts().time, 7);
  EXPECT_EQ(source.next()->time, 7);
}

TEST(RawlogReading, FirstFrameIsAStepAtTheStartWhereAskedFor)
{
  CSensoryFrame first;
  first.insert(sighting(7, 2.5F, 0));
  const std::string bytes = serialized(first) + pairOf(odometry({1, 0, 0}), {sighting(8, 2, 0)}) +
                            serialized(CActionCollection());
  EXPECT_EQ(readBytes(bytes).size(), 1u);
  for (const double period : {0.0, 0.1})
  {
    RawlogSource::Options options;
    options.useFirstFrame = true;
    options.stepPeriod = period;
    const auto steps = readBytes(bytes, options);
    ASSERT_EQ(steps.size(), 2u);  // the last action has no frame still
    EXPECT_FALSE(steps[0].odometry);
    ASSERT_TRUE(steps[0].landmarks);
    EXPECT_EQ(steps[0].landmarks->sightings.at(0).range, 2.5);
    EXPECT_EQ(steps[0].time, period > 0 ? 0 : 7);
    EXPECT_EQ(steps[1].time, period > 0 ? period : 8);
    EXPECT_EQ(steps[1].landmarks->sightings.at(0).range, 2);
  }
}

TEST(RawlogReading, LogSectionIsReadStrictly)
{
  const auto read = [](const std::string& text)
  {
    core::Config config = core::Config::parse(text, "x.ini");
    const auto options = RawlogSource::Options::from(config);
    config.requireAllRead();
    return options;
  };
  EXPECT_EQ(read("[log]\nstep_period_s = 0.1\n").stepPeriod, 0.1);
  EXPECT_EQ(read("").stepPeriod, 0);
  EXPECT_FALSE(read("").useFirstFrame);
  EXPECT_TRUE(read("[log]\nfirst_frame = use\n").useFirstFrame);
  for (const char* wrong :
       {"step_period_s = -1", "step_period_s = 1e-9", "first_frame = yes", "step_period = 0.1"})
    EXPECT_THROW(read(std::string("[log]\n") + wrong + "\n"), core::Error) << wrong;
}

TEST(RawlogReading, MissingTimesAreThoseOfTheStepBefore)
{
  auto movement = odometry({1, 0, 0});
  movement.timestamp = {};
  const std::string untimed = pairOf(movement);
  const auto steps = readBytes(untimed + pairOf(movement, {sighting(7, 2, 0)}) + untimed +
                               pairOf(movement, {sighting(8, 2, 0)}));
  ASSERT_EQ(steps.size(), 4u);
  const std::vector<double> expected = {7, 7, 7, 8};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(steps[i].time, expected[i]);
}

TEST(RawlogReading, StartTimeIsThatOfAFirstEntryAtRest)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("x.rawlog");
  savePacked(path, wheels(3, {}) + wheels(4, {1, 0, 0}));
  EXPECT_EQ(RawlogSource(path, model()).starts().time, 3);
  savePacked(path, pairOf(odometry({1, 0, 0})));
  EXPECT_FALSE(RawlogSource(path, {}).starts().time.has_value());
}

struct Demo
{
  const char* file;
  std::size_t steps, sightings, lasers;
};

TEST(RawlogReading, MrptsDemoLogsGiveTheStepsThatItsProgramsSee)
{
  const std::string folder = "/usr/share/mrpt/datasets/";
  const Demo demos[] = {{"kf-slam_demo.rawlog", 249, 3580, 0},
                        {"2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog", 224, 0, 224},
                        {"localization_demo.rawlog", 37, 0, 37},
                        {"uwb_ro-localization_demo.rawlog", 342, 0, 342}};
  if (!std::filesystem::exists(folder + demos[0].file))
    GTEST_SKIP() << "mrpt-common is not installed";
  for (const Demo& demo : demos)
  {
    RawlogSource source(folder + demo.file, {});
    std::size_t steps = 0, sightings = 0, lasers = 0;
    double last = -1;
    while (const auto step = source.next())
    {
      ++steps;
      EXPECT_GE(step->time, last);
      last = step->time;
      if (step->landmarks) sightings += step->landmarks->sightings.size();
      lasers += step->lasers.size();
    }
    EXPECT_EQ(steps, demo.steps) << demo.file;
    EXPECT_EQ(sightings, demo.sightings) << demo.file;
    EXPECT_EQ(lasers, demo.lasers) << demo.file;
    EXPECT_EQ(source.dropped(), 0u) << demo.file;
  }
}

TEST(RawlogReading, TheTimeOfWhoUsesTheStepsIsNotTheReaders)
{
  const auto secondsOfCpu = []
  {
    timespec t{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  std::vector<core::Step> steps(4000);  // more than is read ahead at once
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    steps[i] = exampleSteps()[1];
    steps[i].time = 0.1 * static_cast<double>(i + 1);
  }
  const TemporaryFolder folder;
  RawlogSource source(writeLog(folder, mrpt::RawlogWriter::Format::kActionFrames, steps, {}), {});
  ASSERT_TRUE(source.next());
  const double start = secondsOfCpu();
  while (secondsOfCpu() < start + 5.2)  // a slow filter: more than reading may take
  {
  }
  std::size_t n = 1;
  while (source.next()) ++n;
  EXPECT_EQ(n, steps.size());
}
}  // namespace
}  // namespace slamot::tests
