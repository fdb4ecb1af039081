#pragma once

#include "EntryReader.h"

#include <mrpt/core/Clock.h>
#include <mrpt/math/TTwist2D.h>
#include <slamot/mrpt/RawlogSource.h>

#include <functional>
#include <memory>

namespace mrpt::obs
{
class CActionCollection;
class CObservation;
class CObservationOdometry;
}  // namespace mrpt::obs

namespace slamot::mrpt
{
/// What is known of a rawlog only after a pass over all of it.
struct LogFacts
{
  std::string comment;                 ///< its comment text
  std::size_t entries = 0, steps = 0;  ///< entries without comments
  bool packed = false;                 ///< gz
  std::size_t dropped = 0;             ///< sightings and blobs
  bool hasFrames = false;              ///< of actions and frames; else observations only
  bool beginsWithFrame = false;
  std::optional<double> firstTime, lastTime;  ///< the first and last that are valid [s]
  bool beginsAtRest = false;                  ///< the first entry holds no motion
  std::optional<double> restTime;             ///< its time, if valid [s]
  double firstPeriod = 0;                     ///< between the first two times that differ [s]
  bool moves = false;                         ///< some increment is not zero
  bool hasVelocities = false;                 ///< nor some velocity
  bool odometryFromPoses = false;             ///< increments are differences: no covariance
};

/// Puts entries together to steps: one pass over a rawlog.
class StepAssembler
{
 public:
  /// \param before the facts of an earlier pass; null in the first, whose steps lack what needs
  /// them.
  /// \param onEntry is shown every entry.
  StepAssembler(const std::string& path, const RawlogSource::Options& options,
                const LogFacts* before, std::function<void(const Entry&)> onEntry = {});

  using ReadEntry = std::function<std::optional<Entry>()>;
  /// Of entries that come one by one.  When there is none for now, next() takes it for the end, and
  /// goes on when it is called again.
  StepAssembler(ReadEntry read, const RawlogSource::Options& options, const LogFacts* before);

  /// \throws core::Error on a damaged file, on values that make no sense, and on time going
  /// backwards.
  std::optional<core::Step> next();

  [[nodiscard]] const LogFacts& facts() const { return facts_; }
  [[nodiscard]] double progress() const { return reader_->progress(); }

 private:
  using Observation = ::mrpt::obs::CObservation;

  const Entry* peek();
  void take();
  void check(const core::Step& step) const;
  std::optional<core::Step> assemble();
  std::optional<core::Step> assemblePair();
  std::optional<core::Step> assembleGroup();
  void addFrame(core::Step& step, std::optional<double>& time);
  bool add(core::Step& step, const Observation& observation);
  bool addOdometry(core::Step& step, const ::mrpt::obs::CObservationOdometry& odometry);
  void setVelocity(const ::mrpt::math::TTwist2D& v);
  [[nodiscard]] bool isAtRest(const core::Step& step) const;
  void setTime(core::Step& step, std::optional<double> time, bool fromAction);
  [[nodiscard]] double countedTime(const core::Step& step) const;
  [[nodiscard]] std::optional<double> timeOf(const ::mrpt::Clock::time_point& stamp) const;
  void noteTime(double time);
  void noteRest(std::optional<double> time);
  void applyModel(core::Step& step);

  std::unique_ptr<EntryReader> reader_;  // null: entries come one by one
  ReadEntry read_;
  RawlogSource::Options options_;
  const LogFacts* before_;
  std::function<void(const Entry&)> onEntry_;
  LogFacts facts_;
  std::optional<Entry> entry_;  // looked at, not yet taken
  bool ended_ = false;
  Entry current_;  // where messages point to

  std::optional<double> lastTime_;       // of a step [s]
  double latest_[2] = {-1e300, -1e300};  // of observations, and of actions [s]
  std::optional<double> lastMotionTime_;
  std::optional<std::string> odometryLabel_;
  std::optional<Pose2D> odometryPose_;
  std::optional<::mrpt::math::TTwist2D> velocity_;  // of the step in hand
};
}  // namespace slamot::mrpt
