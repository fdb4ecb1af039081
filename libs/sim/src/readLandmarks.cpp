#include "readSections.h"

#include <algorithm>

namespace slamot::sim
{
namespace
{
constexpr int kMostLandmarks = 100'000;

void readPositions(core::Params& p, LandmarkSetup& l)
{
  if (!p.has("landmark_positions_m")) return;
  if (l.count > 0) p.fail("landmark_positions_m", "given beside landmarks", "keep one of the two");
  const auto numbers = p.numbers("landmark_positions_m");
  if (numbers.size() % 2 != 0)
    p.fail("landmark_positions_m", "has an x without y", "write x1, y1, x2, y2, ...");
  for (std::size_t i = 0; i < numbers.size(); i += 2)
    l.positions.emplace_back(numbers[i], numbers[i + 1]);
}

// Read whether used or not, so that --set can change from one placement to the other.
void readPlacement(core::Params& p, LandmarkSetup& l, const std::vector<RobotSetup>& robots)
{
  l.alongPath = p.choice("landmark_placement", {"uniform", "along_path"}, "uniform") != "uniform";
  l.pathMin = p.nonNegative("landmark_path_min_m", 0.0);
  l.pathMax = p.positive("landmark_path_max_m", l.alongPath ? std::nullopt : std::optional(1e6));
  if (l.pathMax <= l.pathMin)
    p.fail("landmark_path_max_m", "is not above landmark_path_min_m", "raise it");
  const auto hasPath = [](const RobotSetup& r) { return !r.following && r.motion.hasPath(); };
  if (l.alongPath && std::none_of(robots.begin(), robots.end(), hasPath))
    p.fail("landmark_placement", "along_path, but no robot has a path of its own",
           "set its motion to waypoints or circle");
}

void readClusters(core::Params& p, LandmarkSetup& l)
{
  l.spacing = p.nonNegative("landmark_spacing_min_m", 0.0);
  l.clusterSize = p.integer("landmark_cluster_size", 1, kMostLandmarks, 1);
  l.clusterSpacing = p.positive("landmark_cluster_spacing_m", 1.0);
}
}  // namespace

LandmarkSetup readLandmarks(core::Params& p, const std::vector<RobotSetup>& robots)
{
  LandmarkSetup out;
  out.count = p.integer("landmarks", 0, kMostLandmarks, 0);
  readPlacement(p, out, robots);
  readClusters(p, out);
  readPositions(p, out);
  out.look = Look::from(p, out.look, "landmark_");
  return out;
}
}  // namespace slamot::sim
