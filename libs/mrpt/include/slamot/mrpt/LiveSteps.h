#pragma once

#include <mrpt/obs/CObservation.h>
#include <slamot/mrpt/RawlogSource.h>

#include <vector>

namespace mrpt::obs
{
class CActionCollection;
class CSensoryFrame;
}  // namespace mrpt::obs

namespace slamot::mrpt
{
/// What MRPT's programs hand on, pair by pair or observation by observation, as steps: those that
/// RawlogSource makes of the same in a log, but for what can be known of a whole log only: that the
/// robot never moves but by its velocities, or that only some objects have times.
class LiveSteps
{
 public:
  /// \param startTime when the robot was at its start, if that is known [s].
  explicit LiveSteps(const RawlogSource::Options& options, std::optional<double> startTime = {});
  ~LiveSteps();
  LiveSteps(const LiveSteps&) = delete;
  LiveSteps& operator=(const LiveSteps&) = delete;

  // All return what is complete now, in order of time.
  // \throws core::Error: kNonsense on values that make no sense, or time that goes backwards;
  // kConfig if nobody tells the odometry's covariance.  What is wrong is left out; steps that were
  // complete before it are not lost: complete(), or the next call, returns them.
  /// A pair: how the robot moved, and what it then saw.
  std::vector<core::Step> add(const ::mrpt::obs::CActionCollection& actions,
                              const ::mrpt::obs::CSensoryFrame& frame);
  /// Consecutive observations of one timestamp are a step: complete once one of another comes.
  std::vector<core::Step> add(const ::mrpt::obs::CObservation::Ptr& observation);
  /// What waited for more of its timestamp.
  std::vector<core::Step> flush();

  /// Steps that are complete but were not returned, since what came after them was refused.
  std::vector<core::Step> complete();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};
}  // namespace slamot::mrpt
