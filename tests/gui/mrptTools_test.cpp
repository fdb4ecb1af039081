// MRPT's own tools, on this project's files.
#include "Screen.h"

namespace slamot
{
namespace
{
using test::Rgb;
using test::Screen;

constexpr const char* kSource = SLAMOT_SOURCE_DIR;

std::string missing(const std::string& tool)
{
  std::string what = Screen::missing();
  if (what.empty() && std::system(("command -v " + tool + " >/dev/null").c_str()) != 0)
    what = tool + " is not installed";
  return what;
}

/// For the documentation: the screen as a file, if the environment names a folder.
void keep(Screen& screen, const std::string& name)
{
  const char* folder = std::getenv("SLAMOT_SCREENSHOTS");
  if (folder == nullptr) return;
  const std::string file = std::string(folder) + "/" + name;
  EXPECT_EQ(screen.start("exec import -window root " + file, "keep")->status(), 0);
}

TEST(RawLogViewer, DrawsBlobsOnceThePluginIsLoaded)
{
  if (const std::string what = missing("RawLogViewer"); !what.empty()) GTEST_SKIP() << what;
  constexpr Rgb kTarget{0x00, 0x79, 0x79};  // of the label "target", in the shade
  Screen screen;
  const auto viewer = screen.start("cd '" + std::string(kSource) +
                                       "' && exec RawLogViewer -l " SLAMOT_PLUGIN
                                       " share/datasets/post-field.rawlog",
                                   "viewer");
  int attempt = 0;
  const auto selectBlobs = [&]
  {
    // Rows of the tree are as high as the theme and its font make them: up and down from where
    // blobs of a frame are with the default ones.
    constexpr int kMiddle = 397, kRow = 9, kRows = 25;
    const int k = attempt++ % kRows, row = kMiddle + (k % 2 == 0 ? 1 : -1) * ((k + 1) / 2) * kRow;
    // The tip of the day lies before it, once it is there.
    screen.act("search --onlyvisible --name '^Tip of the Day' windowfocus key Escape");
    screen.act("mousemove 240 " + std::to_string(row) + " click 1 sleep 0.3");
    return screen.picture().count(kTarget, 410, 490) > 40;  // in the 3-D view
  };
  EXPECT_TRUE(test::comes(selectBlobs, 120)) << viewer->text();
  keep(screen, "rawlogviewer.png");
  EXPECT_FALSE(viewer->hasEnded()) << viewer->text();
}

TEST(SceneViewer3D, ShowsAResultsScene)
{
  if (const std::string what = missing("SceneViewer3D"); !what.empty()) GTEST_SKIP() << what;
  Screen screen;
  const std::string source = kSource;
  const auto run = screen.start(
      "exec " SLAMOT_PROGRAM " run -q " + source + "/config-ini/rbpf-slamot.experiment1.ini " +
          source + "/share/datasets/experiment1.rawlog -o " + screen.file("result"),
      "run");
  ASSERT_EQ(run->status(), 0) << run->text();
  const auto viewer =
      screen.start("exec SceneViewer3D " + screen.file("result/scene.3Dscene"), "viewer");
  EXPECT_TRUE(screen.shows({0x00, 0x72, 0xb2}, 1000, 60)) << "the robot's path";
  const auto picture = screen.picture();
  EXPECT_GT(picture.count({0xd5, 0x5e, 0x00}), 1000) << "the target's path";
  EXPECT_GT(picture.count({0x00, 0x9e, 0x73}), 300) << "landmarks";
  keep(screen, "sceneviewer3d.png");
  EXPECT_FALSE(viewer->hasEnded()) << viewer->text();
}
}  // namespace
}  // namespace slamot
