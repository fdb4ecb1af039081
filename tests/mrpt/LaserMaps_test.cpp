#include "temporary.h"

#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/serialization/CArchive.h>
#include <slamot/core/Error.h>
#include <slamot/mrpt/LaserMaps.h>

#include <fstream>
#include <sstream>

namespace slamot::mrpt
{
namespace
{
// All round, at the middle of a square room of 4 m: the walls are 2 m off.
std::shared_ptr<const core::LaserScan> room()
{
  auto scan = std::make_shared<core::LaserScan>();
  scan->angleMin = -math::kPi;
  scan->angleStep = math::degToRad(0.5);
  scan->rangeMax = 30;
  for (int i = 0; i <= 720; ++i)
  {
    const double a = scan->angleMin + i * scan->angleStep;
    scan->ranges.push_back(
        static_cast<float>(2 / std::max(std::abs(std::cos(a)), std::abs(std::sin(a)))));
  }
  return scan;
}

std::vector<PosedScans> twoScans()
{
  PosedScans a, b;
  a.time = 10, b.time = 11;
  a.robot.mean = {5, 3, 0};
  b.robot.mean = {5, 3, math::kPi / 2};
  b.robot.cov = 0.01 * Matrix3::Identity();
  a.scans = b.scans = {room()};
  return {a, b};
}

std::string read(const std::string& path)
{
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}
}  // namespace

TEST(LoadScans, GivesBackWhatWasSaved)
{
  const tests::TemporaryFolder folder;
  saveSimpleMap(folder.file("a.simplemap"), twoScans());
  const std::vector<PosedScans> read = loadScans(folder.file("a.simplemap"));
  ASSERT_EQ(read.size(), 2u);
  EXPECT_DOUBLE_EQ(read[1].time, 11);
  ASSERT_EQ(read[1].scans.size(), 1u);
  EXPECT_EQ(read[1].scans[0]->ranges, room()->ranges);
  EXPECT_NEAR(read[1].scans[0]->angleMin, -math::kPi, 1e-6);
}

TEST(LoadScans, NamesTheFaultOfWhateverIsCut)
{
  const tests::TemporaryFolder folder;
  const std::string path = folder.file("a.simplemap"), cut = folder.file("cut.simplemap");
  saveSimpleMap(path, twoScans());
  const std::string whole = read(path);
  for (std::size_t size = 1; size < whole.size(); size += 97)
  {
    std::ofstream(cut, std::ios::binary) << whole.substr(0, size);
    EXPECT_THROW((void)loadScans(cut), core::Error) << size << " bytes";
  }
  EXPECT_THROW((void)loadScans(folder.file("none")), core::Error);
}

TEST(SimpleMap, HoldsScansAndPoses)
{
  const tests::TemporaryFolder folder;
  const std::string path = folder.file("map.simplemap");
  saveSimpleMap(path, twoScans());
  ::mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile(path));
  ASSERT_EQ(map.size(), 2u);
}

TEST(SimpleMap, GivesTheSameBytesTwice)
{
  const tests::TemporaryFolder folder;
  saveSimpleMap(folder.file("a.simplemap"), twoScans());
  saveSimpleMap(folder.file("b.simplemap"), twoScans());
  EXPECT_EQ(read(folder.file("a.simplemap")), read(folder.file("b.simplemap")));
}

TEST(GridPicture, IsDarkAtTheWallsAndBrightBetween)
{
  const tests::TemporaryFolder folder;
  const std::string path = folder.file("grid.png");
  saveGrid(path, folder.file("map.gridmap"), twoScans());
  ::mrpt::img::CImage image;
  ASSERT_TRUE(image.loadFromFile(path));
  // The room and a margin of 1 m: 6 m of 0.05 m.
  EXPECT_NEAR(static_cast<double>(image.getWidth()), 120, 3);
  EXPECT_NEAR(static_cast<double>(image.getHeight()), 120, 3);
  const auto at = [&](int x, int y) { return image.getAsFloat(x, y); };
  EXPECT_GT(at(60, 60), 0.6F);
  EXPECT_LT(std::min({at(19, 60), at(20, 60), at(21, 60)}), 0.4F);
  EXPECT_NEAR(at(3, 3), 0.5, 0.05);
}

TEST(GridPicture, HasXToTheRightAndYUp)
{
  const tests::TemporaryFolder folder;
  const std::string path = folder.file("grid.png");
  auto wall = std::make_shared<core::LaserScan>();  // 3 m to the left of a robot that looks along x
  wall->angleMin = math::degToRad(85.0);
  wall->angleStep = math::degToRad(0.5);
  wall->rangeMax = 30;
  wall->ranges.assign(21, 3.0F);
  PosedScans s;
  s.scans = {wall};
  saveGrid(path, folder.file("map.gridmap"), {s});
  ::mrpt::img::CImage image;
  ASSERT_TRUE(image.loadFromFile(path));
  std::size_t dark = 0, darkAbove = 0;
  for (std::size_t y = 0; y < image.getHeight(); ++y)
    for (std::size_t x = 0; x < image.getWidth(); ++x)
      if (image.getAsFloat(x, y) < 0.4F) ++dark, darkAbove += y < image.getHeight() / 2 ? 1 : 0;
  EXPECT_GT(dark, 3u);
  EXPECT_EQ(dark, darkAbove);
}

TEST(Grid, IsReadByMrpt)
{
  const tests::TemporaryFolder folder;
  const std::string path = folder.file("map.gridmap");
  saveGrid(folder.file("grid.png"), path, twoScans());
  ::mrpt::io::CFileGZInputStream file(path);
  auto archive = ::mrpt::serialization::archiveFrom(file);
  ::mrpt::maps::COccupancyGridMap2D grid;
  archive >> grid;
  EXPECT_GT(grid.getPos(5, 3), 0.6F);     // where the robot is, it is free
  EXPECT_LT(grid.getPos(7, 3.2F), 0.4F);  // the wall
}

TEST(Points, AreTheReturnsInTheMap)
{
  const tests::TemporaryFolder folder;
  const std::string path = folder.file("points.txt");
  savePoints(path, twoScans());
  ::mrpt::maps::CSimplePointsMap points;
  ASSERT_TRUE(points.load2D_from_text_file(path));
  EXPECT_EQ(points.size(), 2u * 721);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    float x = 0, y = 0;
    points.getPoint(i, x, y);
    EXPECT_NEAR(std::max(std::abs(x - 5), std::abs(y - 3)), 2, 0.01);
  }
}

TEST(LaserMaps, SayWhereTheyCantBeWritten)
{
  EXPECT_THROW(saveGrid("/no/such/folder/grid.png", "/no/such/folder/map.gridmap", twoScans()),
               core::Error);
  EXPECT_THROW(saveSimpleMap("/no/such/folder/map.simplemap", twoScans()), core::Error);
}
}  // namespace slamot::mrpt
