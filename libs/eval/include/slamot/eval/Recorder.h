#pragma once

#include <slamot/core/run.h>
#include <slamot/eval/Record.h>

#include <limits>
#include <map>

namespace slamot::eval
{
/// Makes the record of a run, in memory.
class Recorder : public core::Sink
{
 public:
  /// What to keep besides poses, targets and pairings.
  struct Options
  {
    bool keepLasers = false;  ///< keep scans, one for each 0.1 m or 5 degrees of motion
  };

  /// \param filter the one being run: its map and path are asked for once, at the end.
  explicit Recorder(const core::Filter& filter, const Options& options);
  /// Without scans.
  explicit Recorder(const core::Filter& filter) : Recorder(filter, Options{}) {}

  void begin(const core::Estimate& start) override;
  void accept(const core::Step& step, const core::Update& update) override;
  void finish(bool complete) override;

  /// Whole once the run has finished.
  [[nodiscard]] const Record& record() const { return record_; }
  /// The scans without what moved: see withoutTargets().
  [[nodiscard]] Record takeRecord();

 private:
  void addRow(double time, const core::Estimate& estimate);
  void replaceRow(const core::Estimate& estimate);
  void addTargets(const core::Estimate& estimate);
  void addPairings(const core::Step& step, const core::Update& update);
  void addLasers(const core::Step& step);

  const core::Filter* filter_;
  Options options_;
  Record record_;
  Pose2D odometry_;
  double start_ = -std::numeric_limits<double>::infinity();  // time of its row, if it has one [s]
  bool scanPending_ = false;
  std::map<std::pair<bool, int>, TargetTrack> tracks_;  // by (not identified, id)
};
}  // namespace slamot::eval
