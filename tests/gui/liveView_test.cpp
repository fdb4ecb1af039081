#include <cmath>

#include "Screen.h"

namespace slamot
{
namespace
{
using test::Process;
using test::Screen;

// The scene's colours.
constexpr test::Rgb kRobot{0x00, 0x72, 0xb2}, kTarget{0xd5, 0x5e, 0x00},
    kLandmark{0x00, 0x9e, 0x73};

std::string runWithView(const Screen& screen, const std::string& options = "")
{
  const std::string source = SLAMOT_SOURCE_DIR;
  return "exec " SLAMOT_PROGRAM " run " + source + "/config-ini/rbpf-slamot.experiment1.ini " +
         source + "/share/datasets/experiment1.rawlog -o " + screen.file("result") + " --view " +
         options;
}

/// As its user does.  A window may not take keys yet: until it is gone.
void close(Screen& screen, Process& run)
{
  const std::string visible = "search --onlyvisible --name '^slamot'";
  const auto gone = [&]
  {
    screen.act(visible + " windowfocus key alt+F4");
    return run.hasEnded() || !screen.act(visible);
  };
  EXPECT_TRUE(test::comes(gone, 60));
}

TEST(RunView, ShowsPathMapAndTargetUntilItIsClosed)
{
  if (const std::string missing = Screen::missing(); !missing.empty()) GTEST_SKIP() << missing;
  Screen screen;
  const auto run = screen.start(runWithView(screen), "run");
  ASSERT_TRUE(run->says("close the window")) << run->text();
  EXPECT_TRUE(screen.shows(kRobot, 1500)) << "the robot's path";
  EXPECT_TRUE(screen.shows(kTarget, 1500)) << "the target and its path";
  EXPECT_TRUE(screen.shows(kLandmark, 500)) << "the map";
  EXPECT_FALSE(run->hasEnded());
  close(screen, *run);
  EXPECT_EQ(run->status(), 0) << run->text();
}

TEST(RunView, GoesOnWhenItsWindowIsClosed)
{
  if (const std::string missing = Screen::missing(); !missing.empty()) GTEST_SKIP() << missing;
  Screen screen;
  const auto run = screen.start(runWithView(screen, "--set rbpf-slamot.particles=20000"), "run");
  ASSERT_TRUE(screen.act("search --sync --onlyvisible --name '^slamot'")) << run->text();
  close(screen, *run);
  EXPECT_EQ(run->status(), 0) << run->text();
  EXPECT_NE(run->text().find("320 steps"), std::string::npos) << run->text();
  EXPECT_EQ(run->text().find("close the window"), std::string::npos) << "it was closed before";
}

// The user drags all of the map out of view, with the right button.
TEST(RunView, StaysWhereTheUserLooks)
{
  if (const std::string missing = Screen::missing(); !missing.empty()) GTEST_SKIP() << missing;
  constexpr long kLegendsShare = 400;  // of pixels in the robot's colour
  Screen screen;
  const auto run = screen.start(runWithView(screen, "--set rbpf-slamot.particles=20000"), "run");
  ASSERT_TRUE(screen.act("search --sync --onlyvisible --name '^slamot'")) << run->text();
  ASSERT_TRUE(screen.shows(kRobot, 700)) << run->text();
  std::string drags;  // not faster than the window takes them
  for (int i = 0; i < 5; ++i)
    drags +=
        " mousemove 700 300 sleep 0.1 mousedown 3 sleep 0.1 mousemove 700 320 sleep 0.1 "
        "mousemove 700 500 sleep 0.1 mousemove 700 700 sleep 0.1 mouseup 3";
  ASSERT_TRUE(screen.act(drags));
  const auto isGone = [&] { return screen.picture().count(kRobot) < kLegendsShare; };
  EXPECT_TRUE(isGone());
  EXPECT_EQ(run->text().find("close the window"), std::string::npos) << "the run was to go on";
  ASSERT_TRUE(test::comes([&] { return run->says("close the window"); }, 120)) << run->text();
  EXPECT_TRUE(isGone()) << "the view has gone back";
  close(screen, *run);
}

TEST(RunView, WithoutADisplayIsAnErrorThatSaysSo)
{
  const test::TemporaryFolder folder;
  const std::string source = SLAMOT_SOURCE_DIR;
  Process run({"sh", "-c",
               "unset DISPLAY WAYLAND_DISPLAY; exec " SLAMOT_PROGRAM " run " + source +
                   "/config-ini/rbpf-slamot.experiment1.ini " + source +
                   "/share/datasets/experiment1.rawlog --view -o " + folder.file("result")},
              folder.file("log"));
  EXPECT_EQ(run.status(), 1);
  EXPECT_EQ(run.text(),
            "slamot: error: command line --view: there is no display: DISPLAY is not set; leave it "
            "out; slamot render draws without one\n");
  EXPECT_FALSE(std::ifstream(folder.file("result/summary.json")).good());
}
}  // namespace
}  // namespace slamot
