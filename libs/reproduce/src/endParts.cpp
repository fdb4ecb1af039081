#include <slamot/results/TextFile.h>

#include <algorithm>

#include "components.h"
#include "pageParts.h"

namespace slamot::reproduce
{
namespace
{
using results::HtmlPage;

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
