#include <slamot/core/Error.h>

#include <algorithm>
#include <limits>

#include "starts.h"

namespace slamot::sim
{
namespace
{
constexpr int kTries = 10'000;
constexpr double kRounding = 1e-9;  // of a distance that was set [m]

/// Places one landmark after another.
class Placing
{
 public:
  explicit Placing(const Scenario& scenario) : scenario_(scenario), setup_(scenario.landmarks)
  {
    for (const Point2D& p : setup_.positions) out_.emplace(static_cast<int>(out_.size()), p);
  }

  void add(int id, math::RandomStream random)
  {
    const int first = id - id % setup_.clusterSize;
    for (int i = 0; i < kTries; ++i)
    {
      const Point2D p = id == first ? anywhere(random) : beside(first, id, random);
      if (!isFree(p, first)) continue;
      out_.emplace(id, p);
      return;
    }
    const bool crowded = setup_.spacing > 0 || setup_.clusterSize > 1;
    throw core::Error(
        core::ExitStatus::kConfig,
        scenario_.name + " [world] " + (crowded ? "landmark_spacing_min_m" : "landmark_path_max_m"),
        "leaves no place for landmark " + std::to_string(id),
        crowded ? "lower it, or landmarks" : "raise it");
  }

  [[nodiscard]] std::map<int, Point2D> take() { return std::move(out_); }

 private:
  [[nodiscard]] Point2D anywhere(math::RandomStream& random) const
  {
    const double x = random.uniform(0, scenario_.area.width);
    return {x, random.uniform(0, scenario_.area.height)};
  }

  /// A step from a member of the cluster that began with `first`.
  [[nodiscard]] Point2D beside(int first, int id, math::RandomStream& random) const
  {
    const Point2D& from = out_.at(first + static_cast<int>(random.uniform(0, id - first)));
    const double a = random.uniform(-math::kPi, math::kPi);
    return {from.x + setup_.clusterSpacing * std::cos(a),
            from.y + setup_.clusterSpacing * std::sin(a)};
  }

  [[nodiscard]] bool isFree(const Point2D& p, int first) const
  {
    const auto isTooNear = [&](const auto& other)
    {
      const double apart = other.first >= first ? setup_.clusterSpacing : setup_.spacing;
      return (other.second - p).norm() < apart - kRounding;
    };
    // Only its own cluster, if clusters may overlap: 100 000 landmarks must not take for ever.
    const auto from = setup_.spacing > 0 ? out_.begin() : out_.lower_bound(first);
    return scenario_.area.contains(p) && isInBand(p) && std::none_of(from, out_.end(), isTooNear);
  }

  /// Whether the nearest of the robots' paths is as near as is asked for.
  [[nodiscard]] bool isInBand(const Point2D& p) const
  {
    if (!setup_.alongPath) return true;
    double distance = std::numeric_limits<double>::infinity();
    for (const RobotSetup& robot : scenario_.robots)
      if (!robot.following && robot.motion.hasPath())
        distance = std::min(distance, robot.motion.distanceToPath(p));
    return distance >= setup_.pathMin && distance <= setup_.pathMax;
  }

  const Scenario& scenario_;
  const LandmarkSetup& setup_;
  std::map<int, Point2D> out_;
};
}  // namespace

std::map<int, Point2D> placeLandmarks(const Scenario& s, std::uint64_t seed)
{
  Placing placing(s);
  for (int id = 0; id < s.landmarks.count; ++id)
    placing.add(id, stream(seed, Purpose::kLandmark, 0, static_cast<std::uint64_t>(id)));
  return placing.take();
}
}  // namespace slamot::sim
