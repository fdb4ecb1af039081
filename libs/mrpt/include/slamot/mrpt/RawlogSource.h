#pragma once

#include <slamot/core/Odometry.h>
#include <slamot/core/run.h>

#include <memory>
#include <string>

namespace slamot::mrpt
{
/// Streams the steps of a rawlog in either MRPT format, gz or plain, of bounded memory and time.
///
/// Pairs: an action and the frame after it are a step; an action with another after it is a step
/// without sightings.  Of a log that begins with a frame, as MRPT's simulator writes, the first
/// frame and the last action belong to no pair and are left out, as by MRPT's own programs; with
/// Options::useFirstFrame that frame is a step without odometry, at the start.
/// Observations only: consecutive ones of one timestamp are a step; increments are differences of
/// CObservationOdometry's poses, of the first odometry sensor in the log.  Frames without a
/// movement beside them may hold such poses too.  Where by its increments the robot never moves,
/// but velocities are given, those are integrated instead.
///
/// A step's time is that of the first observation that has one, else the action's, else that of the
/// step before.  In a log without any, or with Options::stepPeriod, the start is at zero and steps
/// are that apart.
class RawlogSource : public core::Source
{
 public:
  static constexpr double kPeriodWithoutTimes = 0.1;  ///< [s]

  /// Standard deviations of landmark sightings whose log gives none; zero: refuse such a log.
  struct SensorDeviations
  {
    double range = 0;    ///< [m]
    double bearing = 0;  ///< [rad]
    /// Keys range_std_m and bearing_std_deg of section [sensor], both or neither.
    static SensorDeviations from(core::Params& p);
  };

  /// How a log is to be read.
  struct Options
  {
    core::OdometryModel odometry;  ///< how uncertain its odometry is
    bool salvage = false;        ///< deliver the intact first part of a truncated log, then say so
    SensorDeviations sensor;     ///< of landmark sightings without deviations
    double stepPeriod = 0;       ///< in place of the log's times; 0: those [s]
    bool useFirstFrame = false;  ///< of a log that begins with a frame
    /// Sections [odometer], [sensor] and [log].
    static Options from(core::Config& config);
  };

  /// Scans the whole file first.
  /// \throws core::Error: kUnreadable, kTruncated (unless salvage), kNonsense, kLimit; names the
  /// file, the entry and the byte offset.  kConfig: the log gives no covariance of its odometry, as
  /// with observations only, and options.odometry has no model.
  RawlogSource(const std::string& path, const Options& options);
  ~RawlogSource() override;

  std::optional<core::Step> next() override;
  [[nodiscard]] double progress() const override;

  /// The [start] section of the log's comment text; without a time there, that of the first entry
  /// if it holds no motion.
  [[nodiscard]] const core::Starts& starts() const;
  /// Empty, or why the log ended early (salvage only): to be reported after the run.
  [[nodiscard]] const std::string& truncation() const;
  /// Sightings and blobs dropped so far: range at or below zero, or out of the field of view.
  [[nodiscard]] std::size_t dropped() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
}  // namespace slamot::mrpt
