#include "CsvData.h"
#include "expectError.h"

namespace slamot::importers
{
namespace
{
using namespace slamot::test;
using core::ExitStatus;

constexpr auto kBad = ExitStatus::kUnreadable;
constexpr auto kNonsense = ExitStatus::kNonsense;

/// A sound folder with one file replaced; its import must fail as said.
void expectFault(const std::string& file, const std::string& text, ExitStatus status,
                 const std::vector<std::string>& parts)
{
  SCOPED_TRACE(file + ":\n" + text);
  const TemporaryFolder folder;
  folder.write("odometry.csv", kOdometryHeader + "1,0,0,0,0\n2,1,0,0.1,0.1\n");
  folder.write(file, text);
  expectError(status, parts, [&] { importCsv(folder); });
}

TEST(CsvFaults, OdometryNamesLineAndColumn)
{
  const std::string file = "odometry.csv", head = kOdometryHeader;
  expectFault(file, head + "1,0,0,0,0\n2,nan,0,0,0\n", kNonsense,
              {"odometry.csv line 3", "column v"});
  expectFault(file, head + "1,inf,0,0,0\n", kNonsense, {"line 2", "'inf'"});
  expectFault(file, head + "1,0,0,-0.1,0\n", kNonsense, {"line 2", "std_v", "negative"});
  expectFault(file, head + "2,0,0,0,0\n1,0,0,0,0\n", kNonsense, {"line 3", "backwards"});
  expectFault(file, head + "-1,0,0,0,0\n", kNonsense, {"line 2", "before the start"});
  expectFault(file, head + "1248444175,0,0,0,0\n", kNonsense,
              {"line 2", "over a day", "--start-time"});
  expectFault(file, head + "1,1e300,0,0,0\n", kNonsense, {"line 2", "'1e300'"});
  expectFault(file, head + "1,0,0,0\n", kBad, {"line 2", "4 columns instead of 5"});
  expectFault(file, head + "0,5,0,0,0,0\n", kBad, {"line 2", "'.' as decimal point"});
  expectFault(file, head + "1,x,0,0,0\n", kBad, {"line 2", "'x' is not a number"});
  expectFault(file, head + "1,,0,0,0\n", kBad, {"line 2", "column v: is empty"});
  expectFault(file, head + "1,0x10,0,0,0\n", kBad, {"line 2", "'0x10'"});
  expectFault(file, head + "1,0,0,0,0\n\n2,0,0,0,0\n", kBad, {"line 3", "blank line"});
  expectFault(file, head + "1,\xff\xfe,0,0,0\n", kBad, {"line 2", "'\\xff\\xfe'"});
  expectFault(file, head + std::string("1,0\0,0,0,0\n", 11), kBad, {"line 2", "\\x00"});
  expectFault(file, head, kBad, {"holds no rows"});
  expectFault(file, "", kBad, {"odometry.csv", "is empty"});
  expectFault(file, "t;v;omega;std_v;std_omega\n1;0;0;0;0\n", kBad,
              {"line 1", "it must be t,v,omega,std_v,std_omega or t,dx"});
  expectFault(file, "1,0,0,0,0\n", kBad, {"line 1", "header"});
}

TEST(CsvFaults, FolderWithoutOdometryOrNoFolder)
{
  const TemporaryFolder folder;
  expectError(kBad, {"odometry.csv", "can't be read"}, [&] { importCsv(folder); });
  const std::string file = folder.write("x", "");
  expectError(kBad, {"is not a folder"}, [&] { openCsvFolder(file); });
}

TEST(CsvFaults, SightingsAndBlobs)
{
  const std::string file = "landmark_sightings.csv", head = kSightingsHeader;
  expectFault(file, head + "1,nan,0,0.1,0.1,1\n", kNonsense, {file + " line 2", "range"});
  expectFault(file, head + "1,1,nan,0.1,0.1,1\n", kNonsense, {"column bearing"});
  expectFault(file, head + "1,1,0,-0.1,0.1,1\n", kNonsense, {"column std_range"});
  expectFault(file, head + "1,1,0,0.1,0,1\n", kNonsense, {"column std_bearing", "above 0"});
  expectFault(file, head + "1,1,0,0.1,0.1,1.5\n", kNonsense, {"column id"});
  expectFault(file, head + "1,1,0,0.1,0.1,-2\n", kNonsense, {"column id"});
  expectFault(file, head + "1,1,0,0.1,0.1,3000000000\n", kNonsense, {"column id"});
  expectFault(file, head + "1,1,,0.1,0.1,1\n", kBad, {"column bearing: is empty"});
  expectFault(file, head + "1.5,,,,,\n1,,,,,\n", kNonsense, {"line 3", "backwards"});
  expectFault(file, head + "9,1,0,0.1,0.1,1\n9,nan,0,0.1,0.1,1\n", kNonsense, {"line 3"});
  expectFault(file, head + "1,,,,\n", kBad, {"5 columns instead of 6"});
  expectFault("blobs.csv", kBlobsHeader + "1,,1,0,0.1,0.1,1\n", kBad, {"column label"});
  expectFault("blobs.csv", kBlobsHeader + "1,a\x01,1,0,0.1,0.1,1\n", kBad, {"column label"});
  expectFault("blobs.csv", kBlobsHeader + "1,a,,0,-1,0.1,1\n", kNonsense, {"std_range"});
  expectFault("blobs.csv", kBlobsHeader + "1,a,,0,,,1\n", kBad, {"std_bearing: is empty"});
}

TEST(CsvFaults, OptionalFiles)
{
  const std::string scan = "t,angle_min,angle_step,range_max,r0,r1\n";
  expectFault("scans.csv", scan + "1,0,0.1,8,1\n", kBad, {"5 columns"});
  expectFault("scans.csv", scan + "1,0,0.1,8,1,nan\n", kNonsense, {"column r1"});
  expectFault("scans.csv", scan + "1,0,0.1,-8,1,1\n", kNonsense, {"column range_max"});
  expectFault("scans.csv", "t,angle_min,angle_step,range_max\n", kBad, {"at least one beam"});
  const std::string fov = "range_min,range_max,bearing_min,bearing_max\n";
  expectFault("fov.csv", fov, kBad, {"no row"});
  expectFault("fov.csv", fov + "0,5,-1,1\n0,5,-1,1\n", kBad, {"line 3", "second row"});
  expectFault("fov.csv", fov + "5,1,-1,1\n", kNonsense, {"lower limit"});
  expectFault("fov.csv", fov + "0,5,-90,90\n", kNonsense, {"line 2"});
  const std::string start =
      "object,x,y,theta,vx,vy,ax,ay,std_x,std_y,std_theta,std_vx,std_vy,std_ax,std_ay\n";
  expectFault("start.csv", start + "car,1,,,,,,,,,,,,,\n", kBad, {"'car' is no object"});
  expectFault("start.csv", start + "robot,1,,,,,,,,,,,,,\nrobot,1,,,,,,,,,,,,,\n", kNonsense,
              {"twice"});
  expectFault("start.csv", start + "robot,1,,,,,,,-1,,,,,,\n", kNonsense, {"std_x"});
  expectFault("truth_robot.csv", "t,x,y,theta\n1,0,0,0\n1,0,0,0\n", kNonsense, {"does not rise"});
  expectFault("truth_target_1.csv", "t,x,y,theta\n1,nan,0,0\n", kNonsense,
              {"truth_target_1.csv line 2"});
  expectFault("truth_landmarks.csv", "id,x,y\n1,0,0\n1,0,0\n", kNonsense, {"line 3", "twice"});
}
}  // namespace
}  // namespace slamot::importers
