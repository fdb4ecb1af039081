#pragma once

#include <slamot/core/Start.h>
#include <slamot/core/Step.h>

#include <memory>
#include <string>
#include <vector>

namespace mrpt::obs
{
class CObservation;
}

namespace slamot::mrpt
{
/// Writes steps as a gz rawlog that MRPT's tools and RawlogSource read.
class RawlogWriter
{
 public:
  /// MRPT's two kinds of rawlog.
  enum class Format
  {
    kActionFrames,  ///< pairs of CActionCollection and CSensoryFrame: keeps odometry's covariance
    kObservations   ///< observations only: CObservationOdometry holds poses, no covariance
  };

  /// Writes to a temporary file beside `path`; \throws core::Error (kUnreadable) if that fails.
  RawlogWriter(const std::string& path, Format format, const core::Starts& starts);
  /// Without close(), nothing is left at `path`.
  ~RawlogWriter();

  /// \param more of the same instant, behind the step's own: what a step does not hold.
  void write(const core::Step& step,
             const std::vector<std::shared_ptr<::mrpt::obs::CObservation>>& more = {});
  /// Completes the file and puts it in its place.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
}  // namespace slamot::mrpt
