#include <slamot/core/Error.h>
#include <slamot/filters/registerAll.h>

#include <filesystem>
#include <regex>
#include <set>

#include "tinyPaper.h"

namespace slamot::reproduce::test
{
namespace
{
class Reproduce : public ::testing::Test
{
 protected:
  Reproduce() { filters::registerAll(); }

  std::vector<study::ExecuteResult> run(const Reproduction& all, const std::string& out,
                                        const study::ExecuteOptions& options = {}) const
  {
    return study::execute(all.jobs(paper.file(out)), options);
  }
  /// The page from records in `from`, made in `out`.
  std::string page(Reproduction& all, const std::string& out,
                   const std::vector<std::string>& from) const
  {
    std::vector<std::string> folders;
    for (const std::string& f : from) folders.push_back(paper.file(f));
    all.collect(folders);
    EXPECT_TRUE(all.draw(paper.file(out), nullptr));
    EXPECT_EQ(all.publish(paper.file(out)), "");
    return paper.read(out + "/reproduction.html");
  }

  TinyPaper paper;
};

/// Without the section of times, the one part that tells who ran it.
std::string withoutCost(const std::string& page)
{
  const auto at = page.find("<h2 id=\"cost\">");
  EXPECT_NE(at, std::string::npos);
  return page.substr(0, at);
}

/// The HTML of a claim's box.
std::string boxOf(const std::string& page, const std::string& id)
{
  const auto at = page.find("id=\"" + id + "\"");
  EXPECT_NE(at, std::string::npos) << id;
  const auto from = page.rfind("<section", at);
  return page.substr(from, page.find("</section>", at) - from);
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}
}  // namespace

TEST_F(Reproduce, SectionsOfOneStudyShareItsRuns)
{
  const Reproduction all = paper.reproduction();
  ASSERT_EQ(all.studies().size(), 1u);
  EXPECT_EQ(all.studyOf(0, 0), all.studyOf(0, 1));
  EXPECT_EQ(all.studyOf(0, 2), nullptr);
  const Reproduction parted =
      paper.reproduction(false, {"section.less.set.method.joint.rbpf-slamot.particles=7"});
  ASSERT_EQ(parted.studies().size(), 2u);
  EXPECT_NE(parted.studies()[0].folder, parted.studies()[1].folder);
}

TEST_F(Reproduce, SectionsWithTheSameSettingsShareTheirRunsAndOthersDoNot)
{
  const auto& folder = paper.study().folder();
  std::filesystem::create_directories(paper.file("other"));
  for (const char* file : {"study.ini", "world.ini", "filter.ini", "odometry.ini"})
    std::filesystem::copy(paper.file(file), paper.file(std::string("other/") + file));
  folder.write("reproduce.more.ini",
               "[paper]\ntitle = More\ncitation = Nobody.\nsections = a, b, c, d\n"
               "[section.a]\nstudy = study.ini\n[section.b]\nstudy = study.ini\n"
               "set.study.seeds = 2\n[section.c]\nstudy = study.ini\nset.study.seeds = 2\n"
               "[section.d]\nstudy = other/study.ini\n");
  const Reproduction all("more", paper.file("."), {});
  ASSERT_EQ(all.studies().size(), 3u);
  EXPECT_EQ(all.studyOf(0, 1), all.studyOf(0, 2));
  std::set<std::string> folders;
  for (const StudyRun& s : all.studies()) folders.insert(s.folder);
  EXPECT_EQ(folders.size(), 3u);
}

TEST_F(Reproduce, PageHoldsTablesFiguresAndVerdicts)
{
  Reproduction all = paper.reproduction();
  run(all, "out");
  const std::string html = page(all, "out", {"out"});
  EXPECT_TRUE(contains(boxOf(html, "tiny-better"), "holds in part"));
  EXPECT_TRUE(contains(boxOf(html, "tiny-better"), "✗ failed"));
  EXPECT_TRUE(contains(boxOf(html, "tiny-better"), "robot error among 3 landmarks"));
  EXPECT_TRUE(contains(boxOf(html, "tiny-printed"), "published 0.01 (1e-06)"));
  EXPECT_TRUE(contains(boxOf(html, "tiny-printed"), "does not hold"));
  EXPECT_TRUE(contains(boxOf(html, "tiny-larger"), "✓</span> holds"));
  EXPECT_TRUE(contains(boxOf(html, "tiny-real"), "not testable"));
  EXPECT_TRUE(contains(boxOf(html, "tiny-real"), "Nobody has its data."));
  EXPECT_TRUE(contains(html, "<tr class=\"published\">"));
  EXPECT_TRUE(contains(html, "&quot;Nothing&quot; &lt;2013&gt;"));
  EXPECT_TRUE(contains(html, "slamot study study.ini"));
  std::size_t pictures = 0;
  for (std::size_t at = 0; (at = html.find("<svg ", at)) != std::string::npos; ++at) ++pictures;
  EXPECT_EQ(pictures, 2u);
  EXPECT_FALSE(contains(html, "INCOMPLETE"));
  EXPECT_FALSE(contains(html, "class=\"notice\""));
  EXPECT_TRUE(contains(paper.read("out/study/table.md"), "# Tiny"));
}

TEST_F(Reproduce, PageNeedsNothingButItself)
{
  Reproduction all = paper.reproduction();
  run(all, "out");
  const std::string html = page(all, "out", {"out"});
  EXPECT_FALSE(std::regex_search(html, std::regex("(src|xmlns|xlink:href)\\s*=")));
  EXPECT_FALSE(
      std::regex_search(html, std::regex("https?:|@import|url\\((?!['\"]?#)|<script|<link")));
  const std::regex href("href\\s*=\\s*['\"]([^'\"]*)");
  std::size_t links = 0;
  for (std::sregex_iterator it(html.begin(), html.end(), href), end; it != end; ++it, ++links)
  {
    const std::string to = (*it)[1];
    ASSERT_EQ(to.substr(0, 1), "#") << to;
    EXPECT_TRUE(std::regex_search(html, std::regex("id=['\"]" + to.substr(1) + "['\"]"))) << to;
  }
  EXPECT_GE(links, 4u);                          // one for each claim
  EXPECT_FALSE(contains(html, paper.file("")));  // no path of this machine
}

TEST_F(Reproduce, PageDoesNotDependOnThreadsOrShards)
{
  Reproduction all = paper.reproduction();
  run(all, "one");
  const std::string expected = withoutCost(page(all, "one", {"one"}));
  study::ExecuteOptions threads;
  threads.threads = 3;
  run(all, "threads", threads);
  EXPECT_EQ(withoutCost(page(all, "threads", {"threads"})), expected);
  for (const int shard : {1, 2})
  {
    study::ExecuteOptions options;
    options.shard = shard;
    options.shards = 2;
    run(all, "shard" + std::to_string(shard), options);
  }
  EXPECT_EQ(withoutCost(page(all, "merged", {"shard1", "shard2"})), expected);
  // From the same records, the times are the same, too.
  EXPECT_EQ(page(all, "again", {"shard2", "shard1"}), page(all, "merged", {"shard1", "shard2"}));
}

TEST_F(Reproduce, MissingRunsAreSaidAndNothingHoldsByThem)
{
  Reproduction all = paper.reproduction();
  study::ExecuteOptions options;
  options.shard = 1;
  options.shards = 16;
  run(all, "out", options);
  const std::string html = page(all, "out", {"out"});
  EXPECT_TRUE(contains(html, "INCOMPLETE: 15 runs are missing."));
  EXPECT_EQ(all.missing(), 15u);
  EXPECT_FALSE(contains(boxOf(html, "tiny-larger"), "✓</span> holds"));
}

TEST_F(Reproduce, QuickSaysSoAndWhatItLeavesOut)
{
  Reproduction all = paper.reproduction(true);
  for (const auto& result : run(all, "out")) EXPECT_EQ(result.runs, 4u);
  const std::string html = page(all, "out", {"out"});
  EXPECT_TRUE(contains(html, "Quick: 2 seeds a cell"));
  EXPECT_TRUE(contains(html, "Left out of the quick reproduction."));
  EXPECT_TRUE(contains(boxOf(html, "tiny-larger"), "not run"));
  EXPECT_TRUE(contains(boxOf(html, "tiny-better"), "left out"));
  EXPECT_TRUE(contains(html, "--set study.seeds=2 --set vary.landmarks.values=8"));
}

TEST_F(Reproduce, PicturesAreKeptAndMadeAnewForOtherSettings)
{
  namespace fs = std::filesystem;
  Reproduction all = paper.reproduction();
  ASSERT_TRUE(all.draw(paper.file("out"), nullptr));
  const auto files = [&]
  {
    std::vector<std::string> out;
    for (const auto& entry : fs::directory_iterator(paper.file("out/study/pictures")))
      if (entry.path().extension() == ".svg") out.push_back(entry.path().filename().string());
    return out;
  };
  ASSERT_EQ(files().size(), 1u);
  // A kept one is taken as it is.
  const std::string kept = "out/study/pictures/" + files()[0];
  paper.study().folder().write(kept, "<svg>kept</svg>\n");
  ASSERT_TRUE(all.draw(paper.file("out"), nullptr));
  EXPECT_EQ(all.picturesOf(0, 0).at(0).titlesAndImages.at(0).second, "<svg>kept</svg>\n");
  // A damaged one is made anew, and so is that of another filter.
  paper.study().folder().write(kept, "<svg>half");
  ASSERT_TRUE(all.draw(paper.file("out"), nullptr));
  EXPECT_TRUE(contains(paper.read(kept), "</svg>"));
  Reproduction other =
      paper.reproduction(false, {"section.main.set.method.joint.rbpf-slamot.particles=7"});
  ASSERT_TRUE(other.draw(paper.file("out"), nullptr));
  EXPECT_EQ(files().size(), 2u);
  const std::atomic<bool> stop{true};
  EXPECT_FALSE(all.draw(paper.file("out"), &stop));
}

TEST_F(Reproduce, EachPaperOfAListHasAFolderOfItsOwn)
{
  const Reproduction all("all", paper.file("."), {});
  EXPECT_EQ(all.title(), "Tiny papers");
  ASSERT_EQ(all.studies().size(), 1u);
  EXPECT_EQ(all.studies()[0].folder, "tiny/study");
}

TEST_F(Reproduce, OfSeveralPapersThoseThatHaveASectionAreSet)
{
  paper.study().folder().write("reproduce.other.ini",
                               "[paper]\ntitle = Other\ncitation = x\nsections = only\n"
                               "[section.only]\nstudy = study.ini\n");
  paper.study().folder().write("reproduce.both.ini",
                               "[papers]\ntitle = Both\nfiles = reproduce.tiny.ini, "
                               "reproduce.other.ini\n");
  const Reproduction both("both", paper.file("."),
                          {false, {"section.only.set.study.seeds=3"}, std::nullopt});
  EXPECT_EQ(both.papers()[0].sections[0].study.seeds, 4);
  EXPECT_EQ(both.papers()[1].sections[0].study.seeds, 3);
  try
  {
    const Reproduction none("both", paper.file("."), {false, {"section.nil.x=3"}, std::nullopt});
    ADD_FAILURE() << "nothing thrown";
  }
  catch (const core::Error& e)
  {
    EXPECT_EQ(std::string(e.what()).rfind("--set section.nil.x=3: no paper has such a section", 0),
              0u)
        << e.what();
  }
}
}  // namespace slamot::reproduce::test
