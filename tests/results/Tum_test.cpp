#include "TemporaryFolder.h"

#include <slamot/core/Error.h>
#include <slamot/results/Tum.h>

#include <clocale>
#include <limits>
#include <locale>

namespace slamot::results
{
namespace
{
using core::ExitStatus;
using test::TemporaryFolder;

// The status and the message of reading this text.
std::pair<ExitStatus, std::string> failureOf(const std::string& text)
{
  const TemporaryFolder folder;
  try
  {
    (void)loadTum(folder.write("a.tum", text));
  }
  catch (const core::Error& e)
  {
    return {e.status(), e.what()};
  }
  return {ExitStatus::kDone, ""};
}

TEST(Tum, ComesBackAsItWasWritten)
{
  const TemporaryFolder folder;
  eval::Trajectory a;
  a.poses = {{0, {1.25, -2.5, 0}, true},
             {0.025, {-1e-3, 4e5, 3.1}, true},
             {1.3e9 + 0.125, {7, 8, -3.14159}, true},
             {1.3e9 + 1, {7, 8, 0}, false}};
  saveTum(folder.file("a.tum"), a);
  const eval::Trajectory b = loadTum(folder.file("a.tum"));
  ASSERT_EQ(b.poses.size(), a.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i)
  {
    EXPECT_NEAR(b.poses[i].time, a.poses[i].time, 1e-9);
    EXPECT_NEAR(b.poses[i].pose.x, a.poses[i].pose.x, 1e-9);
    EXPECT_NEAR(b.poses[i].pose.y, a.poses[i].pose.y, 1e-9);
    EXPECT_NEAR(math::wrapToPi(b.poses[i].pose.phi - a.poses[i].pose.phi), 0, 3e-9);
    EXPECT_EQ(b.poses[i].headingKnown, a.poses[i].headingKnown);
  }
}

TEST(Tum, WritesEightFieldsWithSingleBlanks)
{
  const TemporaryFolder folder;
  saveTum(folder.file("a.tum"), {{{0.5, {-1e-12, 2, math::kPi}, true}}});
  EXPECT_EQ(folder.read("a.tum"),
            "0.500000000 0.000000000 2.000000000 0.000000000 0.000000000 0.000000000 1.000000000 "
            "0.000000000\n");
}

struct CommaForPoint : std::numpunct<char>
{
  char do_decimal_point() const override { return ','; }
};

TEST(Tum, DoesNotDependOnTheLocale)
{
  const TemporaryFolder folder;
  const std::locale before =
      std::locale::global(std::locale(std::locale::classic(), new CommaForPoint));
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // where there is one
  saveTum(folder.file("a.tum"), {{{0.5, {1.5, 2, 0}, true}}});
  const double x = loadTum(folder.file("a.tum")).poses.at(0).pose.x;
  std::locale::global(before);
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(x, 1.5);
  EXPECT_EQ(folder.read("a.tum").find(','), std::string::npos);
}

TEST(Tum, ReadsWhatOtherToolsWrite)
{
  const TemporaryFolder folder;
  const auto path =
      folder.write("a.tum",
                   "# timestamp tx ty tz qx qy qz qw\r\n\r\n1.0\t 2 3  4 0 0 0.7071 0.7071\r\n"
                   "+1.5e0 2 3 4 0 0 -0.7071 0.7071");
  const eval::Trajectory a = loadTum(path);
  ASSERT_EQ(a.poses.size(), 2u);
  EXPECT_NEAR(a.poses[0].pose.phi, math::kPi / 2, 1e-12);
  EXPECT_NEAR(a.poses[1].pose.phi, -math::kPi / 2, 1e-12);
}

TEST(Tum, NamesTheLineOfWhatIsWrong)
{
  const std::string good = "1 2 3 4 0 0 0 1\n";
  const auto expect = [&](const std::string& bad, ExitStatus status, const std::string& part)
  {
    const auto [got, message] = failureOf(good + bad);
    EXPECT_EQ(got, status) << bad << message;
    EXPECT_NE(message.find("a.tum line 2: "), std::string::npos) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect("2 2 3 4 0 0 1\n", ExitStatus::kNonsense, "7 fields");
  expect("2 2 3 4 0 0 0 1 9\n", ExitStatus::kNonsense, "9 fields");
  expect("2 nan 3 4 0 0 0 1\n", ExitStatus::kNonsense, "x 'nan'");
  expect("2 2 inf 4 0 0 0 1\n", ExitStatus::kNonsense, "y 'inf'");
  expect("2 2 3,5 4 0 0 0 1\n", ExitStatus::kNonsense, "y '3,5'");
  expect("1 2 3 4 0 0 0 1\n", ExitStatus::kNonsense, "not after");
  expect("0.5 2 3 4 0 0 0 1\n", ExitStatus::kNonsense, "not after");
  expect("2 2 3 4 0 0 0 2\n", ExitStatus::kNonsense, "quaternion");
  expect("2 2 3 4 0 0", ExitStatus::kTruncated, "ends within");
  expect(std::string(5000, '1'), ExitStatus::kLimit, "4000");
  expect(std::string("\0\1\2\n", 4), ExitStatus::kNonsense, "1 fields");
}

TEST(Tum, WhatCannotBeReadIsSaid)
{
  const TemporaryFolder folder;
  for (const std::string& path : {folder.file("none.tum"), folder.file("")}) try
    {
      (void)loadTum(path);
      ADD_FAILURE() << path;
    }
    catch (const core::Error& e)
    {
      EXPECT_EQ(e.status(), ExitStatus::kUnreadable) << e.what();
    }
}

TEST(Tum, NeverWritesAFileThatItWouldNotRead)
{
  const TemporaryFolder folder;
  const auto path = folder.file("a.tum");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(saveTum(path, {{{0, {nan, 0, 0}, true}}}), core::Error);
  EXPECT_THROW(saveTum(path, {{{1, {}, true}, {1, {}, true}}}), core::Error);
  EXPECT_THROW(saveTum(path, {{{1, {}, true}, {1 + 1e-11, {}, true}}}), core::Error);
  EXPECT_FALSE(std::filesystem::exists(path));
}
}  // namespace
}  // namespace slamot::results
