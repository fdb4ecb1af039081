// What bench/indoor-slam.sh needs of MRPT's binary files.
//   indoor-slam-files noise IN.rawlog OUT.rawlog A1 A2 A3 A4 STD_XY STD_PHI
// the log with these deviations of its odometry, in MRPT's Gaussian motion model (m/m, m/rad,
// rad/m, rad/rad, m, rad): rbpf-slam takes them from each action, and not the covariance there.
// Both programs end where a motion is missing or has no time, and rbpf-slam at what is no pair: a
// frame without a motion gets one of nothing, comments are left out.
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>

namespace
{
using mrpt::obs::CActionCollection;
using mrpt::obs::CActionRobotMovement2D;
using mrpt::obs::CSensoryFrame;
using Model = CActionRobotMovement2D::TMotionModelOptions;

std::shared_ptr<CActionCollection> withNoise(CActionCollection& actions, const CSensoryFrame& frame,
                                             const Model& model)
{
  CActionRobotMovement2D told;
  mrpt::poses::CPose2D increment;
  if (const auto motion = actions.getBestMovementEstimation())
  {
    increment = motion->poseChange->getMeanVal();
    told.timestamp = motion->timestamp;
  }
  if (told.timestamp == INVALID_TIMESTAMP && !frame.empty())
    told.timestamp = (*frame.begin())->timestamp;
  told.estimationMethod = CActionRobotMovement2D::emOdometry;
  told.rawOdometryIncrementReading = increment;
  told.motionModelConfiguration = model;
  told.computeFromOdometry(increment, model);
  auto out = std::make_shared<CActionCollection>();
  out->insert(told);
  return out;
}

bool writeNoise(const std::string& in, const std::string& out, const Model& model)
{
  mrpt::obs::CRawlog log, noisy;
  if (!log.loadFromRawLogFile(in)) return false;
  std::shared_ptr<CActionCollection> actions;
  for (const auto& entry : log)
    if (const auto given = std::dynamic_pointer_cast<CActionCollection>(entry))
      actions = given;
    else if (const auto frame = std::dynamic_pointer_cast<CSensoryFrame>(entry); frame && actions)
    {
      noisy.insert(withNoise(*actions, *frame, model));
      noisy.insert(frame);
      actions.reset();
    }
  return noisy.saveToRawLogFile(out);
}
}  // namespace

int main(int argc, char** argv)
{
  if (argc != 10 || std::string(argv[1]) != "noise")
  {
    std::fprintf(
        stderr, "usage: indoor-slam-files noise IN.rawlog OUT.rawlog A1 A2 A3 A4 STD_XY STD_PHI\n");
    return 1;
  }
  const auto number = [&](int i) { return std::strtod(argv[i], nullptr); };
  Model model;
  model.modelSelection = CActionRobotMovement2D::mmGaussian;
  model.gaussianModel = {number(4), number(5), number(6), number(7), number(8), number(9)};
  try
  {
    if (writeNoise(argv[2], argv[3], model)) return 0;
  }
  catch (const std::exception&)  // MRPT's: a page with a stack trace
  {
  }
  std::fprintf(stderr, "indoor-slam-files: error: %s can't be read, or %s not written\n", argv[2],
               argv[3]);
  return 2;
}
