#include "GzWriter.h"
#include "saveWhole.h"
#include "toObservations.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/serialization/CArchive.h>
#include <slamot/mrpt/LaserMaps.h>

#include <algorithm>
#include <cmath>

namespace slamot::mrpt
{
namespace
{
using ::mrpt::maps::COccupancyGridMap2D;

constexpr double kResolution = 0.05;  // [m]
constexpr double kMostCells = 4e6;
constexpr double kMargin = 1.0;     // [m] around the farthest returns
constexpr double kFarthest = 40.0;  // [m]: beyond, beams lie too far apart to draw walls

struct Box
{
  double xMin = 1e300, xMax = -1e300, yMin = 1e300, yMax = -1e300;

  void add(const Point2D& p)
  {
    xMin = std::min(xMin, p.x), xMax = std::max(xMax, p.x);
    yMin = std::min(yMin, p.y), yMax = std::max(yMax, p.y);
  }
};

std::vector<::mrpt::obs::CObservation::Ptr> observationsOf(const PosedScans& s)
{
  core::Step step;
  step.time = s.time;
  step.lasers = s.scans;
  return toObservations(step);
}

/// f(return, in the frame that the sensor's pose is given in), as far as walls can be drawn.
template <class F>
void forReturns(const Pose2D& sensor, const core::LaserScan& scan, F&& f)
{
  const double farthest = std::min(scan.rangeMax, kFarthest);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
  {
    const double r = scan.ranges[i];
    if (!(r > 0 && r < farthest)) continue;
    const double a = scan.angleMin + static_cast<double>(i) * scan.angleStep;
    f(math::transform(sensor, {r * std::cos(a), r * std::sin(a)}));
  }
}

Box boxOf(const std::vector<PosedScans>& all)
{
  Box box;
  for (const PosedScans& s : all)
  {
    box.add({s.robot.mean.x, s.robot.mean.y});
    for (const auto& scan : s.scans)
      forReturns(math::compose(s.robot.mean, scan->pose_robot_sensor), *scan,
                 [&](const Point2D& p) { box.add(p); });
  }
  return {box.xMin - kMargin, box.xMax + kMargin, box.yMin - kMargin, box.yMax + kMargin};
}
}  // namespace

void saveSimpleMap(const std::string& path, const std::vector<PosedScans>& scans)
{
  ::mrpt::maps::CSimpleMap map;
  for (const PosedScans& s : scans)
  {
    const Pose2D& mean = s.robot.mean;
    // MRPT 2.5.8's insert() of a pose in the plane throws: it makes no copy of it.
    const auto pose = std::make_shared<::mrpt::poses::CPose3DPDFGaussian>();
    pose->copyFrom(::mrpt::poses::CPosePDFGaussian(::mrpt::poses::CPose2D(mean.x, mean.y, mean.phi),
                                                   ::mrpt::math::CMatrixDouble33(s.robot.cov)));
    const auto frame = std::make_shared<::mrpt::obs::CSensoryFrame>();
    for (const auto& o : observationsOf(s)) frame->insert(o);
    map.insert(pose, frame);
  }
  saveWhole(path, [&](const std::string& file) { return map.saveToFile(file); });
}

void savePoints(const std::string& path, const std::vector<PosedScans>& scans)
{
  ::mrpt::maps::CSimplePointsMap points;
  for (const PosedScans& s : scans)
    for (const auto& scan : s.scans)
      forReturns(math::compose(s.robot.mean, scan->pose_robot_sensor), *scan,
                 [&](const Point2D& p)
                 { points.insertPoint(static_cast<float>(p.x), static_cast<float>(p.y)); });
  saveWhole(path, [&](const std::string& file) { return points.save2D_to_text_file(file); });
}

void saveGrid(const std::string& picturePath, const std::string& gridPath,
              const std::vector<PosedScans>& scans)
{
  const Box box = boxOf(scans);
  const double area = (box.xMax - box.xMin) * (box.yMax - box.yMin);
  const double resolution = std::max(kResolution, std::sqrt(area / kMostCells));
  COccupancyGridMap2D grid;
  grid.setSize(static_cast<float>(box.xMin), static_cast<float>(box.xMax),
               static_cast<float>(box.yMin), static_cast<float>(box.yMax),
               static_cast<float>(resolution));
  grid.insertionOptions.maxDistanceInsertion = static_cast<float>(kFarthest);
  for (const PosedScans& s : scans)
    for (const auto& o : observationsOf(s))
      grid.insertObservation(*o, ::mrpt::poses::CPose3D(s.robot.mean));
  saveWhole(picturePath, [&](const std::string& file) { return grid.saveAsBitmapFile(file); });
  ::mrpt::io::CMemoryStream memory;
  ::mrpt::serialization::archiveFrom(memory) << grid;
  GzWriter file(gridPath);  // tells of a full disk, which MRPT's own stream does not
  file.write(memory.getRawBufferData(), memory.getTotalBytesCount());
  file.close();
}
}  // namespace slamot::mrpt
