#include "../../libs/mrpt/src/view.h"
#include "../results/TemporaryFolder.h"
#include "Process.h"
#include "program.h"

#include <slamot/math/geometry.h>
#include <slamot/mrpt/Scene.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <opencv2/videoio.hpp>

namespace slamot
{
namespace
{
namespace fs = std::filesystem;
using test::slamot;
using test::TemporaryFolder;

/// A result folder, as an interrupted run might leave: a robot that drives 10 m along x in `rows` -
/// 1 seconds, beside it by `y` [m], and nothing else.
std::string halfAResult(const TemporaryFolder& folder, int rows = 11, int y = 0)
{
  fs::create_directory(folder.file("result"));
  std::ofstream file(folder.file("result/robot.csv"));
  file << "t,x,y,theta,cxx,cxy,cxt,cyy,cyt,ctt\n";
  for (int i = 0; i < rows; ++i)
    file << 50 + i << "," << 10.0 * i / (rows - 1) << "," << y << ",0,0.001,0,0,0.001,0,0.001\n";
  return folder.file("result");
}

struct Film
{
  int frames = 0, width = 0, height = 0;
  double fps = 0;
  cv::Mat first, last;
};

Film read(const std::string& path)
{
  cv::VideoCapture capture(path);
  Film film;
  film.width = static_cast<int>(capture.get(cv::CAP_PROP_FRAME_WIDTH));
  film.height = static_cast<int>(capture.get(cv::CAP_PROP_FRAME_HEIGHT));
  film.fps = capture.get(cv::CAP_PROP_FPS);
  for (cv::Mat frame; capture.read(frame); ++film.frames)
    (film.frames == 0 ? film.first : film.last) = frame.clone();
  return film;
}

/// A place's colour in a plan from above of 640 x 480 pixels, of what halfAResult() holds: the grid
/// is whole metres about it.
cv::Vec3i colourAt(const cv::Mat& frame, double x, double y,
                   const std::array<double, 4>& g = {-1, 11, -1, 1})
{
  mrpt::CameraView view;
  view.elevation = math::kPi / 2;
  view = mrpt::fitted(view, 4.0 / 3, {g[0], g[1], g[2], g[3]});
  const mrpt::ScreenPoint p = mrpt::project(view, 4.0 / 3, x, y);
  const auto* pixel = frame.ptr<unsigned char>(static_cast<int>(std::lround((1 - p.y) / 2 * 480)),
                                               static_cast<int>(std::lround((p.x + 1) / 2 * 640)));
  return {pixel[0], pixel[1], pixel[2]};
}

int distance(const cv::Vec3i& bgr, int r, int g, int b)
{
  return std::abs(bgr[0] - b) + std::abs(bgr[1] - g) + std::abs(bgr[2] - r);
}

TEST(SlamotFilm, ShowsTheRunFromStartToEnd)
{
  const TemporaryFolder folder;
  halfAResult(folder);
  const auto outcome =
      slamot("render result -o a.mp4 --from-above --width 640 --height 480 --fps 10 --speed 5",
             folder.file(""));
  if (outcome.text.find("OpenGL") != std::string::npos) GTEST_SKIP() << outcome.text;
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  const Film film = read(folder.file("a.mp4"));
  EXPECT_EQ(film.frames, 21 + 9) << "2 s, and the last picture for a second";
  EXPECT_EQ(film.width, 640);
  EXPECT_EQ(film.height, 480);
  EXPECT_DOUBLE_EQ(film.fps, 10);
  EXPECT_LT(distance(colourAt(film.first, 0, 0), 0x00, 0x72, 0xb2), 80) << "the robot";
  EXPECT_GT(distance(colourAt(film.first, 5.5, 0), 0x00, 0x72, 0xb2), 200) << "not yet there";
  EXPECT_LT(distance(colourAt(film.last, 5.5, 0), 0x00, 0x72, 0xb2), 80) << "its path";
  EXPECT_FALSE(fs::exists(folder.file("partial.a.mp4")));
}

TEST(SlamotFilm, PicturesAreOfAnyMoment)
{
  const TemporaryFolder folder;
  halfAResult(folder);
  for (const char* options : {"", "--time 3", "--view follow", "--view follow --time 3"})
  {
    const auto outcome = slamot(
        std::string("render result -o a.png --width 320 --height 200 ") + options, folder.file(""));
    if (outcome.text.find("OpenGL") != std::string::npos) GTEST_SKIP() << outcome.text;
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_EQ(folder.read("a.png").substr(1, 3), "PNG");
    fs::remove(folder.file("a.png"));
  }
  const auto late = slamot("render result -o a.png --time 10.5", folder.file(""));
  EXPECT_EQ(late.status, 1);
  EXPECT_EQ(late.text,
            "slamot: error: command line --time: is after the run's end, 10.000 s; choose an "
            "earlier moment\n");
}

struct Fault
{
  const char* arguments;
  int status;
  const char* text;
};

TEST(SlamotFilm, NamesWhatIsWrong)
{
  const TemporaryFolder folder;
  halfAResult(folder);
  mrpt::saveScene(folder.file("a.3Dscene"), {});
  fs::create_directory(folder.file("empty"));
  for (const Fault& fault :
       {Fault{"nothing -o a.mp4", 2,
              "nothing: is not there; give the folder that slamot run wrote"},
        Fault{
            "a.3Dscene -o a.mp4", 2,
            "a.3Dscene: is one moment of a run, and no result folder; give the folder that slamot "
            "run wrote"},
        Fault{
            "empty -o a.mp4", 2,
            "empty: is no result folder: it has no robot.csv and no robot.tum; give a folder that "
            "slamot run wrote, or a TUM file"},
        Fault{"result -o a.mp4 --width 333", 1,
              "command line --width: 333 is odd, which a video's size can't be; take 334"},
        Fault{"result -o a.mp4 --speed 1e-9", 1,
              "command line --speed: would make over 100000 frames; raise it, or lower --fps"},
        Fault{"result -o a.mp4 --time 1", 1,
              "command line --time: is of pictures; end --output in "
              ".png"},
        Fault{"result -o a.png --fps 5", 1,
              "command line --fps: and --speed are of videos; end --output in .mp4"},
        Fault{"result -o a.mp4 --view follow --from-above", 1,
              "command line --from-above: is of --view plan; leave one of them out"},
        Fault{"result -o no/a.mp4", 2,
              "no/a.mp4: can't be written; check the folder and its space"},
        Fault{"result -o a.mp4 --truth none", 2,
              "none: there is no truth; give --truth the path of X.truth or X.rawlog"}})
  {
    const auto outcome = slamot(std::string("render ") + fault.arguments, folder.file(""));
    EXPECT_EQ(outcome.status, fault.status) << fault.arguments;
    EXPECT_EQ(outcome.text, std::string("slamot: error: ") + fault.text + "\n");
    EXPECT_FALSE(fs::exists(folder.file("a.mp4")));
    EXPECT_FALSE(fs::exists(folder.file("partial.a.mp4")));
  }
}

/// Two such robots as a team, the second 1 m to the left of the first.
void halfATeam(const TemporaryFolder& folder)
{
  fs::create_directory(folder.file("team"));
  for (const int robot : {0, 1})
  {
    halfAResult(folder, 11, robot);
    fs::rename(folder.file("result"), folder.file(robot == 0 ? "team/a" : "team/b"));
  }
  folder.write("team/team.json", R"({"rule": "ci", "robots": [{"name": "a"}, {"name": "b"}]})");
}

TEST(SlamotFilm, ShowsATeamEachRobotInItsColour)
{
  const TemporaryFolder folder;
  halfATeam(folder);
  const auto outcome =
      slamot("render team -o a.mp4 --from-above --width 640 --height 480 --fps 5 --speed 5",
             folder.file(""));
  if (outcome.text.find("OpenGL") != std::string::npos) GTEST_SKIP() << outcome.text;
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  const Film film = read(folder.file("a.mp4"));
  EXPECT_EQ(film.frames, 11 + 4);
  const std::array<double, 4> ground = {-1, 11, -1, 2};
  EXPECT_LT(distance(colourAt(film.last, 5.5, 0, ground), 0x00, 0x72, 0xb2), 80) << "the first";
  EXPECT_LT(distance(colourAt(film.last, 5.5, 1, ground), 0xd5, 0x5e, 0x00), 150) << "the second";
  EXPECT_GT(distance(colourAt(film.first, 5.5, 1, ground), 0xd5, 0x5e, 0x00), 200) << "not yet";
  for (const char* options : {"", "--time 3", "--time 3 --from-above"})
  {
    EXPECT_EQ(slamot(std::string("render team -o a.png ") + options, folder.file("")).status, 0);
    EXPECT_EQ(folder.read("a.png").substr(1, 3), "PNG");
    fs::remove(folder.file("a.png"));
  }
}

TEST(SlamotFilm, NamesWhatATeamHasNot)
{
  const TemporaryFolder folder;
  halfATeam(folder);
  fs::create_directory(folder.file("spoilt"));
  folder.write("spoilt/team.json", R"({"rule": 3, "robots": [{"name": "a"}]})");
  fs::create_directory(folder.file("lost"));
  folder.write("lost/team.json", R"({"rule": "ci", "robots": [{"name": "a"}]})");
  for (const Fault& fault :
       {Fault{"team -o a.mp4 --view follow", 1,
              "command line --view follow: is of one robot, and this is a team; give a robot's "
              "folder, or leave it out"},
        Fault{"team -o a.mp4 --truth x", 1,
              "command line --truth: is of one robot, and this is a team; leave it out"},
        Fault{"spoilt -o a.mp4", 4,
              "spoilt/team.json: is not what slamot team wrote; give a result folder"},
        Fault{"lost -o a.mp4", 2, "lost/a: is not there; give the folder that slamot run wrote"}})
  {
    const auto outcome = slamot(std::string("render ") + fault.arguments, folder.file(""));
    EXPECT_EQ(outcome.status, fault.status) << fault.arguments;
    EXPECT_EQ(outcome.text, std::string("slamot: error: ") + fault.text + "\n");
  }
}

TEST(SlamotFilm, LeavesNothingWhenInterrupted)
{
  const TemporaryFolder folder;
  halfAResult(folder, 2000);
  test::Process process(
      {SLAMOT_PROGRAM, "render", folder.file("result"), "-o", folder.file("a.mp4"), "--speed", "1"},
      folder.file("log"));
  ASSERT_TRUE(
      test::comes([&] { return fs::exists(folder.file("partial.a.mp4")) || process.hasEnded(); }));
  process.signal(SIGINT);
  const int status = process.status();
  if (process.text().find("OpenGL") != std::string::npos) GTEST_SKIP() << process.text();
  EXPECT_EQ(status, 130) << process.text();
  EXPECT_FALSE(fs::exists(folder.file("a.mp4")));
  EXPECT_FALSE(fs::exists(folder.file("partial.a.mp4")));
}
}  // namespace
}  // namespace slamot
