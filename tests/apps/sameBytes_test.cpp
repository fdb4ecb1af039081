#include "../results/TemporaryFolder.h"
#include "program.h"
#include "strangersData.h"

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

// The same seed gives the same bytes, twice in a row and for any number of threads.
namespace slamot
{
namespace
{
namespace fs = std::filesystem;
using test::TemporaryFolder;

const std::string kSource = SLAMOT_SOURCE_DIR;

void succeed(const TemporaryFolder& folder, const std::string& arguments)
{
  const auto outcome = test::slamot(arguments, folder.file(""));
  ASSERT_EQ(outcome.status, 0) << arguments << "\n" << outcome.text;
}

/// All files of a result by name.  Of summary.json, without `timing`: the time that a run took and
/// its memory are of that run, and stand nowhere else.
std::map<std::string, std::string> filesOf(const TemporaryFolder& folder, const std::string& result)
{
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder.file(result)))
  {
    if (!entry.is_regular_file()) continue;
    const std::string name = fs::relative(entry, folder.file(result)).string();
    files[name] = folder.read(result + "/" + name);
  }
  auto summary = nlohmann::ordered_json::parse(files.at("summary.json"));
  EXPECT_EQ(summary.erase("timing"), 1u);
  files["summary.json"] = summary.dump();
  return files;
}

using Runs = std::vector<const char*>;  // each the number of threads and a letter

void expectSameBytes(const TemporaryFolder& folder, const std::string& run,
                     const Runs& runs = {"1a", "2a", "3a", "1b"})
{
  std::map<std::string, std::string> first;
  for (const std::string out : runs)
  {
    succeed(folder,
            run + " --set rbpf-slamot.particles=64 --seed 5 -q --threads " + out[0] + " -o " + out);
    const auto files = filesOf(folder, out);
    if (first.empty()) first = files;
    ASSERT_EQ(files.size(), first.size());
    for (const auto& [name, bytes] : first)
      EXPECT_TRUE(files.at(name) == bytes) << name << " of " << run << ", " << out;
  }
  for (const char* name : {"robot.tum", "robot.csv", "landmarks.csv", "scene.3Dscene",
                           "report.html", "config.ini", "summary.json"})
    EXPECT_EQ(first.count(name), 1u) << name;
}

void expectSameFile(const TemporaryFolder& folder, const std::string& a, const std::string& b)
{
  const std::string bytes = folder.read(a);
  EXPECT_FALSE(bytes.empty()) << a;
  EXPECT_TRUE(bytes == folder.read(b)) << a << " and " << b;
}
}  // namespace

TEST(SameBytes, OfTheShippedExperiment)
{
  const TemporaryFolder folder;
  expectSameBytes(folder,
                  "run '" + kSource + "/config-ini/rbpf-slamot.experiment1.ini' '" + kSource +
                      "/share/datasets/experiment1.rawlog'",
                  {"1a", "1b", "2a", "2b", "3a", "3b"});
  for (const char* out : {"1a", "3b"})
    succeed(folder, "render " + std::string(out) + " -o " + out + ".png");
  expectSameFile(folder, "1a.png", "3b.png");
}

TEST(SameBytes, OfADriveAmongPostsWithoutIdentity)
{
  expectSameBytes(TemporaryFolder(), "run '" + kSource +
                                         "/config-ini/rbpf-slamot.post-field.ini' '" + kSource +
                                         "/share/datasets/post-field.rawlog'");
}

TEST(SameBytes, OfAStrangersDataFromTheFolderOn)
{
  const TemporaryFolder folder;
  test::StrangersDrive drive;
  drive.landmarkIds = drive.targetIds = false;
  drive.duration = 20;
  fs::create_directory(folder.file("mine"));
  test::writeStrangersData(folder.file("mine"), drive);
  for (const char* name : {"mine", "again"})
    succeed(folder, std::string("import csv mine -q -o ") + name + ".rawlog");
  expectSameFile(folder, "mine.rawlog", "again.rawlog");
  expectSameFile(folder, "mine.truth/robot.tum", "again.truth/robot.tum");
  expectSameBytes(folder, "run '" + kSource +
                              "/config-ini/rbpf-slamot.ini' mine.rawlog "
                              "--set rbpf-slamot.association=nn");
}

TEST(SameBytes, OfASimulation)
{
  const TemporaryFolder folder;
  for (const char* name : {"a", "b"})
    succeed(folder, "simulate '" + kSource + "/config-ini/sim.experiment1.ini' -q --seed 3 -o " +
                        name + ".rawlog");
  expectSameFile(folder, "a.rawlog", "b.rawlog");
  for (const char* name : {"robot.tum", "target_1.tum", "landmarks.csv", "associations.csv"})
    expectSameFile(folder, std::string("a.truth/") + name, std::string("b.truth/") + name);
}
}  // namespace slamot
