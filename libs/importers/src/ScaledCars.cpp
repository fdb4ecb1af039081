#include <slamot/core/Error.h>
#include <slamot/importers/ScaledCars.h>

#include <cstdio>

#include "ScaledCarsMotion.h"
#include "alignWithDriving.h"

namespace slamot::importers
{
namespace
{
using TrueHeading = ScaledCarsOptions::TrueHeading;

constexpr double kLongestPoseGap = 0.1;  // [s]
constexpr double kWorstFit = 0.03;       // [m/s], of sideways speed; sound headings leave 0.02

std::string fixed(const char* format, double value)
{
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

class ScaledCars : public Import
{
 public:
  ScaledCars(const std::string& folder, const ScaledCarsOptions& options)
      : folder_(folder),
        options_(options),
        motion_(folder, options_),
        scans_(folder, options_),
        ego_(scaled_cars::readPoses(folder, "ego")),
        targets_(scaled_cars::readTargets(folder))
  {
    mendHeadings(ego_, "ego");
    for (auto& [id, path] : targets_) mendHeadings(path, "target " + std::to_string(id));
    if (!motion_.biasKnown())
      warnings_.push_back(folder_ +
                          ": the car does not rest at the start for 0.5 s, and the gyro's "
                          "bias is taken to be 0; see --gyro-bias");
    begin();
  }

  std::optional<core::Step> next() override
  {
    while (scans_.time() && (*scans_.time() < time_ || *scans_.time() > motion_.end())) dropScan();
    if (!scans_.time()) return std::nullopt;
    core::Step step;
    step.time = *scans_.time();
    if (step.time > time_)
    {
      step.odometry = motion_.between(time_, step.time);
      time_ = step.time;
      noteTruth();
    }
    step.lasers.push_back(scans_.take());
    return deliver(std::move(step));
  }

  [[nodiscard]] double progress() const override { return scans_.progress(); }
  [[nodiscard]] const core::Starts& starts() const override { return starts_; }
  [[nodiscard]] const eval::Truth& truth() const override { return truth_; }

 private:
  /// The markers were put on by hand: their x axis is off the car's by degrees.
  void mendHeadings(eval::Trajectory& path, const std::string& car)
  {
    if (path.empty() || options_.trueHeading == TrueHeading::kLogged) return;
    const auto driving = drivingDirection(path);
    const bool known =
        options_.trueHeading == TrueHeading::kAligned && driving && driving->residual < kWorstFit;
    for (eval::TimedPose& pose : path.poses)
    {
      pose.headingKnown = known;
      if (known) pose.pose.phi = math::wrapToPi(pose.pose.phi + driving->turn);
    }
    if (known || options_.trueHeading == TrueHeading::kNone) return;
    warnings_.push_back(
        folder_ + ": the true heading of " + car + " is taken as unknown: " +
        (driving ? "it leaves " + fixed("%.2f", driving->residual) + " m/s of driving sideways"
                 : "the car hardly drives"));
  }

  void begin()
  {
    time_ = counts_.start = motion_.begin();
    starts_.time = time_;
    noteTruth();
    if (!options_.startFromTruth) return;
    const auto pose = ego_.at(time_, kLongestPoseGap);
    if (!pose || !pose->headingKnown)
      throw core::Error(core::ExitStatus::kUnreadable, folder_ + "/ego_pose.csv",
                        pose ? "the true heading at the first odometry is not known"
                             : "there is no truth at the first odometry",
                        "import with --start origin");
    starts_.robot = startAt(*pose);
    if (!options_.targetStarts) return;
    for (const auto& [id, path] : targets_)
      if (const auto at = path.at(time_, kLongestPoseGap)) starts_.targets[id] = startAt(*at);
  }

  [[nodiscard]] static core::ObjectStart startAt(const eval::TimedPose& at)
  {
    constexpr double kPlaceStd = 0.005, kHeadingStd = 0.01;  // [m, rad]
    core::ObjectStart start;
    start.value[start.kX] = at.pose.x, start.std[start.kX] = kPlaceStd;
    start.value[start.kY] = at.pose.y, start.std[start.kY] = kPlaceStd;
    if (!at.headingKnown) return start;
    start.value[start.kTheta] = at.pose.phi, start.std[start.kTheta] = kHeadingStd;
    return start;
  }

  void dropScan()
  {
    (void)scans_.take();
    ++counts_.outOfTime;
  }

  void noteTruth()
  {
    if (auto pose = ego_.at(time_, kLongestPoseGap))
      truth_.robot.poses.push_back({time_, pose->pose, pose->headingKnown});
    for (const auto& [id, path] : targets_)
      if (auto pose = path.at(time_, kLongestPoseGap))
        truth_.targets[id].poses.push_back({time_, pose->pose, pose->headingKnown});
  }

  std::string folder_;
  ScaledCarsOptions options_;
  scaled_cars::Motion motion_;
  scaled_cars::LaserScans scans_;
  eval::Trajectory ego_;
  std::map<int, eval::Trajectory> targets_;
  core::Starts starts_;
  eval::Truth truth_;
  double time_ = 0;
};
}  // namespace

std::unique_ptr<Import> openScaledCars(const std::string& folder, const ScaledCarsOptions& options)
{
  return std::make_unique<ScaledCars>(folder, options);
}
}  // namespace slamot::importers
