#include <gtest/gtest.h>
#include <slamot/filters/registerAll.h>
#include <slamot/reproduce/Reproduction.h>
#include <slamot/reproduce/judge.h>
#include <slamot/scans/registerAll.h>

#include <algorithm>
#include <set>

namespace slamot::reproduce::test
{
namespace
{
const std::string kConfigs = std::string(SLAMOT_SOURCE_DIR) + "/config-ini";

/// With the fewest seeds; laying it out checks every study, claim and picture.
Reproduction shipped(bool isQuick)
{
  filters::registerAll();
  scans::registerAll();
  Reproduction::Options options;
  options.isQuick = isQuick;
  return {"all", kConfigs, options};
}
}  // namespace

TEST(ShippedReproductions, LoadAndNameWhatThereIs)
{
  const Reproduction all = shipped(false);
  std::set<std::string> names;
  for (const PaperSpec& paper : all.papers())
  {
    EXPECT_TRUE(names.insert(paper.name).second);
    EXPECT_FALSE(paper.citation.empty());
    bool isJudged = false;
    for (const Section& section : paper.sections)
      for (const Claim& claim : section.claims) isJudged = isJudged || !claim.parts.empty();
    EXPECT_TRUE(isJudged) << paper.name;
  }
  for (const char* name : {"rbpf-slamot", "ekf-slamot-ci", "fastslam-family", "glint"})
    EXPECT_EQ(names.count(name), 1u) << name;
}

TEST(ShippedReproductions, PublishedFiguresAreOfCellsThatThereAre)
{
  const Reproduction all = shipped(false);
  for (const StudyRun& run : all.studies())
    for (const study::Published& p : run.plan->spec.published)
      for (const auto& [name, value] : p.byAxis)
      {
        bool isThere = false;
        for (const study::Axis& axis : run.plan->spec.axes)
          if (axis.name == name)
            isThere = std::count(axis.values.begin(), axis.values.end(), value) == 1;
        EXPECT_TRUE(isThere) << run.folder << ": " << p.label << ": " << name << " " << value;
      }
}

TEST(ShippedReproductions, QuickJudgesEveryTestableClaim)
{
  const Reproduction all = shipped(true);
  for (std::size_t p = 0; p < all.papers().size(); ++p)
    for (std::size_t s = 0; s < all.papers()[p].sections.size(); ++s)
      for (const Claim& claim : all.papers()[p].sections[s].claims)
      {
        if (!claim.untestable.empty()) continue;
        const StudyRun* study = all.studyOf(p, s);
        ASSERT_TRUE(study) << claim.name;
        EXPECT_GE(study->plan->spec.seeds, 5) << claim.name;
        const study::Outcome none = study::collect(*study->plan, {});
        const Judgement j = judge(claim, study->plan.get(), &none);
        std::size_t run = 0;
        for (const Check& c : j.checks) run += c.status != Status::kLeftOut ? 1 : 0;
        EXPECT_GT(run, 0u) << claim.name << " is left out as a whole";
      }
}
}  // namespace slamot::reproduce::test
