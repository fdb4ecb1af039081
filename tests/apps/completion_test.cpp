#include "../results/TemporaryFolder.h"
#include "program.h"

#include <set>
#include <sstream>

// What the program tells shells; how they use it is in completions.sh.
namespace slamot
{
namespace
{
const std::string kConfig = SLAMOT_SOURCE_DIR "/config-ini/rbpf-slamot.experiment1.ini ";
using Words = std::set<std::string>;

/// What is proposed for words of a command line, the last of them typed just now.
Words propose(const std::string& words, bool withTexts = false)
{
  const test::Outcome o = test::slamot("__complete - " + words);
  EXPECT_EQ(o.status, 0) << o.text;
  Words out;
  std::istringstream in(o.text);
  for (std::string line; std::getline(in, line);)
    out.insert(withTexts || line[0] == ':' ? line : line.substr(0, line.find('\t')));
  return out;
}
}  // namespace

TEST(Completion, ProposesTheCommandsOfTheHelp)
{
  const Words commands = propose("''");
  const std::string help = test::slamot("--help").text;
  EXPECT_GE(commands.size(), 11u);
  for (const std::string& command : commands)
    EXPECT_NE(help.find("\n  " + command + " "), std::string::npos) << command;
  EXPECT_EQ(propose("si"), Words{"simulate"});
  EXPECT_EQ(propose("r"), (Words{"render", "reproduce", "robot", "run"}));
  EXPECT_EQ(propose("--v"), Words{"--version"});
}

TEST(Completion, TellsWhatEachWordIs)
{
  EXPECT_EQ(propose("si", true),
            Words{"simulate\tWrite a rawlog and its ground truth from a scenario"});
  EXPECT_EQ(propose("run --sal", true),
            Words{"--salvage\tUse the intact first part of a truncated log"});
}

TEST(Completion, ProposesFilesByWhatAValueIsCalled)
{
  EXPECT_EQ(propose("run ''"), Words{":files\t*.ini"});
  EXPECT_EQ(propose("run a.ini ''"), Words{":files\t*.rawlog"});
  EXPECT_EQ(propose("run a.ini b.rawlog ''"), Words{});
  EXPECT_EQ(propose("team a.ini b.rawlog c.rawlog ''"), Words{":files\t*.rawlog"});
  EXPECT_EQ(propose("render r -o ''"), (Words{":files\t*.mp4", ":files\t*.png"}));
  EXPECT_EQ(propose("render ''"), Words{":files\t*"});
  EXPECT_EQ(propose("run -p ''"), Words{":files\t*.so"});
  EXPECT_EQ(propose("run -o ''"), Words{":folders\t*"});
  EXPECT_EQ(propose("run --seed ''"), Words{});
  EXPECT_EQ(propose("reproduce ''"), (Words{"all", "ekf-slamot-ci", "fastslam-family", "glint",
                                            "rbpf-slamot", ":files\t*.ini"}));
}

TEST(Completion, ProposesAnOptionsFewValues)
{
  const Words aligns = {"first-pose", "none", "rigid"};
  EXPECT_EQ(propose("run --align ''"), aligns);
  EXPECT_EQ(propose("run --align=r"), Words{"--align=rigid"});
  EXPECT_EQ(propose("import sc"), Words{"scaled-cars"});
  EXPECT_EQ(propose("import scaled-cars x --heading i"), Words{"imu"});
}

TEST(Completion, ProposesAnOptionAgainOnlyWhereItMayCome)
{
  EXPECT_EQ(propose("run --se"), (Words{"--seed", "--set"}));
  EXPECT_EQ(propose("run --seed 3 --set a.b=c --se"), Words{"--set"});
  EXPECT_EQ(propose("run --seed=3 --se"), Words{"--set"});
}

TEST(Completion, ProposesTheOptionsOfTheKindThatIsImported)
{
  EXPECT_EQ(propose("import --rob"), Words{"--robot"});
  EXPECT_EQ(propose("import mrclam --rob"), Words{"--robot"});
  EXPECT_EQ(propose("import carmen --rob"), Words{});
  EXPECT_EQ(propose("import carmen --std-slip"), Words{"--std-slip"});  // of several kinds
}

TEST(Completion, KnowsTheKeysOfAConfigurationAndOfItsMethod)
{
  const Words keys = propose("run " + kConfig + "--set ''");
  EXPECT_EQ(keys.count("rbpf-slamot.particles="), 1u);   // in the file
  EXPECT_EQ(keys.count("rbpf-slamot.map_update="), 1u);  // not there: the filter knows it
  EXPECT_EQ(keys.count("run.seed="), 1u);                // nor there
  EXPECT_EQ(keys.count("ekf-slamot.association="), 0u);  // of another method
  EXPECT_EQ(propose("run " + kConfig + "--set rbpf-slamot.partic"),
            Words{"rbpf-slamot.particles="});
  EXPECT_EQ(propose("run --set ekf-slamot.assoc"), Words{"ekf-slamot.association="});
}

TEST(Completion, KnowsTheValuesThatAKeyMayHave)
{
  const std::string set = "run " + kConfig + "--set ";
  const Words found = propose(set + "rbpf-slamot.association=j");
  EXPECT_EQ(found, (Words{"rbpf-slamot.association=jcbb", "rbpf-slamot.association=jml"}));
  EXPECT_EQ(propose(set + "run.method=ekf"), Words{"run.method=ekf-slamot"});
  EXPECT_EQ(propose(set + "rbpf-slamot.particles="), Words{"rbpf-slamot.particles=200"});
}

TEST(Completion, IsSilentWhereItKnowsNothing)
{
  const test::TemporaryFolder folder;
  folder.write("broken.ini", "[rbpf-slamot\nparticles");
  for (const char* words :
       {"", "rnu ''", "rnu a --", "run --bad ''", "run --seed 3x -", "run absent.ini --set x.y=",
        "run --set =", "run --set .=", "run --set x=", "run a b c d e ''"})
    EXPECT_EQ(test::slamot(std::string("__complete - ") + words).text.find("slamot: error"),
              std::string::npos)
        << words;
  EXPECT_EQ(propose("run " + folder.file("broken.ini") + " --set rbpf"), Words{});
}
}  // namespace slamot
