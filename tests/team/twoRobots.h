#pragma once

#include <slamot/eval/Alignment.h>
#include <slamot/eval/Recorder.h>
#include <slamot/filters/registerAll.h>
#include <slamot/team/teamReport.h>

#include <cmath>
#include <memory>

namespace slamot::team
{
/// A log in memory: a robot that drives along x at 1 m/s, `y` to the left of target 0, which keeps
/// pace 10 m ahead.  Without noise, and without landmarks.
class AlongTheTarget : public core::Source
{
 public:
  AlongTheTarget(double y, int steps) : y_(y), steps_(steps) {}

  std::optional<core::Step> next() override
  {
    if (done_ == steps_) return std::nullopt;
    core::Step step;
    step.time = 0.2 * ++done_;
    step.odometry = math::turnThenMove(1.0, 0.0, 0.2, 0.1, 0.02);
    core::Blob blob;
    blob.label = "target";
    blob.id = 0;
    blob.range = std::hypot(10, y_), blob.bearing = std::atan2(-y_, 10);
    blob.rangeStd = 0.2, blob.bearingStd = 0.01;
    step.blobs.emplace();
    step.blobs->fov.rangeMax = 50;
    step.blobs->blobs = {blob};
    return step;
  }
  [[nodiscard]] double progress() const override { return static_cast<double>(done_) / steps_; }

  [[nodiscard]] core::Starts starts() const
  {
    core::Starts out;
    out.time = 0;
    out.robot.emplace();
    out.robot->value[core::ObjectStart::kX] = 0.0;
    out.robot->value[core::ObjectStart::kY] = y_;
    out.robot->std[core::ObjectStart::kX] = 0.3;
    out.robot->std[core::ObjectStart::kY] = 0.3;
    return out;
  }

  /// Where it and the target truly are.
  [[nodiscard]] eval::Truth truth() const
  {
    eval::Truth out;
    for (int i = 0; i <= steps_; ++i)
    {
      out.robot.poses.push_back({0.2 * i, {0.2 * i, y_, 0}});
      out.targets[0].poses.push_back({0.2 * i, {10 + 0.2 * i, 0, 0}});
    }
    return out;
  }

 private:
  double y_;
  int steps_, done_ = 0;
};

/// Robots 0 and 1 on either side of the target, run to their end.
class TwoRobots
{
 public:
  /// \param keys of [team], a line each
  explicit TwoRobots(const std::string& keys, bool withTruth = true)
      : config_(configOf(keys)),
        team_(config_, {{0, &left_, left_.starts()}, {1, &right_, right_.starts()}}, 1, 1)
  {
    eval::Recorder left(team_.filter(0)), right(team_.filter(1));
    (void)team_.run({{&left}, {&right}});
    records_ = {left.takeRecord(), right.takeRecord()};
    if (withTruth) truths_ = {left_.truth(), right_.truth()};
    evaluations_ =
        eval::evaluateTogether({{&records_[0], &truths_[0]}, {&records_[1], &truths_[1]}}, {});
    for (std::size_t r = 0; r < 2; ++r)
      results_.push_back({r == 0 ? "left" : "right", {records_[r], truths_[r], evaluations_[r]}});
  }

  [[nodiscard]] const Team& team() const { return team_; }
  [[nodiscard]] const std::vector<RobotResult>& results() const { return results_; }
  [[nodiscard]] TeamView view() const { return viewOf(team_, results_); }

 private:
  static core::Config configOf(const std::string& keys)
  {
    filters::registerAll();
    return core::Config::parse("[team]\n" + keys + "[ekf-slamot]\n" + kFilter, "test");
  }

  static constexpr const char* kFilter =
      "association = known\ntarget_motion = constant-velocity\ntarget_velocity_std_mps = 2\n"
      "target_acceleration_noise_mps2_per_sqrt_hz = 0.1\n";
  static constexpr int kSteps = 60;

  AlongTheTarget left_{5, kSteps}, right_{-5, kSteps};
  core::Config config_;
  Team team_;
  std::vector<eval::Record> records_;
  std::vector<eval::Truth> truths_ = std::vector<eval::Truth>(2);
  std::vector<eval::Evaluation> evaluations_;
  std::vector<RobotResult> results_;
};
}  // namespace slamot::team
