#include "expectError.h"

#include <slamot/core/checkStep.h>

#include <functional>
#include <limits>

namespace slamot::core
{
namespace
{
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// Everything in it is right.
Step goodStep()
{
  Step s;
  s.time = 2;
  s.odometry = math::turnThenMove(1, 0.5, 0.1, 0.1, 0.1);
  s.landmarks.emplace().sightings = {{2.0, 0.5, 0.1, 0.02, 3}, {1.0, -3.0, 0.1, 0.02, kNoId}};
  s.blobs.emplace().blobs = {{"target", 2.0, 0.1, 0.1, 0.02, 1},
                             {"target", std::nullopt, 0.1, 0, 0.02, kNoId}};
  return s;
}

void expectRefused(const char* what, const std::function<void(Step&)>& spoil)
{
  SCOPED_TRACE(what);
  Step s = goodStep();
  spoil(s);
  test::expectError([&] { checkStep(s, 1.0); }, ExitStatus::kNonsense, {"step at "});
}

Sighting& sighting(Step& s)
{
  return s.landmarks->sightings[1];
}
Blob& blob(Step& s)
{
  return s.blobs->blobs[0];
}
Blob& bearingOnly(Step& s)
{
  return s.blobs->blobs[1];
}
}  // namespace

TEST(CheckStep, PassesWhatIsRight)
{
  checkStep(goodStep(), 1.0);
  checkStep(goodStep(), 2.0);  // the same time again
  checkStep(goodStep(), -kInf);
  checkStep(Step{}, 0.0);
  Step empty;
  empty.landmarks.emplace();
  empty.blobs.emplace();
  checkStep(empty, 0.0);
}

TEST(CheckStep, RefusesTimes)
{
  expectRefused("before the last", [](Step& s) { s.time = std::nextafter(1.0, 0.0); });
  expectRefused("NaN", [](Step& s) { s.time = kNaN; });
  expectRefused("infinite", [](Step& s) { s.time = kInf; });
}

TEST(CheckStep, RefusesOdometry)
{
  for (const double bad : {kNaN, kInf, -kInf})
  {
    for (int i = 0; i < 3; ++i) expectRefused("mean", [&](Step& s) { s.odometry->mean[i] = bad; });
    for (int i = 0; i < 9; ++i)
      expectRefused("covariance", [&](Step& s) { s.odometry->cov(i / 3, i % 3) = bad; });
  }
  expectRefused("negative", [](Step& s) { s.odometry->cov = Vector3(1, 1, -1e-3).asDiagonal(); });
  expectRefused("asymmetric", [](Step& s) { s.odometry->cov(0, 1) += 1e-3; });
  expectRefused("indefinite",
                [](Step& s)
                {
                  s.odometry->cov.setIdentity();
                  s.odometry->cov(0, 2) = s.odometry->cov(2, 0) = 1.1;
                });
}

TEST(CheckStep, RefusesSightings)
{
  for (const double bad : {kNaN, kInf, -kInf})
  {
    expectRefused("range", [&](Step& s) { sighting(s).range = bad; });
    expectRefused("bearing", [&](Step& s) { sighting(s).bearing = bad; });
  }
  expectRefused("zero range", [](Step& s) { sighting(s).range = 0; });
  expectRefused("negative range", [](Step& s) { sighting(s).range = -1; });
  for (const double bad : {kNaN, kInf, 0.0, -0.1})
  {
    expectRefused("range's deviation", [&](Step& s) { sighting(s).rangeStd = bad; });
    expectRefused("bearing's deviation", [&](Step& s) { sighting(s).bearingStd = bad; });
  }
}

TEST(CheckStep, RefusesBlobs)
{
  for (const double bad : {kNaN, kInf, -kInf})
  {
    expectRefused("range", [&](Step& s) { blob(s).range = bad; });
    expectRefused("bearing", [&](Step& s) { blob(s).bearing = bad; });
    expectRefused("bearing only", [&](Step& s) { bearingOnly(s).bearing = bad; });
  }
  expectRefused("zero range", [](Step& s) { blob(s).range = 0; });
  for (const double bad : {kNaN, kInf, 0.0, -0.1})
  {
    expectRefused("range's deviation", [&](Step& s) { blob(s).rangeStd = bad; });
    expectRefused("bearing's deviation", [&](Step& s) { blob(s).bearingStd = bad; });
    expectRefused("bearing only", [&](Step& s) { bearingOnly(s).bearingStd = bad; });
  }
}

TEST(CheckStep, DoesNotAskForARangesDeviationWithoutARange)
{
  Step s = goodStep();
  bearingOnly(s).rangeStd = kNaN;
  checkStep(s, 1.0);
}
}  // namespace slamot::core
