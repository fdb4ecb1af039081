#include "../results/TemporaryFolder.h"
#include "program.h"
#include "strangersData.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

// Every exit status, end to end, and what is left behind.
namespace slamot
{
namespace
{
namespace fs = std::filesystem;
using nlohmann::json;
using test::Outcome;
using test::TemporaryFolder;

const std::string kDeadReckoning = "run " SLAMOT_SOURCE_DIR "/config-ini/dead-reckoning.ini ";
const std::string kRbpf = "run " SLAMOT_SOURCE_DIR "/config-ini/rbpf-slamot.ini ";

/// A folder with a stranger's short drive in mine/ and mine.rawlog.
class Place : public TemporaryFolder
{
 public:
  explicit Place(double duration = 2)
  {
    test::StrangersDrive drive;
    drive.duration = duration;
    fs::create_directory(file("mine"));
    test::writeStrangersData(file("mine"), drive);
    EXPECT_EQ(slamot("import csv mine -q -o mine.rawlog").status, 0);
  }
  [[nodiscard]] Outcome slamot(const std::string& arguments) const
  {
    return test::slamot(arguments, file(""));
  }
  [[nodiscard]] json summary(const std::string& folder) const
  {
    return json::parse(read(folder + "/summary.json"));
  }
  /// The names of all that lies in the folder.
  [[nodiscard]] std::vector<std::string> names() const
  {
    std::vector<std::string> out;
    for (const auto& entry : fs::directory_iterator(file("")))
      out.push_back(entry.path().filename().string());
    std::sort(out.begin(), out.end());
    return out;
  }
  /// Runs a shell script; what it prints.
  [[nodiscard]] std::string shell(const std::string& script) const
  {
    write("script.sh", script);
    FILE* pipe = ::popen(("cd '" + file("") + "' && sh script.sh 2>&1").c_str(), "r");
    std::string text;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
    ::pclose(pipe);
    fs::remove(file("script.sh"));
    return text;
  }
};

/// One error line, and nothing new in the folder.
void expectRefused(const Place& place, const std::string& arguments, int status,
                   const std::string& about)
{
  SCOPED_TRACE(arguments);
  const auto before = place.names();
  const Outcome o = place.slamot(arguments);
  EXPECT_EQ(o.status, status) << o.text;
  EXPECT_TRUE(std::regex_match(o.text, std::regex("slamot: error: [^\n]+: [^\n]+; [^\n]+\n")))
      << o.text;
  EXPECT_NE(o.text.find(about), std::string::npos) << o.text;
  EXPECT_EQ(place.names(), before);
}
}  // namespace

TEST(ExitStatus, ZeroWhereAllIsDone)
{
  const Place place;
  for (const char* arguments :
       {"info mine.rawlog", "run mine.ini mine.rawlog -o out", "evaluate out",
        "render out -o a.png", "--version", "--help", "run --help"})
  {
    place.write("mine.ini", "[dead-reckoning]\n");
    const Outcome o = place.slamot(arguments);
    EXPECT_EQ(o.status, 0) << arguments << "\n" << o.text;
  }
  EXPECT_EQ(place.summary("out")["complete"], true);
}

TEST(ExitStatus, OneOnWhatTheUserTyped)
{
  const Place place;
  expectRefused(place, "", 1, "subcommand");
  expectRefused(place, "rnu a b", 1, "'rnu' is no command");
  expectRefused(place, "run", 1, "config");
  expectRefused(place, "import xml mine -o a.rawlog", 1, "xml");
  expectRefused(place, kRbpf + "mine.rawlog --sed 3", 1, "--sed");
  expectRefused(place, kRbpf + "mine.rawlog --seed 1e3", 1, "'1e3'");
  expectRefused(place, kRbpf + "mine.rawlog --seed 99999999999999999999", 1,
                "99999999999999999999");
  expectRefused(place, kRbpf + "mine.rawlog --set rbpf-slamot.particels=9", 1,
                "did you mean particles?");
  expectRefused(place, kRbpf + "mine.rawlog --set rbpf-slamot.particles=0", 1, "from 1 to");
  expectRefused(place, "run absent.ini mine.rawlog", 1, "absent.ini");
  expectRefused(place, "run mine.rawlog mine.rawlog", 1, "mine.rawlog");
}

TEST(ExitStatus, TwoOnWhatCannotBeRead)
{
  const Place place;
  place.write("text.rawlog", "no rawlog, surely\n");
  place.write("empty.rawlog", "");
  for (const char* name : {"absent.rawlog", "text.rawlog", "empty.rawlog", "mine"})
  {
    expectRefused(place, kRbpf + name, 2, name);
    expectRefused(place, std::string("info ") + name, 2, name);
  }
  expectRefused(place, "import csv absent -o a.rawlog", 2, "absent");
  expectRefused(place, "evaluate mine", 2, "mine");
  expectRefused(place, "render mine -o a.png", 2, "mine");
}

TEST(ExitStatus, ThreeOnInputThatEndsTooEarly)
{
  const Place place;
  const std::string whole = place.read("mine.rawlog");
  place.write("cut.rawlog", whole.substr(0, whole.size() / 2));
  expectRefused(place, kDeadReckoning + "cut.rawlog", 3, "cut.rawlog");
  const Outcome info = place.slamot("info cut.rawlog");
  EXPECT_EQ(info.status, 3) << info.text;
  const Outcome salvage = place.slamot(kDeadReckoning + "cut.rawlog --salvage -q -o out");
  EXPECT_EQ(salvage.status, 3) << salvage.text;
  EXPECT_EQ(place.summary("out")["complete"], false);
}

TEST(ExitStatus, FourOnValuesThatMakeNoSense)
{
  const Place place;
  const std::string whole = place.read("mine.rawlog");
  place.write("back.rawlog", whole + whole);  // starts anew in the middle, which gz allows
  expectRefused(place, kDeadReckoning + "back.rawlog", 4, "back.rawlog entry");
  EXPECT_EQ(place.slamot("info back.rawlog").status, 4);
  place.write("mine/blobs.csv",
              "t,label,range,bearing,std_range,std_bearing,id\n0.5,a,2,0.1,-1,0.1,3\n");
  expectRefused(place, "import csv mine -o a.rawlog", 4, "blobs.csv line 2: column std_range");
}

TEST(ExitStatus, FiveOnALimit)
{
  const Place place;
  place.write("mine/start.csv", std::string(2u << 20, 'x'));
  expectRefused(place, "import csv mine -o a.rawlog", 5, "start.csv line 1");
  place.write("faulty.ini", "[faulty]\nfault = memory\n");
  const Outcome o =
      place.slamot("run faulty.ini mine.rawlog -q -o out -p '" SLAMOT_FAULTY_FILTER "'");
  EXPECT_EQ(o.status, 5);
  EXPECT_EQ(o.text, "slamot: error: memory: exhausted; use a smaller input or fewer particles\n");
}

TEST(ExitStatus, SixOnAFaultOfTheProgramAndKeepsWhatItHad)
{
  const Place place;
  place.write("faulty.ini", "[faulty]\nfault = bug\n");
  const Outcome o =
      place.slamot("run faulty.ini mine.rawlog -q -o out -p '" SLAMOT_FAULTY_FILTER "'");
  EXPECT_EQ(o.status, 6);
  EXPECT_EQ(o.text, "slamot: error: internal: index 7 of 7; please report it\n");
  EXPECT_EQ(place.summary("out")["complete"], false);
  EXPECT_EQ(place.summary("out")["steps"], 2);
}

// The import waits for rows from a pipe, so that the signal comes while it is under way.
TEST(ExitStatus, AnInterruptedImportLeavesNothing)
{
  const Place place;
  fs::rename(place.file("mine/odometry.csv"), place.file("rows.csv"));
  const auto before = place.names();
  const std::string text = place.shell(
      "mkfifo mine/odometry.csv\n"
      "'" SLAMOT_PROGRAM
      "' import csv mine -o late.rawlog &\n"
      "exec 3> mine/odometry.csv\ncat rows.csv >&3\nkill -INT $!\nexec 3>&-\n"
      "wait $!\necho status $?\nrm mine/odometry.csv\n");
  EXPECT_EQ(text, "status 130\n");
  EXPECT_EQ(place.names(), before);
}

TEST(ExitStatus, AnInterruptedRunLeavesAMarkedResultAndPlainProgressLines)
{
  const Place place(60);
  // 40000 particles take half a minute; the signal comes after the first line of progress.
  const std::string text =
      place.shell("'" SLAMOT_PROGRAM "' " + kRbpf +
                  "mine.rawlog --set rbpf-slamot.particles=40000 -o out > said 2>&1 &\n"
                  "for i in $(seq 600); do grep -qs % said && break; sleep 0.1; done\n"
                  "kill -INT $!\nwait $!\necho status $?\n");
  EXPECT_EQ(text, "status 130\n");
  const std::string said = place.read("said");
  EXPECT_TRUE(std::regex_search(
      said, std::regex("^slamot: +[0-9]+%  [0-9]+ steps, [0-9]+/s(, [^\n]+ left)?\n")))
      << said;
  EXPECT_EQ(said.find_first_of("\r\x1b"), std::string::npos) << said;
  const json summary = place.summary("out");
  EXPECT_EQ(summary["complete"], false);
  EXPECT_GT(summary["steps"], 0);
  EXPECT_LT(summary["steps"], 600);
  EXPECT_NE(place.read("out/report.html").find("INCOMPLETE"), std::string::npos);
  EXPECT_TRUE(fs::exists(place.file("out/scene.3Dscene")));
}
}  // namespace slamot
