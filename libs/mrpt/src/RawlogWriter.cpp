#include <slamot/mrpt/timestamp.h>
#include "GzWriter.h"
#include "toObservations.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>
#include <slamot/core/Error.h>
#include <slamot/mrpt/RawlogWriter.h>

#include <cstdio>
#include <limits>

namespace slamot::mrpt
{
struct RawlogWriter::Impl
{
  Impl(const std::string& p, Format f, const core::Starts& starts)
      : path(p), format(f), file(p), lastTime(starts.time)
  {
    writeComment(starts.toIni());
  }

  void write(const ::mrpt::serialization::CSerializable& object)
  {
    ::mrpt::io::CMemoryStream memory;
    auto archive = ::mrpt::serialization::archiveFrom(memory);
    archive << object;
    file.write(memory.getRawBufferData(), memory.getTotalBytesCount());
  }
  void writeComment(const std::string& text);
  using Observations = std::vector<std::shared_ptr<::mrpt::obs::CObservation>>;
  void writePair(const core::Step& step, const Observations& more);
  void writeObservations(const core::Step& step, const Observations& more);
  void writeOdometry(double time, std::optional<::mrpt::math::TTwist2D> velocity);
  void check(const core::Step& step) const;

  std::string path;
  Format format;
  GzWriter file;
  std::optional<double> lastTime;  // of the start or the last step
  Pose2D odometryPose;             // observations only: where wheels alone would be
  bool odometryBegun = false;
};

void RawlogWriter::Impl::writeComment(const std::string& text)
{
  if (text.empty()) return;
  ::mrpt::obs::CObservationComment comment;
  comment.timestamp = toTimestamp(lastTime.value_or(0));
  comment.text = text;
  write(comment);
}

void RawlogWriter::Impl::writePair(const core::Step& step, const Observations& more)
{
  ::mrpt::obs::CActionCollection actions;
  const auto dt = lastTime ? std::optional<double>(step.time - *lastTime) : std::nullopt;
  if (step.odometry)
  {
    auto action = toAction(*step.odometry, step.time, dt);
    actions.insert(action);
  }
  ::mrpt::obs::CSensoryFrame frame;
  for (const auto& observation : toObservations(step)) frame.insert(observation);
  for (const auto& observation : more) frame.insert(observation);
  if (!step.odometry && frame.empty())
  {
    // Nothing else would keep the step's time.
    auto comment = std::make_shared<::mrpt::obs::CObservationComment>();
    comment->timestamp = toTimestamp(step.time);
    frame.insert(comment);
  }
  write(actions);
  write(frame);
}

void RawlogWriter::Impl::writeOdometry(double time, std::optional<::mrpt::math::TTwist2D> velocity)
{
  ::mrpt::obs::CObservationOdometry odometry;
  odometry.timestamp = toTimestamp(time);
  odometry.sensorLabel = "ODOMETRY";
  odometry.odometry = ::mrpt::poses::CPose2D(odometryPose);
  odometry.hasVelocities = velocity.has_value();
  if (velocity) odometry.velocityLocal = *velocity;
  write(odometry);
}

void RawlogWriter::Impl::writeObservations(const core::Step& step, const Observations& more)
{
  if (step.odometry)
  {
    // Increments are differences of poses, so the pose before the first one has to be there too.
    if (!odometryBegun) writeOdometry(lastTime.value_or(step.time), std::nullopt);
    odometryBegun = true;
    odometryPose = math::compose(odometryPose, step.odometry->mean);
    const double dt = lastTime ? step.time - *lastTime : 0;
    writeOdometry(step.time,
                  dt > 0 ? std::optional(meanVelocity(step.odometry->mean, dt)) : std::nullopt);
  }
  for (const auto& observation : toObservations(step)) write(*observation);
  for (const auto& observation : more) write(*observation);
}

void RawlogWriter::Impl::check(const core::Step& step) const
{
  const double first = lastTime.value_or(-std::numeric_limits<double>::infinity());
  if (std::isfinite(step.time) && step.time >= first && std::abs(step.time) < 1e11) return;
  char what[96];
  std::snprintf(what, sizeof what, "a step at %.6f s can't follow %.6f s", step.time, first);
  throw core::Error(core::ExitStatus::kNonsense, path, what, "write steps in the order of time");
}

RawlogWriter::RawlogWriter(const std::string& path, Format format, const core::Starts& starts)
    : impl_(std::make_unique<Impl>(path, format, starts))
{
}

RawlogWriter::~RawlogWriter() = default;

void RawlogWriter::write(const core::Step& step,
                         const std::vector<std::shared_ptr<::mrpt::obs::CObservation>>& more)
{
  impl_->check(step);
  if (impl_->format == Format::kActionFrames)
    impl_->writePair(step, more);
  else
    impl_->writeObservations(step, more);
  impl_->lastTime = step.time;
}

void RawlogWriter::close()
{
  impl_->file.close();
}
}  // namespace slamot::mrpt
