#include <slamot/core/version.h>
#include <slamot/reproduce/Reproduction.h>

#include "components.h"
#include "pageParts.h"

namespace slamot::reproduce
{
namespace
{
using results::HtmlPage;

Judgement judgementOf(const Reproduction& all, std::size_t paper, std::size_t section,
                      const Claim& claim)
{
  const StudyRun* study = all.studyOf(paper, section);
  return judge(claim, study ? study->plan.get() : nullptr, study ? &study->outcome : nullptr);
}

std::vector<SummaryRow> summaryRows(const Reproduction& all)
{
  std::vector<SummaryRow> out;
  for (std::size_t p = 0; p < all.papers().size(); ++p)
  {
    const PaperSpec& paper = all.papers()[p];
    for (std::size_t s = 0; s < paper.sections.size(); ++s)
      for (const Claim& c : paper.sections[s].claims)
        out.push_back({paper.title, c.says, c.where, claimId(paper, c), judgementOf(all, p, s, c)});
  }
  return out;
}

/// "3" or "3 to 10".
std::string seedRange(const Reproduction& all)
{
  int least = 0, most = 0;
  for (const StudyRun& s : all.studies())
  {
    const int seeds = s.plan->spec.seeds;
    least = least == 0 ? seeds : std::min(least, seeds);
    most = std::max(most, seeds);
  }
  return std::to_string(least) + (most > least ? " to " + std::to_string(most) : "");
}

void addBanners(HtmlPage& page, const Reproduction& all)
{
  if (all.missing() > 0)
    page.banner("INCOMPLETE: " + std::to_string(all.missing()) +
                " runs are missing. Verdicts stand for what is there.");
  if (all.failed() > 0)
    page.banner(std::to_string(all.failed()) + " runs failed; they are in no number below.");
  if (all.isQuick())
    page.markup("<p class=\"notice\" role=\"note\">Quick: " + seedRange(all) +
                " seeds a cell, and a part of the cells. Intervals are wide, so that claims stay "
                "open that the full reproduction decides.</p>\n");
}

void addReading(HtmlPage& page)
{
  page.markup(folded(
      "How to read this page",
      paragraph("± is the half width of the 95% interval over the seeds, Student's t. All methods "
                "of a study get the same data for the same seed; ratios are ratios of means, "
                "paired by seed.") +
          paragraph(
              "A claim has one or more conditions, and its verdict is computed from the runs' "
              "records. A condition is met if the whole interval is on the claimed side of its "
              "bound, failed if the whole interval is on the other side, open if the bound is in "
              "it. All met: the claim holds. None met and none open: it does not hold. Else it "
              "holds in part; undecided, if no condition is met or failed.") +
          paragraph("A published value with a deviation is met if our mean is within the "
                    "deviation of it, open if only a part of our interval is. A published mean "
                    "of so many runs is met if as many runs of ours would give it: if it is "
                    "within the interval that holds 95% of such means. The papers tell neither "
                    "all settings nor their data, so that values can be compared in kind rather "
                    "than digit by digit.") +
          paragraph("Published figures stand in italics among the rows.")));
}

/// Links to all sections.
void addContents(HtmlPage& page, const Reproduction& all)
{
  const auto link = [](const std::string& id, const std::string& text) {
    return "<a href=\"#" + results::escapedHtml(id) + "\">" + results::escapedHtml(text) + "</a>";
  };
  std::string list;
  for (const PaperSpec& paper : all.papers())
  {
    std::string sections;
    for (const Section& s : paper.sections)
      sections += "<li>" + link(paper.name + "." + s.name, s.title) + "</li>\n";
    list += "<li>" + link(paper.name, paper.title) + "\n<ul>\n" + sections + "</ul></li>\n";
  }
  page.markup(folded("Contents", "<nav><ul>\n" + list + "<li>" + link("cost", "What it took") +
                                     "</li>\n</ul></nav>\n"));
}

void addPaper(HtmlPage& page, const Reproduction& all, std::size_t p)
{
  const PaperSpec& paper = all.papers()[p];
  page.heading(all.papers().size() > 1 ? paper.title : "The paper", paper.name);
  page.markup(paragraph(paper.citation, "faint") + paragraph(paper.text));
  for (std::size_t s = 0; s < paper.sections.size(); ++s) addSection(page, all, p, s);
  addSettings(page, all, p);
}

std::string commandOf(const Reproduction& all)
{
  return "slamot reproduce " + all.name() + (all.isQuick() ? " --quick" : "");
}
}  // namespace

std::string pageOf(const Reproduction& all, std::string& missingPlots)
{
  HtmlPage page(all.title(),
                std::string("Reproduced with slamot ") + kVersion + ": " + commandOf(all));
  page.style(styleSheet());
  addBanners(page, all);
  const auto rows = summaryRows(all);
  if (!rows.empty())
  {
    page.heading("Claims and verdicts", "verdicts");
    page.markup(summary(rows, all.papers().size() > 1));
  }
  addContents(page, all);
  addReading(page);
  for (std::size_t p = 0; p < all.papers().size(); ++p) addPaper(page, all, p);
  addCost(page, all);
  missingPlots = page.missingPlots();
  return page.html();
}
}  // namespace slamot::reproduce
