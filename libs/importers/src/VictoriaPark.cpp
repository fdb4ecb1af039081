#include <slamot/core/Error.h>
#include <slamot/importers/VictoriaPark.h>

#include <algorithm>

#include "VictoriaParkData.h"

namespace slamot::importers
{
namespace
{
constexpr double kLongestStep = 1;  // [s]
constexpr double kSameScan = 1e-4;  // [s]; times have three digits, scans come every 0.214 s

/// Half a beam beyond the outermost trees: the car itself is in the way of the beams farther to the
/// right, and the detector leaves out those farther to the left.
core::FieldOfView fieldOfView(const VictoriaParkOptions& options)
{
  constexpr double kNearest = 1;  // [m]; nothing nearer was ever seen but the car itself
  return {kNearest, options.maxRange, math::degToRad(-83.75) + options.laserYaw,
          math::degToRad(87.25) + options.laserYaw};
}

class VictoriaPark : public Import
{
 public:
  VictoriaPark(const std::string& folder, const VictoriaParkOptions& options)
      : options_(options),
        fov_(fieldOfView(options_)),
        inputs_(folder, options_),
        trees_(folder, options_),
        lasers_(folder, options_)
  {
    truth_.robot = victoria_park::readFixes(folder);
    starts_.time = counts_.start = time_ = inputs_.begin();
    if (!lasers_.exist())
      warnings_.push_back(folder + ": without laser_cm.txt, scans that saw no tree are left out");
  }

  std::optional<core::Step> next() override
  {
    while (const auto scan = scanTime())
    {
      if (*scan >= time_) break;
      dropScan();
    }
    const auto scan = scanTime();
    core::Step step;
    if (scan != time_)
    {
      const auto motion = inputs_.until(std::min(scan.value_or(1e300), time_ + kLongestStep));
      if (motion.end == time_) return end();
      step.odometry = motion.mount;
      time_ = motion.end;
    }
    step.time = time_;
    if (scan == time_) addScan(step);
    return deliver(std::move(step));
  }

  [[nodiscard]] double progress() const override { return inputs_.progress(); }
  [[nodiscard]] const core::Starts& starts() const override { return starts_; }
  [[nodiscard]] const eval::Truth& truth() const override { return truth_; }

 private:
  [[nodiscard]] std::optional<double> scanTime() const
  {
    const auto trees = trees_.time(), laser = lasers_.time();
    if (!trees || !laser) return trees ? trees : laser;
    return std::min(*trees, *laser);
  }

  [[nodiscard]] static bool isOf(const std::optional<double>& time, double scan)
  {
    return time && *time <= scan + kSameScan;
  }

  void addScan(core::Step& step)
  {
    const double scan = *scanTime();
    step.landmarks.emplace().fov = fov_;
    if (isOf(lasers_.time(), scan))
    {
      auto laser = lasers_.take();
      if (options_.lasers) step.lasers.push_back(std::move(laser));
    }
    if (!isOf(trees_.time(), scan)) return;
    for (const auto& tree : trees_.take()) addTree(step, tree);
  }

  void addTree(core::Step& step, const victoria_park::Trees::Tree& tree)
  {
    const double bearing = math::wrapToPi(tree.bearing + options_.laserYaw);
    if (!fov_.contains(tree.range, bearing))
    {
      ++counts_.outOfView, ++step.dropped;
      return;
    }
    step.landmarks->sightings.push_back(
        {tree.range, bearing, std::hypot(options_.trunkStd, options_.rangeScaleStd * tree.range),
         std::hypot(options_.bearingStd, options_.trunkStd / tree.range), core::kNoId});
  }

  void dropScan()
  {
    const double scan = *scanTime();
    if (isOf(lasers_.time(), scan)) (void)lasers_.take();
    if (isOf(trees_.time(), scan)) counts_.outOfTime += trees_.take().size();
  }

  /// What is seen after the last row of odometry is left out, but read: it must be sound.
  std::optional<core::Step> end()
  {
    while (scanTime()) dropScan();
    return std::nullopt;
  }

  VictoriaParkOptions options_;
  core::FieldOfView fov_;
  victoria_park::Inputs inputs_;
  victoria_park::Trees trees_;
  victoria_park::Lasers lasers_;
  core::Starts starts_;
  eval::Truth truth_;
  double time_ = 0;
};
}  // namespace

std::unique_ptr<Import> openVictoriaPark(const std::string& folder,
                                         const VictoriaParkOptions& options)
{
  if (std::hypot(options.trunkStd, options.rangeScaleStd) <= 0 ||
      std::hypot(options.trunkStd, options.bearingStd) <= 0)
    throw core::Error(core::ExitStatus::kConfig, "--std-trunk, --std-range-scale, --std-bearing",
                      "no sensor is exact", "give a deviation above zero");
  if (!(options.maxRange >= 2 && options.maxRange <= 80))
    throw core::Error(core::ExitStatus::kConfig, "--max-range", "the laser reaches from 1 to 80 m",
                      "give 2 to 80");
  return std::make_unique<VictoriaPark>(folder, options);
}
}  // namespace slamot::importers
