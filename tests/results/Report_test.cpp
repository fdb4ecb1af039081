#include "TemporaryFolder.h"
#include "sampleRun.h"

#include <gmock/gmock.h>
#include <slamot/results/Report.h>

#include <algorithm>
#include <regex>
#include <set>

namespace slamot::results
{
namespace
{
using test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::Not;

struct Page
{
  std::string html, warning;
};

Page pageOf(const SampleRun& run, const std::string& dataset = "a.rawlog")
{
  const TemporaryFolder folder;
  const RunInfo info{"rbpf-slamot", dataset, 7, "[rbpf-slamot]\nparticles = 200\n"};
  Page page;
  page.warning = writeReport(folder.file("report.html"), info, run.view());
  page.html = folder.read("report.html");
  return page;
}

std::size_t countOf(const std::string& text, const std::string& what)
{
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(Report, NeedsNothingButItself)
{
  const Page page = pageOf(sampleRun());
  EXPECT_EQ(page.warning, "");
  EXPECT_EQ(countOf(page.html, "<svg"), 5u);
  for (const char* reference : {"http", "src=", "@import", "<link", "<script", "file:", "url("})
    EXPECT_THAT(page.html, Not(HasSubstr(reference)));
  EXPECT_EQ(countOf(page.html, "href="), countOf(page.html, "href='#"));
}

TEST(Report, SameRunGivesTheSameBytes)
{
  EXPECT_EQ(pageOf(sampleRun()).html, pageOf(sampleRun()).html);
}

TEST(Report, NamesInItAreUniqueAndReferencesLeadSomewhere)
{
  const std::string html = pageOf(sampleRun()).html;
  std::multiset<std::string> ids;
  const std::regex id(" id=['\"]([^'\"]+)['\"]"), reference("href='#([^']+)'");
  for (std::sregex_iterator i(html.begin(), html.end(), id), end; i != end; ++i)
    ids.insert((*i)[1]);
  ASSERT_FALSE(ids.empty());
  EXPECT_EQ(ids.size(), std::set<std::string>(ids.begin(), ids.end()).size());
  for (std::sregex_iterator i(html.begin(), html.end(), reference), end; i != end; ++i)
    EXPECT_EQ(ids.count((*i)[1]), 1u) << (*i)[1];
}

TEST(Report, ColoursOfPlotsFollowThePage)
{
  const std::string html = pageOf(sampleRun()).html;
  const std::string plots = html.substr(html.find("<body"));
  EXPECT_THAT(plots, HasSubstr("var(--ink-blue)"));
  EXPECT_THAT(plots, HasSubstr("var(--ink-text)"));
  EXPECT_EQ(countOf(plots, "rgb("), 0u);
  EXPECT_EQ(countOf(plots, "'black'") + countOf(plots, "fill=\"black\""), 0u);
}

TEST(Report, TellsAnIncompleteRun)
{
  SampleRun run = sampleRun();
  EXPECT_THAT(pageOf(run).html, Not(HasSubstr("INCOMPLETE")));
  run.record.complete = false;
  EXPECT_THAT(pageOf(run).html, HasSubstr("INCOMPLETE"));
}

TEST(Report, ShowsKeyNumbersWithUnits)
{
  const std::string html = pageOf(sampleRun()).html;
  for (const char* shown : {"0.0393", "0.0421", "93.4", "[m]", "[deg]", "seed 7", "particles = 200",
                            "801 correctly, 3 wrongly", "200, resampled 40 times"})
    EXPECT_THAT(html, HasSubstr(shown));
}

TEST(Report, TakesNamesLiterally)
{
  const Page page = pageOf(sampleRun(), "folder/<b>&\"x\".rawlog");
  EXPECT_THAT(page.html, HasSubstr("&lt;b&gt;&amp;&quot;x&quot;.rawlog"));
  EXPECT_THAT(page.html, Not(HasSubstr("<b>")));
}

TEST(Report, DoesWithoutTruth)
{
  SampleRun run = sampleRun();
  run.truth = {};
  run.evaluation = {};
  const std::string html = pageOf(run).html;
  EXPECT_THAT(html, HasSubstr("No ground truth"));
  EXPECT_EQ(countOf(html, "<svg"), 2u);  // map and effective sample size
}

// A target without identity that was lost comes back under another number.
SampleRun sampleInTwoTracks()
{
  SampleRun run = sampleRun();
  eval::TargetTrack& first = run.record.targets[0];
  first.identified = false, first.label = "mate", first.id = 0;
  eval::TargetTrack second = first;
  second.id = 1;
  first.rows.resize(100);
  second.rows.erase(second.rows.begin(), second.rows.begin() + 200);
  run.record.targets.push_back(second);
  eval::TargetTrack wrong = second;
  wrong.id = 2;
  run.record.targets.push_back(wrong);
  run.evaluation.targets.resize(3, run.evaluation.targets[0]);
  run.evaluation.targets[0].steps.resize(100);
  auto& steps = run.evaluation.targets[1].steps;
  steps.erase(steps.begin(), steps.begin() + 200);
  run.evaluation.targets[2] = {};
  return run;
}

TEST(Report, ShowsATrueTargetOnceWithAllItsTracks)
{
  const SampleRun run = sampleInTwoTracks();
  const std::string html = pageOf(run).html;
  EXPECT_EQ(countOf(html, "<svg"), 5u);
  EXPECT_EQ(countOf(html, "Errors of mate"), countOf(html, "Errors of the robot"));
  EXPECT_THAT(html, HasSubstr("tracks 0, 1"));
  EXPECT_THAT(html, HasSubstr("track 2"));
  const std::string table = summaryTable(run.record, run.evaluation);
  EXPECT_THAT(table, HasSubstr("tracked                 100.0% of its steps, tracks 0, 1\n"));
  EXPECT_THAT(table, HasSubstr("of no true target: track 2\n"));
}

TEST(Report, DoesWithoutAnything)
{
  const SampleRun empty;
  EXPECT_EQ(countOf(pageOf(empty).html, "<svg"), 1u);
}

TEST(Report, IsMadeWithoutGnuplotToo)
{
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const Page page = pageOf(sampleRun());
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(page.warning, HasSubstr("install gnuplot-nox"));
  EXPECT_THAT(page.html, HasSubstr("This plot is missing"));
  EXPECT_THAT(page.html, HasSubstr("0.0393"));
  EXPECT_EQ(countOf(page.html, "<svg"), 0u);
}

TEST(Report, StaysSmallForLongRuns)
{
  EXPECT_LT(pageOf(sampleRun(40000)).html.size(), 2u << 20);
}
}  // namespace
}  // namespace slamot::results
