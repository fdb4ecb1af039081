#include "pageParts.h"

#include <slamot/study/tables.h>

#include <algorithm>
#include <cctype>
#include <cstring>

#include "components.h"

namespace slamot::reproduce
{
namespace
{
using results::HtmlPage;

template <class List>
const auto& named(const List& list, const std::string& name)
{
  return *std::find_if(list.begin(), list.end(), [&](const auto& x) { return x.name == name; });
}

/// As a shell takes it for one word.
std::string quoted(const std::string& word)
{
  const auto isPlain = [](char c)
  { return std::isalnum(static_cast<unsigned char>(c)) || std::strchr("_-./=,:+%@", c); };
  if (std::all_of(word.begin(), word.end(), isPlain)) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string commandOf(const Section& section)
{
  std::string out = "slamot study " + quoted(section.shownPath);
  for (const std::string& s : section.set) out += " --set " + quoted(s);
  return out;
}

std::string seedsText(const study::StudySpec& spec)
{
  const std::string first = std::to_string(spec.firstSeed);
  return std::to_string(spec.seeds) + (spec.seeds == 1 ? " seed, " : " seeds from ") + first +
         ", the same data for all methods";
}

void addPicture(HtmlPage& page, const Picture& picture, const Drawn& drawn)
{
  if (!drawn.missing.empty())
  {
    page.markup("<figure><figcaption>" + results::escapedHtml(picture.caption) + "</figcaption>" +
                paragraph("This picture is missing: " + drawn.missing, "note") + "</figure>\n");
    return;
  }
  const auto& images = drawn.titlesAndImages;
  if (images.size() == 1) return page.svg(picture.caption, images[0].second);
  page.markup(paragraph(picture.caption, "note") + "<div class=\"row\">\n");
  for (const auto& [title, image] : images) page.svg(title, image);
  page.markup("</div>\n");
}

std::string plotCaption(const study::PlotSpec& plot, const study::StudySpec& spec)
{
  const std::string what = plot.overTime ? "Mean error over time" : "Means";
  return (plot.title.empty() ? "" : plot.title + ". ") + what + " over " +
         std::to_string(spec.seeds) + (spec.seeds == 1 ? " seed" : " seeds") +
         (plot.overTime ? "; the bands are 95% intervals." : "; the bars are 95% intervals.");
}

/// Maps, which are narrow, side by side; all else one under the other.
void addPictures(HtmlPage& page, const std::vector<Picture>& pictures,
                 const std::vector<Drawn>& drawn)
{
  bool isInRow = false;
  for (std::size_t i = 0; i < drawn.size(); ++i)
  {
    const bool isMap = pictures[i].kind == Picture::Kind::kMap;
    if (isMap != isInRow) page.markup(isMap ? "<div class=\"maps\">\n" : "</div>\n");
    isInRow = isMap;
    addPicture(page, pictures[i], drawn[i]);
  }
  if (isInRow) page.markup("</div>\n");
}

void addEvidence(HtmlPage& page, const Section& section, const StudyRun& study,
                 const std::vector<Drawn>& pictures)
{
  const study::Plan& plan = *study.plan;
  addPictures(page, section.pictures, pictures);
  for (const std::string& name : section.plots)
  {
    study::PlotSpec plot = named(plan.spec.plots, name);
    const std::string caption = plotCaption(plot, plan.spec);
    plot.title.clear();  // it is in the caption
    page.figure(caption, study::figureOf(plan, study.outcome, plot));
  }
  const auto table = [&](const std::string& name)
  { return study::tableText(plan, study.outcome, named(plan.spec.tables, name)); };
  for (const std::string& name : section.tables)
  {
    const auto text = table(name);
    page.subheading(text.title);
    page.markup(paragraph(text.note, "faint") + tableHtml(text));
  }
  for (const std::string& name : section.folded)
  {
    const auto text = table(name);
    page.markup(folded(text.title, paragraph(text.note, "faint") + tableHtml(text)));
  }
}

void addFailures(HtmlPage& page, const StudyRun& study)
{
  if (study.outcome.missing > 0)
    page.banner("INCOMPLETE: " + std::to_string(study.outcome.missing) + " of " +
                std::to_string(study.plan->runs.size()) + " runs are missing.");
  if (study.outcome.failed == 0) return;
  std::string list;
  for (const std::string& text : study::failureTexts(*study.plan, study.outcome))
    list += "<li>" + results::escapedHtml(text) + "</li>\n";
  page.banner(std::to_string(study.outcome.failed) + " of " +
              std::to_string(study.plan->runs.size()) +
              " runs failed; they are in no number below.");
  page.markup(folded("Which, and why", "<ul>\n" + list + "</ul>\n"));
}
}  // namespace

std::string claimId(const PaperSpec& paper, const Claim& claim)
{
  return paper.name + "-" + claim.name;
}

void addSection(HtmlPage& page, const Reproduction& all, std::size_t paper, std::size_t section)
{
  const PaperSpec& spec = all.papers()[paper];
  const Section& s = spec.sections[section];
  const StudyRun* study = all.studyOf(paper, section);
  page.markup("<h3 class=\"part\" id=\"" + results::escapedHtml(spec.name + "." + s.name) + "\">" +
              results::escapedHtml(s.title) + "</h3>\n");
  page.markup(paragraph(s.text));
  if (s.isLeftOut) page.markup(paragraph("Left out of the quick reproduction.", "faint"));
  if (study) addFailures(page, *study);
  for (const Claim& c : s.claims)
    page.markup(
        claimBox(claimId(spec, c), c,
                 judge(c, study ? study->plan.get() : nullptr, study ? &study->outcome : nullptr)));
  if (!study) return;
  addEvidence(page, s, *study, all.picturesOf(paper, section));
  page.markup(paragraph("To repeat, " + seedsText(study->plan->spec) + ":", "again") +
              code(commandOf(s)));
}
}  // namespace slamot::reproduce
