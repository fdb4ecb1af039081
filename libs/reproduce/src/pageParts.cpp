#include "pageParts.h"

#include <slamot/results/TextFile.h>
#include <slamot/study/tables.h>

#include <algorithm>
#include <filesystem>

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

std::string fileName(const std::string& path)
{
  return std::filesystem::path(path).filename().string();
}

std::string quoted(const std::string& word)
{
  return word.find_first_of(" ;()'") == std::string::npos ? word : "\"" + word + "\"";
}

std::string commandOf(const Section& section)
{
  std::string out = "slamot study config-ini/" + fileName(section.studyPath);
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

/// Texts of files by their names, in the order in which they came first.
class Files
{
 public:
  void add(const std::string& name, const std::string& text)
  {
    const auto same = [&](const auto& f) { return f.first == name && f.second == text; };
    if (std::none_of(files_.begin(), files_.end(), same)) files_.emplace_back(name, text);
  }
  [[nodiscard]] std::string html() const
  {
    std::string out;
    for (const auto& [name, text] : files_) out += folded(name, code(text));
    return out;
  }

 private:
  std::vector<std::pair<std::string, std::string>> files_;
};

std::string fixed(double value, int decimals)
{
  std::string out;
  results::appendFixed(out, value, decimals);
  return out;
}

struct Cost
{
  std::size_t runs = 0;
  double cpuS = 0;
};
Cost costOf(const StudyRun& study)
{
  Cost out;
  for (const auto& record : study.outcome.records)
    if (record) ++out.runs, out.cpuS += record->cpuS;
  return out;
}

std::vector<std::string> costRow(const std::string& name, const Cost& c)
{
  const double each = c.runs > 0 ? c.cpuS / static_cast<double>(c.runs) : 0;
  return {name, std::to_string(c.runs), fixed(each, 2), fixed(c.cpuS, 0), fixed(c.cpuS / 3600, 2)};
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

void addSettings(HtmlPage& page, const Reproduction& all, std::size_t paper)
{
  Files files;
  const auto& sections = all.papers()[paper].sections;
  for (std::size_t i = 0; i < sections.size(); ++i)
  {
    const StudyRun* study = all.studyOf(paper, i);
    if (!study) continue;
    const study::StudySpec& spec = study->plan->spec;
    files.add(spec.name + ", as it was run", spec.effective);
    if (spec.simulated) files.add(spec.scenario.name, spec.scenario.text);
    for (const study::Method& m : spec.methods) files.add(m.file.name, m.file.text);
  }
  if (!files.html().empty()) page.markup(folded("All settings of this paper", files.html()));
}

void addCost(HtmlPage& page, const Reproduction& all)
{
  results::Table table{{"study", "runs", "CPU a run [s]", "CPU of all [s]", "[h]"}, {}};
  Cost sum;
  for (const StudyRun& study : all.studies())
  {
    const Cost c = costOf(study);
    table.rows.push_back(costRow(study.folder, c));
    sum.runs += c.runs;
    sum.cpuS += c.cpuS;
  }
  table.rows.push_back(costRow("all", sum));
  page.heading("What it took", "cost");
  page.paragraph(
      "From the times in the records, on the processors that made them: of the methods alone, "
      "without the bounds of worlds and without pictures.");
  page.table(table);
}
}  // namespace slamot::reproduce
