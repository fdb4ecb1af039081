#include <slamot/core/Error.h>
#include <slamot/core/checkStep.h>

#include <cmath>
#include <cstdio>

namespace slamot::core
{
namespace
{
[[noreturn]] void fail(double time, const std::string& what, const std::string& mend)
{
  char where[64];
  std::snprintf(where, sizeof where, "step at %.6f s", time);
  throw Error(ExitStatus::kNonsense, where, what, mend);
}

void checkOdometry(const Step& step)
{
  const Pose2D& m = step.odometry->mean;
  const Matrix3& cov = step.odometry->cov;
  if (!std::isfinite(m.x + m.y + m.phi) || !cov.allFinite())
    fail(step.time, "odometry is not finite", "mend the log");
  if (math::asymmetry(cov) > 1e-9 * (1 + cov.cwiseAbs().maxCoeff()) ||
      math::smallestEigenvalue(cov) < -1e-9 * (cov.trace() + 1e-300))
    fail(step.time, "odometry's covariance is not symmetric and positive", "mend the log");
}

// Positive and finite: a NaN fails every comparison.
bool good(double std)
{
  return std > 0 && std < 1e9;
}
}  // namespace

void checkStep(const Step& step, double lastTime)
{
  if (!std::isfinite(step.time)) fail(step.time, "the time is not finite", "mend the log");
  if (step.time < lastTime)
    fail(step.time, "the time is before the last step's, " + std::to_string(lastTime) + " s",
         "sort the log by time");
  if (step.odometry) checkOdometry(step);
  if (step.landmarks)
    for (const Sighting& s : step.landmarks->sightings)
      if (!std::isfinite(s.range + s.bearing) || s.range <= 0 || !good(s.rangeStd) ||
          !good(s.bearingStd))
        fail(step.time, "a landmark sighting has a value that makes no sense", "mend the log");
  if (step.blobs)
    for (const Blob& b : step.blobs->blobs)
      if (!std::isfinite(b.bearing) || !good(b.bearingStd) ||
          (b.range && (!std::isfinite(*b.range) || *b.range <= 0 || !good(b.rangeStd))))
        fail(step.time, "a blob has a value that makes no sense", "mend the log");
}
}  // namespace slamot::core
