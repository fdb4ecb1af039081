#include <slamot/core/Error.h>
#include <slamot/importers/Mrclam.h>

#include <algorithm>

#include "MrclamData.h"
#include "MrclamWheels.h"

namespace slamot::importers
{
namespace
{
using mrclam::Measurement;

constexpr double kLongestTruthGap = 0.5;  // [s]

class Mrclam : public Import
{
 public:
  Mrclam(const std::string& folder, const MrclamOptions& options)
      : options_(options),
        subjects_(mrclam::readBarcodes(folder)),
        wheels_(mrclam::readOdometry(folder, options.robot), options.odometryDelay, options.wheels)
  {
    const auto measurements = mrclam::readMeasurements(folder, options.robot);
    fov_ = mrclam::hullOf(measurements);
    for (const Measurement& m : measurements) images_[m.time].push_back(m);
    truth_.landmarks = mrclam::readTrueLandmarks(folder);
    for (int robot = 1; robot <= mrclam::kRobots; ++robot)
      if (!isMate(robot)) paths_[robot] = mrclam::readTruePath(folder, robot);
    begin(folder);
  }

  std::optional<core::Step> next() override
  {
    while (!images_.empty() && images_.begin()->first < time_) dropImage();
    if (time_ >= wheels_.end())
    {
      while (!images_.empty()) dropImage();
      return std::nullopt;
    }
    core::Step step;
    step.time = nextTime();
    if (step.time > time_)
    {
      step.odometry = wheels_.between(time_, step.time);
      time_ = step.time;
      noteTruth();
    }
    if (!images_.empty() && images_.begin()->first == time_) addImage(step);
    return deliver(std::move(step));
  }

  [[nodiscard]] double progress() const override
  {
    const double span = wheels_.end() - wheels_.begin();
    return span > 0 ? (time_ - wheels_.begin()) / span : 1;
  }
  [[nodiscard]] const core::Starts& starts() const override { return starts_; }
  [[nodiscard]] const eval::Truth& truth() const override { return truth_; }

 private:
  void begin(const std::string& folder)
  {
    time_ = counts_.start = wheels_.begin();
    starts_.time = time_;
    noteTruth();
    if (!options_.startFromTruth) return;
    if (truth_.robot.empty())
      throw core::Error(core::ExitStatus::kUnreadable, folder,
                        "there is no truth for robot " + std::to_string(options_.robot) +
                            " at its first odometry",
                        "import with --start origin");
    // Truth's heading is off the direction of driving straight on, by up to 1 degree, constantly.
    constexpr double kPlaceStd = 0.01, kHeadingStd = 0.015;  // [m, rad]
    const Pose2D& pose = truth_.robot.poses.front().pose;
    core::ObjectStart& start = starts_.robot.emplace();
    start.value[start.kX] = pose.x, start.std[start.kX] = kPlaceStd;
    start.value[start.kY] = pose.y, start.std[start.kY] = kPlaceStd;
    start.value[start.kTheta] = pose.phi, start.std[start.kTheta] = kHeadingStd;
  }

  /// The next image, or an even part of the way there, at most maxStep on.
  [[nodiscard]] double nextTime() const
  {
    const double image = images_.empty() ? wheels_.end() : images_.begin()->first;
    const double end = std::min(image, wheels_.end());
    const double parts = std::ceil((end - time_) / options_.maxStep - 1e-6);
    if (parts <= 1) return end;
    // To the tenth of a millisecond, which text and MRPT's clock keep.
    const double part = std::round((time_ + (end - time_) / parts) * 1e4) / 1e4;
    return part > time_ && part < end ? part : end;
  }

  /// Of a team's robot: neither itself nor the target.
  [[nodiscard]] bool isMate(int robot) const
  {
    return options_.target && robot != options_.target && robot != options_.robot;
  }

  void addImage(core::Step& step)
  {
    if (!options_.hideLandmarks) step.landmarks.emplace().fov = fov_;
    step.blobs.emplace().fov = fov_;
    for (const Measurement& m : images_.begin()->second)
    {
      const auto subject = subjects_.find(m.barcode);
      if (subject == subjects_.end() || subject->second == options_.robot)
        ++counts_.unknown;
      else if (m.range <= 0)
        ++counts_.outOfView, ++step.dropped;
      else
        add(step, m, subject->second);
    }
    images_.erase(images_.begin());
  }

  void add(core::Step& step, const Measurement& m, int subject)
  {
    const double rangeStd = std::hypot(options_.rangeStd, options_.rangeScaleStd * m.range);
    if (subject <= mrclam::kRobots)
    {
      const bool target = subject == options_.target;
      step.blobs->blobs.push_back({target ? "target" : "robot", m.range, m.bearing, rangeStd,
                                   options_.bearingStd,
                                   target || options_.targetIds ? subject : core::kNoId});
      return;
    }
    if (!step.landmarks)
    {
      ++counts_.hidden;
      return;
    }
    auto& list = step.landmarks->sightings;
    if (truth_.landmarks.count(subject))
      truth_.associations.push_back({step.time, static_cast<int>(list.size()), subject});
    list.push_back({m.range, m.bearing, rangeStd, options_.bearingStd,
                    options_.landmarkIds ? subject : core::kNoId});
  }

  void dropImage()
  {
    counts_.outOfTime += images_.begin()->second.size();
    images_.erase(images_.begin());
  }

  void noteTruth()
  {
    for (const auto& [robot, path] : paths_)
      if (const auto pose = path.at(time_, kLongestTruthGap))
        (robot == options_.robot ? truth_.robot : truth_.targets[robot])
            .poses.push_back({time_, pose->pose, true});
  }

  MrclamOptions options_;
  std::map<int, int> subjects_;
  mrclam::Wheels wheels_;
  core::FieldOfView fov_;
  std::map<double, std::vector<Measurement>> images_;
  std::map<int, eval::Trajectory> paths_;
  core::Starts starts_;
  eval::Truth truth_;
  double time_ = 0;
};

void checkRobot(int robot, const std::string& option)
{
  if (robot < 1 || robot > mrclam::kRobots)
    throw core::Error(core::ExitStatus::kConfig, option, "MRCLAM has robots 1 to 5",
                      "give " + option + " with one of them");
}
}  // namespace

std::vector<int> mrclamTeam(int target)
{
  checkRobot(target, "--target");
  std::vector<int> out;
  for (int robot = 1; robot <= mrclam::kRobots; ++robot)
    if (robot != target) out.push_back(robot);
  return out;
}

std::unique_ptr<Import> openMrclam(const std::string& folder, const MrclamOptions& options)
{
  checkRobot(options.robot, "--robot");
  if (options.target) checkRobot(*options.target, "--target");
  if (options.target == options.robot)
    throw core::Error(core::ExitStatus::kConfig, "--target", "is the robot itself",
                      "give another one");
  if (std::hypot(options.rangeStd, options.rangeScaleStd) <= 0 || options.bearingStd <= 0)
    throw core::Error(core::ExitStatus::kConfig, "--std-range, --std-bearing", "no sensor is exact",
                      "give a deviation above zero");
  return std::make_unique<Mrclam>(folder, options);
}
}  // namespace slamot::importers
