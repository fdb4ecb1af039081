#include "../results/TemporaryFolder.h"
#include "program.h"
#include "strangersData.h"

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

// A stranger's data through the whole program: import, run with the shipped configuration for
// anybody's data, evaluate.
//
// Bounds: over 40 to 100 seeds of each such drive, with 50 particles, the robot's rmse was at most
// 0.17 m, the landmarks' 0.14 m, a target's as seen from the robot at a sighting 0.28 m (0.74 m
// where half of them had no range), its tracked part at least 0.48.  Dead reckoning errs by 1 to 2
// m.
namespace slamot
{
namespace
{
using nlohmann::json;
using test::StrangersDrive;
using test::StrangersFacts;
using test::TemporaryFolder;

constexpr double kRobot = 0.3, kLandmarks = 0.3, kTarget = 0.4, kTracked = 0.4;
const std::string kConfig = SLAMOT_SOURCE_DIR "/config-ini/rbpf-slamot.ini";
const std::string kByPlace = " --set rbpf-slamot.association=nn";

/// A stranger's folder and what slamot makes of it.
class Guest : public TemporaryFolder
{
 public:
  explicit Guest(const StrangersDrive& drive)
  {
    std::filesystem::create_directory(file("mine"));
    facts = test::writeStrangersData(file("mine"), drive);
  }

  std::string import(const std::string& more = "") const
  {
    return succeed("import csv mine -o mine.rawlog" + more);
  }
  /// Imports, runs and evaluates.
  json result(const std::string& more = "") const
  {
    import();
    return runAndEvaluate(more);
  }
  json runAndEvaluate(const std::string& more = "") const
  {
    succeed("run " + kConfig + " mine.rawlog -q -o out --set rbpf-slamot.particles=50" + more);
    return json::parse(succeed("evaluate out --json"));
  }
  std::string succeed(const std::string& arguments) const
  {
    const auto outcome = test::slamot(arguments, file(""));
    EXPECT_EQ(outcome.status, 0) << arguments << "\n" << outcome.text;
    return outcome.text;
  }

  StrangersFacts facts;
};

double rmse(const json& errors)
{
  const json& value = errors.at("position_rmse_m");
  return value.is_null() ? 1e9 : value.get<double>();
}

void expectMapped(const json& result, int posts)
{
  EXPECT_LT(rmse(result["robot"]["all"]), kRobot);
  EXPECT_EQ(result["landmarks"]["true"], posts);
  EXPECT_LT(result["landmarks"]["rmse_m"].get<double>(), kLandmarks);
}

void expectTracked(const json& target)
{
  SCOPED_TRACE("target " + target["id"].dump());
  EXPECT_LT(rmse(target["relative_at_sightings"]), kTarget);
  EXPECT_GT(target["tracked_fraction"].get<double>(), kTracked);
}

std::vector<int> idsOf(const json& targets)
{
  std::vector<int> ids;
  for (const json& t : targets) ids.push_back(t["id"].get<int>());
  return ids;
}

/// All numbers of a CSV file but for the header, by rows.
std::vector<std::vector<double>> numbers(const std::string& text)
{
  std::vector<std::vector<double>> rows;
  std::istringstream lines(text);
  std::string line, field;
  std::getline(lines, line);
  while (std::getline(lines, line))
  {
    rows.emplace_back();
    for (std::istringstream fields(line); std::getline(fields, field, ',');)
      rows.back().push_back(std::strtod(field.c_str(), nullptr));
  }
  return rows;
}
}  // namespace

TEST(OwnData, WithIdentitiesIsMappedAndTrackedUnderThem)
{
  const Guest guest({});
  const json result = guest.result();
  EXPECT_EQ(result["align"], "none") << "the start was given";
  expectMapped(result, guest.facts.posts);
  EXPECT_EQ(result["landmarks"]["mapped"], guest.facts.posts);
  EXPECT_EQ(result["association"]["wrong"], 0);
  EXPECT_EQ(idsOf(result["targets"]), (std::vector<int>{3, 7}));
  for (const json& target : result["targets"]) expectTracked(target);
}

TEST(OwnData, WithoutIdentitiesIsPairedByPlaceAndLabel)
{
  StrangersDrive drive;
  drive.landmarkIds = drive.targetIds = false;
  drive.targets = {{3, "red"}, {7, "blue"}};
  const Guest guest(drive);
  const json result = guest.result(kByPlace);
  expectMapped(result, guest.facts.posts);
  EXPECT_LE(result["landmarks"]["mapped"].get<int>(), guest.facts.posts + 2);
  for (const json& target : result["true_targets"]) expectTracked(target);
  for (const json& track : result["targets"]) EXPECT_FALSE(track["truth_id"].is_null()) << track;
}

TEST(OwnData, WithoutIdentitiesButWithTheWrongSettingIsExplained)
{
  StrangersDrive drive;
  drive.landmarkIds = false;
  drive.duration = 5;
  const Guest guest(drive);
  guest.import();
  const std::string text = guest.succeed("run " + kConfig + " mine.rawlog -o out");
  EXPECT_NE(text.find("slamot: warning: " + std::to_string(guest.facts.sightings) + " of " +
                      std::to_string(guest.facts.sightings) + " landmark sightings have no id"),
            std::string::npos)
      << text;
  EXPECT_NE(guest.read("out/report.html").find("--set rbpf-slamot.association=nn"),
            std::string::npos);
}

TEST(OwnData, WithoutAStartIsMappedFromTheOrigin)
{
  StrangersDrive drive;
  drive.robotStart = false;
  const Guest guest(drive);
  const json result = guest.result();
  EXPECT_EQ(result["align"], "first-pose");
  expectMapped(result, guest.facts.posts);
  for (const json& target : result["targets"]) expectTracked(target);
}

TEST(OwnData, TargetsStartWhereTheyAreSaidTo)
{
  StrangersDrive drive;
  drive.targetStarts = true;
  drive.blindFrom = -1, drive.blindTo = 1.2;  // the robot drives with nothing in sight at first
  const Guest guest(drive);
  const json result = guest.result();
  for (const json& target : result["targets"]) expectTracked(target);
  for (const char* name : {"out/target_3.tum", "out/target_7.tum"})
    EXPECT_EQ(guest.read(name).substr(0, 12), "0.000000000 ") << name;
}

TEST(OwnData, ScansThatSawNothingAreScans)
{
  StrangersDrive drive;
  drive.blindFrom = 20, drive.blindTo = 28;
  const Guest guest(drive);
  const std::string text = guest.import();
  const std::string scans = " in " + std::to_string(guest.facts.scans) + " scans, ";
  EXPECT_NE(text.find(" sightings" + scans), std::string::npos) << text;
  EXPECT_NE(text.find(" blobs" + scans), std::string::npos) << text;
  const json result = guest.runAndEvaluate();
  EXPECT_LT(rmse(result["robot"]["all"]), 1.0) << "it drove blind for 8 s";
  EXPECT_EQ(result["landmarks"]["true"], guest.facts.posts);
  EXPECT_EQ(idsOf(result["targets"]), (std::vector<int>{3, 7})) << "lost, and found again";
}

TEST(OwnData, WhatIsOutsideTheFieldOfViewIsDroppedAndCounted)
{
  StrangersDrive drive;
  drive.declaredRange = 5;
  const Guest guest(drive);
  const std::string dropped = std::to_string(guest.facts.outOfDeclaredView) + " dropped";
  const std::string text = guest.import();
  EXPECT_GT(guest.facts.outOfDeclaredView, 100);
  EXPECT_NE(text.find(", " + dropped + " ("), std::string::npos) << text;
  const json result = guest.runAndEvaluate();
  EXPECT_LT(rmse(result["robot"]["all"]), kRobot);
  EXPECT_LT(result["landmarks"]["rmse_m"].get<double>(), kLandmarks);
}

TEST(OwnData, BearingsAloneKeepTargets)
{
  StrangersDrive drive;
  drive.bearingsOnly = 0.5;
  const Guest guest(drive);
  const json result = guest.result();
  expectMapped(result, guest.facts.posts);
  EXPECT_EQ(idsOf(result["targets"]), (std::vector<int>{3, 7}));
  for (const json& target : result["targets"])
  {
    EXPECT_LT(rmse(target["relative_at_sightings"]), 4 * kTarget) << "without a range now and then";
    EXPECT_GT(target["tracked_fraction"].get<double>(), kTracked);
  }
}

TEST(OwnData, OdometryMayBeVelocitiesOrIncrements)
{
  StrangersDrive drive;
  const Guest velocities(drive);
  drive.increments = true;
  const Guest increments(drive);
  for (const Guest* guest : {&velocities, &increments})
  {
    guest->import();
    guest->succeed("run " SLAMOT_SOURCE_DIR "/config-ini/dead-reckoning.ini mine.rawlog -q -o out");
  }
  const auto a = numbers(velocities.read("out/robot.csv")),
             b = numbers(increments.read("out/robot.csv"));
  ASSERT_EQ(a.size(), b.size());
  // Nine decimals were written, and the increments' deviations are a little larger.
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    for (const std::size_t k : {0, 1, 2, 3}) ASSERT_NEAR(a[i][k], b[i][k], 1e-5) << i << " " << k;
    ASSERT_NEAR(a[i][9], b[i][9], 1e-3 * a[i][9]) << i;
  }
}

TEST(OwnData, ALongPauseIsOneStep)
{
  StrangersDrive drive;
  drive.pauseAt = 30;
  const Guest guest(drive);
  const json result = guest.result();
  expectMapped(result, guest.facts.posts);
  EXPECT_EQ(result["robot"]["all"]["steps"], guest.facts.steps + 1);
  EXPECT_EQ(numbers(guest.read("out/robot.csv")).back()[0], 60 - 0.1 + 60);
  for (const json& target : result["targets"]) expectTracked(target);
}

TEST(OwnData, TimesOfAnEpochChangeNothingElse)
{
  StrangersDrive drive;
  const Guest atZero(drive);
  drive.startTime = 1700000000;
  const Guest atEpoch(drive);
  const json expected = atZero.result();
  const auto refused = test::slamot("import csv mine -o mine.rawlog", atEpoch.file(""));
  EXPECT_EQ(refused.status, 4);
  EXPECT_NE(refused.text.find("--start-time"), std::string::npos) << refused.text;
  atEpoch.import(" --start-time 1700000000");
  const json result = atEpoch.runAndEvaluate();
  // Doubles so far from zero tell 0.2 us apart.
  EXPECT_NEAR(rmse(result["robot"]["all"]), rmse(expected["robot"]["all"]), 1e-3);
  EXPECT_EQ(idsOf(result["targets"]), idsOf(expected["targets"]));
  EXPECT_EQ(atEpoch.read("out/robot.tum").substr(0, 21), "1700000000.000000000 ");
}
}  // namespace slamot
