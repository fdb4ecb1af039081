#include <filesystem>

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

std::string runWithView(const Screen& screen, const std::string& options = "",
                        const std::string& environment = "")
{
  const std::string source = SLAMOT_SOURCE_DIR;
  return "exec env " + environment + " " SLAMOT_PROGRAM " run " + source +
         "/config-ini/rbpf-slamot.experiment1.ini " + source +
         "/share/datasets/experiment1.rawlog -o " + screen.file("result") + " --view " + options;
}

/// A run that waits at its fourth picture until it is let go.
class HeldRun
{
 public:
  explicit HeldRun(Screen& screen) : hold_(screen.file("hold"))
  {
    std::ofstream file(hold_);
    run_ = screen.start(runWithView(screen, "--set rbpf-slamot.particles=20000",
                                    "HELD_BY=" + hold_ + " LD_PRELOAD=" SLAMOT_HELD_WINDOWS),
                        "run");
  }
  void letGo() { std::filesystem::remove(hold_); }
  Process& operator*() { return *run_; }
  Process* operator->() { return run_.get(); }

 private:
  std::string hold_;
  std::unique_ptr<Process> run_;
};

/// As its user does.  A window may not take keys yet: until it is gone; but not again while it
/// goes, which MRPT does not expect.
void close(Screen& screen, Process& run)
{
  const std::string visible = "search --onlyvisible --name '^slamot'";
  const auto isGone = [&] { return run.hasEnded() || !screen.act(visible); };
  const auto gone = [&]
  {
    screen.act(visible + " windowfocus key alt+F4");
    return test::comes(isGone, 3);
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
  HeldRun run(screen);
  ASSERT_TRUE(run->says("held")) << run->text();
  close(screen, *run);
  EXPECT_FALSE(run->hasEnded());
  run.letGo();
  EXPECT_EQ(run->status(), 0) << run->text();
  EXPECT_NE(run->text().find("320 steps"), std::string::npos) << run->text();
  EXPECT_EQ(run->text().find("close the window"), std::string::npos) << "it was closed before";
}

// MRPT's thread was still at work on the window when the run freed it, and wrote to freed memory.
TEST(RunView, EndsWellWhileItsWindowGoesSlowly)
{
  if (const std::string missing = Screen::missing(); !missing.empty()) GTEST_SKIP() << missing;
  Screen screen;
  const auto run = screen.start(
      runWithView(screen, "", "MALLOC_PERTURB_=85 LD_PRELOAD=" SLAMOT_HELD_WINDOWS), "run");
  ASSERT_TRUE(run->says("close the window")) << run->text();
  close(screen, *run);
  EXPECT_EQ(run->status(), 0) << run->text();
  EXPECT_NE(run->text().find("a window goes slowly"), std::string::npos) << run->text();
  EXPECT_EQ(run->text().find("MRPT ends"), std::string::npos) << run->text();
}

// The user drags all of the map out of view, with the right button.
TEST(RunView, StaysWhereTheUserLooks)
{
  if (const std::string missing = Screen::missing(); !missing.empty()) GTEST_SKIP() << missing;
  Screen screen;
  // Below the legend.
  const auto robot = [&] { return screen.picture().count(kRobot, 0, 300); };
  HeldRun run(screen);
  ASSERT_TRUE(run->says("held")) << run->text();
  ASSERT_TRUE(test::comes([&] { return robot() > 100; }, 30)) << run->text();
  std::string drags;  // not faster than the window takes them
  for (int i = 0; i < 5; ++i)
    drags +=
        " mousemove 700 300 sleep 0.1 mousedown 3 sleep 0.1 mousemove 700 320 sleep 0.1 "
        "mousemove 700 500 sleep 0.1 mousemove 700 700 sleep 0.1 mouseup 3";
  ASSERT_TRUE(screen.act(drags));
  EXPECT_TRUE(test::comes([&] { return robot() == 0; }, 30));
  run.letGo();
  ASSERT_TRUE(test::comes([&] { return run->says("close the window"); }, 120)) << run->text();
  ASSERT_TRUE(screen.act("sleep 0.5"));  // for the last picture
  EXPECT_EQ(robot(), 0) << "the view has gone back";
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
