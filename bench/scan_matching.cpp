// Our scan matcher and MRPT's ICP on the same problems: a scan in a corridor of a drawn house, a
// map of nine scans before it, a guess that is off.  Prints a table: how many come out right, how
// near, how honest, how fast.

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/slam/CICP.h>
#include <slamot/scans/ScanMatcher.h>
#include <slamot/scans/returns.h>

#include <chrono>
#include <cstdio>
#include <functional>

#include "drawnHouse.h"

namespace
{
using namespace slamot;
using namespace slamot::test;
using Points = std::vector<Point2D>;

constexpr int kProblems = 300;

struct Problem
{
  Points map, scan;
  Pose2D truth;
  Gaussian<Pose2D> guess;
};

Points pointsFrom(const Walls& walls, const Pose2D& pose, math::RandomStream& random)
{
  Points out;
  for (const auto& r : scans::returnsOf({scanFrom(walls, pose, random)}, 25))
    out.push_back(r.point);
  return scans::thinned(out, 0.05);
}

Problem makeProblem(std::uint64_t seed, double stdPosition, double stdHeading)
{
  static const Walls walls = ringCorridor();
  static const auto drive = driveAlong({{4, 1}, {23, 1}, {23, 15}, {1, 15}, {1, 1}, {12, 1}});
  math::RandomStream random{seed};
  const auto at =
      20 + static_cast<std::size_t>(random.uniform(0, static_cast<double>(drive.size()) - 20));
  const Pose2D reference = drive[at - 3];
  Problem out;
  for (std::size_t i = at - 19; i <= at - 3; i += 2)
    for (const Point2D& p : pointsFrom(walls, drive[i], random))
      out.map.push_back(math::transform(math::between(reference, drive[i]), p));
  out.scan = pointsFrom(walls, drive[at], random);
  out.truth = math::between(reference, drive[at]);
  out.guess.mean = {out.truth.x + stdPosition * random.normal(),
                    out.truth.y + stdPosition * random.normal(),
                    out.truth.phi + stdHeading * random.normal()};
  out.guess.cov.diagonal() =
      Vector3(stdPosition * stdPosition, stdPosition * stdPosition, stdHeading * stdHeading);
  return out;
}

using Matcher = std::function<Gaussian<Pose2D>(const Problem&)>;

Gaussian<Pose2D> byScanMatcher(const Problem& p)
{
  const scans::LocalMap map(p.map, 40);
  return scans::ScanMatcher({0.03, 1, 0.001, 0.0002, 0.35})
      .match(map, p.scan, p.guess, {0.4, 1.5, math::degToRad(25), 1})
      .alone;
}

Matcher byIcp(::mrpt::slam::TICPAlgorithm algorithm, double distance, double angle)
{
  return [=](const Problem& p)
  {
    ::mrpt::maps::CSimplePointsMap map, scan;
    for (const Point2D& q : p.map)
      map.insertPoint(static_cast<float>(q.x), static_cast<float>(q.y), 0);
    for (const Point2D& q : p.scan)
      scan.insertPoint(static_cast<float>(q.x), static_cast<float>(q.y), 0);
    ::mrpt::slam::CICP icp;
    icp.options.ICP_algorithm = algorithm;
    icp.options.maxIterations = 100;
    icp.options.thresholdDist = distance;
    icp.options.thresholdAng = angle;
    icp.options.smallestThresholdDist = 0.05;
    ::mrpt::slam::CICP::TReturnInfo info;
    const auto& g = p.guess.mean;
    const auto found = icp.Align(&map, &scan, ::mrpt::poses::CPose2D(g.x, g.y, g.phi), info);
    const auto [cov, mean] = found->getCovarianceAndMean();
    Gaussian<Pose2D> out;
    out.mean = {mean.x(), mean.y(), mean.phi()};
    out.cov = cov.asEigen();
    return out;
  };
}

void measure(const char* name, const Matcher& matcher, double stdPosition, double stdHeading)
{
  int right = 0;
  double position = 0, heading = 0, time = 0;
  std::vector<double> nees;
  for (int i = 0; i < kProblems; ++i)
  {
    const Problem p = makeProblem(static_cast<std::uint64_t>(i), stdPosition, stdHeading);
    const auto begin = std::chrono::steady_clock::now();
    const Gaussian<Pose2D> found = matcher(p);
    time += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const Vector3 e{found.mean.x - p.truth.x, found.mean.y - p.truth.y,
                    math::wrapToPi(found.mean.phi - p.truth.phi)};
    if (e.head<2>().norm() > 0.1 || std::abs(e[2]) > math::degToRad(2)) continue;
    ++right;
    position += e.head<2>().squaredNorm();
    heading += e[2] * e[2];
    nees.push_back(math::mahalanobisSquared(e, found.cov));
  }
  double mean = 0;
  for (const double v : nees) mean += v / right;
  std::printf("%-26s %5.1f %%   %.4f m  %.3f deg   NEES %7.2f   %.2f ms\n", name,
              100.0 * right / kProblems, std::sqrt(position / right),
              math::radToDeg(std::sqrt(heading / right)), mean, 1e3 * time / kProblems);
}
}  // namespace

int main()
{
  using ::mrpt::slam::icpClassic;
  using ::mrpt::slam::icpLevenbergMarquardt;
  for (const auto& [position, degrees] : {std::pair{0.05, 2.6}, {0.13, 7.0}, {0.15, 12.0}})
  {
    const double heading = math::degToRad(degrees);
    std::printf("guess off by %.2f m, %.1f deg: within 0.1 m and 2 deg; of these, rms; time\n",
                position, degrees);
    measure("ScanMatcher", byScanMatcher, position, heading);
    measure("CICP classic, 0.75 m 10 deg", byIcp(icpClassic, 0.75, math::degToRad(10)), position,
            heading);
    measure("CICP classic, 0.3 m 5 deg", byIcp(icpClassic, 0.3, math::degToRad(5)), position,
            heading);
    measure("CICP LM, 0.75 m 10 deg", byIcp(icpLevenbergMarquardt, 0.75, math::degToRad(10)),
            position, heading);
  }
}
