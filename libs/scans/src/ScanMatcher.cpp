#include <slamot/scans/ScanMatcher.h>

#include <Eigen/LU>
#include <algorithm>

#include "align.h"
#include "searchWindow.h"

namespace slamot::scans
{
namespace
{
constexpr std::size_t kFewest = 20;                  // points of a scan worth matching
constexpr double kFarthest = 1e4;                    // [m]: beyond, cells have no numbers
constexpr double kAnywhere = 100, kAnyHeading = 10;  // [m, rad]: deviations where nothing tells

Matrix3 diagonal(double position, double heading)
{
  return Vector3(position * position, position * position, heading * heading).asDiagonal();
}
bool isUsable(const Gaussian<Pose2D>& g)
{
  return g.cov.allFinite() && std::abs(g.mean.x) < kFarthest && std::abs(g.mean.y) < kFarthest &&
         std::isfinite(g.mean.phi);
}

/// Odometry that is contradicted has slipped, and tells less than it says: its deviations grow
/// until what was found is no more than likely.
Matrix3 loosened(const Gaussian<Pose2D>& expected, const Pose2D& found)
{
  constexpr double kLikely = 7.8;  // 95 % at 3 degrees of freedom
  const Pose2D& e = expected.mean;
  const Vector3 d{found.x - e.x, found.y - e.y, math::wrapToPi(found.phi - e.phi)};
  return std::max(1.0, d.dot(expected.cov.inverse() * d) / kLikely) * expected.cov;
}
}  // namespace

Match ScanMatcher::match(const LocalMap& map, const std::vector<Point2D>& points,
                         const Gaussian<Pose2D>& expected, const MatchReach& reach) const
{
  Match out;
  out.pose = out.alone = expected;
  if (map.empty() || points.size() < kFewest || !isUsable(expected)) return out;
  // An expectation without doubt would have no inverse.
  Gaussian<Pose2D> prior = expected;
  prior.cov += diagonal(1e-3, 1e-3);
  SearchWindow window;
  window.centre = expected.mean;
  window.positionStd = math::ellipse(prior.cov.topLeftCorner<2, 2>()).longer;
  window.headingStd = std::sqrt(prior.cov(2, 2));
  window.radius = std::clamp(3 * window.positionStd, reach.leastRadius, reach.mostRadius);
  window.turn = std::clamp(3 * window.headingStd, reach.leastTurn, reach.mostTurn);
  // Nobody looks beyond what is thought possible, so there it costs no more than at its edge.
  window.positionStd = std::max(window.positionStd, window.radius / 3);
  window.headingStd = std::max(window.headingStd, window.turn / 3);
  const auto found = searchWindow(map, points, window, settings_.leastScore);
  if (!found) return out;
  out.score = found->score;
  prior.cov = loosened(prior, found->pose);
  const Alignment a =
      align(map, points, found->pose, prior, settings_.rangeStd, settings_.inflation);
  out.explained = a.explained;
  const Matrix3 floor = diagonal(settings_.floorPosition, settings_.floorHeading);
  const Matrix3 nothing = diagonal(1 / kAnywhere, 1 / kAnyHeading);
  out.alone = {a.pose, Matrix3((a.information + nothing).inverse()) + floor};
  out.pose = {a.pose, Matrix3((a.information + prior.cov.inverse()).inverse()) + floor};
  out.matched = out.alone.cov.allFinite() && out.pose.cov.allFinite();
  return out;
}
}  // namespace slamot::scans
