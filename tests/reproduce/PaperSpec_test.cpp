#include <slamot/core/Error.h>
#include <slamot/filters/registerAll.h>

#include "tinyPaper.h"

namespace slamot::reproduce::test
{
namespace
{
void expectError(const std::string& assignment, const std::string& part)
{
  const TinyPaper paper;
  try
  {
    (void)paper.spec({assignment});
    ADD_FAILURE() << assignment << " was taken";
  }
  catch (const core::Error& e)
  {
    EXPECT_EQ(e.status(), core::ExitStatus::kConfig) << e.what();
    const std::string what = e.what();
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_NE(what.find(part), std::string::npos) << assignment << " gave: " << what;
  }
}
}  // namespace

TEST(PaperSpec, ReadsSectionsClaimsAndPictures)
{
  const TinyPaper paper;
  const PaperSpec spec = paper.spec();
  EXPECT_EQ(spec.name, "tiny");
  ASSERT_EQ(spec.sections.size(), 3u);
  const Section& main = spec.sections[0];
  EXPECT_TRUE(main.isRun());
  EXPECT_EQ(main.study.seeds, 4);
  ASSERT_EQ(main.claims.size(), 2u);
  ASSERT_EQ(main.claims[0].parts.size(), 2u);
  EXPECT_EQ(main.claims[0].parts[1].label, "robot error among 3 landmarks");
  ASSERT_EQ(main.pictures.size(), 1u);
  EXPECT_EQ(main.pictures[0].cell.at("landmarks"), "8");
  EXPECT_FALSE(spec.sections[2].isRun());
  EXPECT_EQ(spec.sections[2].claims[0].untestable, "Nobody has its data.");
}

TEST(PaperSpec, QuickTakesItsOwnSettingsAndLeavesOutWhatIsNotInIt)
{
  const TinyPaper paper;
  const PaperSpec spec = paper.spec({}, true);
  EXPECT_EQ(spec.sections[0].study.seeds, 2);
  EXPECT_EQ(spec.sections[0].study.axes[0].values, std::vector<std::string>{"8"});
  EXPECT_TRUE(spec.sections[1].isLeftOut);
  EXPECT_FALSE(spec.sections[1].isRun());
}

TEST(PaperSpec, WhatIsSetCountsMoreThanWhatQuickSets)
{
  const TinyPaper paper;
  const PaperSpec spec = paper.spec({"section.main.set.study.seeds=3"}, true);
  EXPECT_EQ(spec.sections[0].study.seeds, 3);
  const std::vector<std::string> once{"vary.landmarks.values=8", "study.seeds=3"};
  EXPECT_TRUE(std::is_permutation(spec.sections[0].set.begin(), spec.sections[0].set.end(),
                                  once.begin(), once.end()));
}

TEST(PaperSpec, SetChangesASectionsStudy)
{
  const TinyPaper paper;
  const PaperSpec spec = paper.spec({"section.main.set.study.seeds=3"});
  EXPECT_EQ(spec.sections[0].study.seeds, 3);
  EXPECT_EQ(spec.sections[0].set, std::vector<std::string>{"study.seeds=3"});
  const PaperSpec seeded = PaperSpec::load(paper.file("reproduce.tiny.ini"), {false, {}, 77});
  EXPECT_EQ(seeded.sections[0].study.firstSeed, 77u);
}

TEST(PaperSpec, WrongValuesAreOneLineThatNamesFileSectionAndKey)
{
  expectError("paper.tilte=x",
              "reproduce.tiny.ini [paper] tilte: unknown key; did you mean title?");
  expectError("paper.sections=main, mian", "[paper] sections: there is no [section.mian]");
  expectError("paper.sections=main", "unknown section");
  expectError("section.main.study=none.ini", "[section.main] study: ");
  expectError("section.main.tables=errors, maps",
              "[section.main] tables: 'maps' is no table of its study; known: errors, ratios");
  expectError("section.main.folded=errors, errors", "[section.main] folded: errors comes twice");
  expectError("section.main.plots=nees", "[section.main] plots: 'nees' is no plot of its study");
  expectError("section.main.pictures=mop", "there is no [picture.mop]");
  expectError("section.main.claims=better, batter", "there is no [claim.batter]");
  expectError("section.less.claims=larger, better", "better is of another section, too");
  expectError("section.real.tables=errors", "[section.real] study: missing");
  expectError("section.main.set.study.sedes=3", "study.ini [study] sedes: unknown key");
  expectError("picture.map.kind=mop", "[picture.map] kind: 'mop' is not known");
  expectError("picture.map.method=nobody",
              "[picture.map] method: 'nobody' is no method of study.ini");
  expectError("picture.map.landmarks=9", "axis landmarks of study.ini has no value '9'");
  expectError("picture.map.landmraks=9", "[picture.map] landmraks: unknown key");
}

TEST(PaperSpec, WrongClaimsAreOneLineThatNamesFileSectionAndKey)
{
  const std::string key = "claim.better.when.1=";
  expectError(key + "robot_maen_m(joint) < 1",
              "reproduce.tiny.ini [claim.better] when.1: 'robot_maen_m' is no metric");
  expectError(key + "robot_mean_m(jiont) < 1", "'jiont' is no method of study.ini; known: joint");
  expectError(key + "robot_mean_m(joint, particles=3) < 1",
              "'particles' is not varied in study.ini");
  expectError(key + "robot_mean_m(joint, landmarks=4) < 1", "has no value '4'");
  expectError(key + "robot_mean_m(joint) <", "[claim.better] when.1: '' is no number");
  expectError(key + "robot_mean_m(joint) / robot_mean_m(joint, landmarks=3) < 1",
              "only some of its terms name a value of landmarks");
  expectError(key + "robot_rmse_over_pcrb(joint) / robot_rmse_m(joint) < 1",
              "a ratio to a bound can't be");
  expectError("claim.real.when.1=robot_mean_m(joint) < 1", "is given beside conditions");
  expectError("claim.real.untestable=", "[claim.real] untestable: missing");
  expectError("claim.better.waht.1=x", "[claim.better] waht.1: unknown key");
}

TEST(PaperSpec, ConditionsWithoutAStudyAreAnError)
{
  std::string text = TinyPaper::kPaper;
  text.replace(text.find("untestable"), text.size(), "when.1 = robot_mean_m(joint) < 1\n");
  const TinyPaper paper(text);
  try
  {
    (void)paper.spec();
    ADD_FAILURE() << "nothing thrown";
  }
  catch (const core::Error& e)
  {
    EXPECT_NE(std::string(e.what()).find("[claim.real] when.1: its section has no study"),
              std::string::npos)
        << e.what();
  }
}

TEST(PaperList, FindsByNameByPathAndInLists)
{
  const TinyPaper paper;
  const std::string folder = paper.file(".");
  EXPECT_EQ(PaperList::find("tiny", folder).files.size(), 1u);
  EXPECT_EQ(PaperList::find(paper.file("reproduce.tiny.ini"), "nowhere").files.size(), 1u);
  const PaperList all = PaperList::find("all", folder);
  EXPECT_EQ(all.title, "Tiny papers");
  EXPECT_EQ(all.files.size(), 1u);
  try
  {
    (void)PaperList::find("teeny", folder);
    ADD_FAILURE() << "nothing thrown";
  }
  catch (const core::Error& e)
  {
    EXPECT_STREQ(e.what(), "reproduce teeny: is not known; known: all, tiny");
  }
}
}  // namespace slamot::reproduce::test
