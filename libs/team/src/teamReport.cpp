#include <slamot/team/teamReport.h>

#include <slamot/core/version.h>
#include <slamot/results/TextFile.h>
#include <slamot/results/keyNumbers.h>

#include <algorithm>

namespace slamot::team
{
namespace
{
using results::HtmlPage;
using results::Table;

/// Means of what there is over several robots.
std::optional<double> meanOf(const std::vector<eval::ErrorSummary>& all,
                             std::optional<double> eval::ErrorSummary::*value)
{
  double sum = 0;
  int count = 0;
  for (const auto& e : all)
    if (e.*value) sum += *(e.*value), ++count;
  return count > 0 ? std::optional<double>(sum / count) : std::nullopt;
}

eval::ErrorSummary meanOf(const std::vector<eval::ErrorSummary>& all)
{
  using E = eval::ErrorSummary;
  E out;
  for (const E& e : all) out.count += e.count;
  for (const auto value : {&E::positionMean, &E::positionMedian, &E::positionRmse, &E::headingRmse,
                           &E::neesMean, &E::neesPositionMean, &E::coverage95})
    out.*value = meanOf(all, value);
  return out;
}

/// One row a robot, and the mean over them.
void addErrorTable(HtmlPage& page, const TeamView& team, bool ofTarget)
{
  Table table{results::errorHeader(), {}};
  table.header.front() = ofTarget ? "target, as tracked by" : "robot";
  std::vector<eval::ErrorSummary> all;
  for (const auto& robot : team.robots)
  {
    const auto* const target = targetOf(robot, team.target).evaluation;
    const eval::ErrorSummary e = !ofTarget ? robot.run.evaluation.robot.all
                                 : target  ? target->all
                                           : eval::ErrorSummary();
    all.push_back(e);
    if (e.count > 0) table.rows.push_back(results::errorRow(robot.name, e));
  }
  if (table.rows.empty()) return;
  if (table.rows.size() > 1) table.rows.push_back(results::errorRow("mean", meanOf(all)));
  page.table(table);
}

std::string percent(const std::optional<double>& share)
{
  std::string text;
  if (share) results::appendFixed(text, 100 * *share, 1);
  return share ? text + "%" : "\u2013";
}

void addFacts(HtmlPage& page, const Team& team, const TeamView& view)
{
  Table table{{"", "method", "steps", "landmarks mapped", "target tracked"}, {}};
  for (std::size_t r = 0; r < view.robots.size(); ++r)
  {
    const auto& run = view.robots[r].run;
    const auto* const target = targetOf(view.robots[r], view.target).evaluation;
    table.rows.push_back(
        {view.robots[r].name, team.method(r), std::to_string(run.record.steps.size()),
         run.record.hasMap ? std::to_string(run.record.landmarks.size()) : "\u2013",
         target ? percent(target->trackedFraction) : "\u2013"});
  }
  page.table(table);
}

void addNumbers(HtmlPage& page, const Team& team, const TeamView& view)
{
  page.heading("Key numbers");
  const bool any = std::any_of(view.robots.begin(), view.robots.end(),
                               [](const auto& r) { return r.run.evaluation.robot.all.count > 0; });
  if (any)
  {
    addErrorTable(page, view, false);
    addErrorTable(page, view, true);
    page.paragraph(
        "NEES (3) is the mean of the squared errors of x, y and heading, normalised by the "
        "filter's own covariance: 3 if the filter is as sure as it should be, more if it is too "
        "sure; NEES (2) is that of x and y, and should be 2. A guaranteed rule of fusion keeps "
        "them from growing; it may well keep them smaller. All maps are laid over the truth "
        "together, once.");
  }
  else
    page.paragraph("No ground truth goes with these logs, so there are no errors to tell.");
  addFacts(page, team, view);
}

/// Appends a row of one count a robot.
template <class CountOf>
void addCounts(Table& table, const Team& team, const std::string& name, bool evenZeros,
               CountOf countOf)
{
  std::vector<std::string> row{name};
  std::int64_t sum = 0;
  for (std::size_t r = 0; r < team.size(); ++r)
  {
    const std::int64_t count = countOf(r);
    sum += count;
    row.push_back(std::to_string(count));
  }
  if (sum > 0 || evenZeros) table.rows.push_back(row);
}

std::string words(std::string name)
{
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

void addMessages(HtmlPage& page, const Team& team, const std::vector<RobotResult>& robots)
{
  page.heading("Messages");
  const Table table = messageTable(team, robots);
  if (table.rows.empty())
    return page.paragraph("One filter takes in all logs: there are no messages.");
  const auto& o = team.options();
  std::string text = "A robot sends after every ";
  text += o.exchangeEvery == 1 ? "step" : std::to_string(o.exchangeEvery) + " steps";
  text += ", to every other. Lost on the way: " + percent(o.radio.loss) + ". ";
  page.paragraph(text +
                 "Every message that arrived had one of the outcomes, and they sum up to what was "
                 "received; outcomes that no message had are left out.");
  page.table(table);
}

void addFigures(HtmlPage& page, const TeamView& team)
{
  page.heading("Map and paths");
  page.figure(
      "The map frame from above: the robots' paths, and in each one's colour, thin, the target as "
      "it tracks it; dashed, true paths. Around a few places of fusion, the ellipses that hold 95% "
      "of what the robot believed of itself and of the target: the outline before, filled after; "
      "all "
      "enlarged alike.",
      teamMapFigure(team));
  const auto errors = robotErrorsFigure(team), ofTarget = targetErrorsFigure(team);
  if (errors || ofTarget) page.heading("Errors");
  if (errors) page.figure("Errors of the robots.", *errors);
  if (ofTarget) page.figure("Errors of the target, as each robot tracks it.", *ofTarget);
  if (const auto nees = teamNeesFigure(team))
    page.figure(
        "Normalised squared errors. A consistent filter's lie in the band 95% of the time; above "
        "it, the filter is too sure of itself.",
        *nees);
  page.heading("Uncertainty and fusion");
  page.figure(
      "The root of the sum of both variances of a place, as the filter believes. Dots: a message "
      "was fused.",
      uncertaintyFigure(team));
  if (const auto omega = omegaFigure(team))
    page.figure("The weight given to one's own estimate in each fusion; the rest is the message's.",
                *omega);
}

std::string subtitleOf(const std::vector<RobotResult>& robots, std::uint64_t seed)
{
  std::string out;
  for (const RobotResult& robot : robots) out += robot.name + ", ";
  return out + "seed " + std::to_string(seed);
}
}  // namespace

std::string titleOf(const Team& team)
{
  return "team of " + std::to_string(team.size()) + ", rule " + team.options().ruleName;
}

TeamView viewOf(const Team& team, const std::vector<RobotResult>& robots)
{
  TeamView out;
  out.target = team.options().target;
  for (std::size_t r = 0; r < robots.size(); ++r)
    out.robots.push_back({robots[r].name, robots[r].view, team.events(r)});
  return out;
}

results::Table messageTable(const Team& team, const std::vector<RobotResult>& robots)
{
  Table table{{""}, {}};
  for (std::size_t r = 0; r < team.size(); ++r)
  {
    if (!team.member(r)) return {};
    table.header.push_back(robots[r].name);
  }
  const auto counts = [&](std::size_t r) -> const auto&
  {
    return team.member(r)->counts();
  };
  const auto add = [&](const std::string& name, bool evenZeros, auto countOf)
  { addCounts(table, team, name, evenZeros, countOf); };
  add("sent", true, [&](std::size_t r) { return team.member(r)->sent(); });
  add("bytes sent", true, [&](std::size_t r) { return team.member(r)->bytesSent(); });
  for (int i = 0; i < static_cast<int>(fusion::Outcome::kCount); ++i)
  {
    const auto outcome = static_cast<fusion::Outcome>(i);
    add(words(name(outcome)), false, [&](std::size_t r) { return counts(r).of(outcome); });
  }
  add("received: the sum of outcomes", true, [&](std::size_t r) { return counts(r).messages(); });
  for (int i = 0; i < static_cast<int>(fusion::Note::kCount); ++i)
  {
    const auto note = static_cast<fusion::Note>(i);
    add("of these: " + words(name(note)), false, [&](std::size_t r) { return counts(r).of(note); });
  }
  const auto fusions = fusionsOf(team, robots);
  if (std::all_of(fusions.begin(), fusions.end(), [](const auto& f) { return f.wrongCandidates; }))
    add("of these: wrong candidate fused", true,
        [&](std::size_t r) { return *fusions[r].wrongCandidates; });
  return table;
}

std::string writeTeamReport(const std::string& path, const Team& team,
                            const std::vector<RobotResult>& robots, std::uint64_t seed,
                            const std::string& config)
{
  const TeamView view = viewOf(team, robots);
  HtmlPage page(titleOf(team), subtitleOf(robots, seed));
  std::string incomplete;
  for (const RobotResult& robot : robots)
    if (!robot.view.record.complete) incomplete += (incomplete.empty() ? "" : ", ") + robot.name;
  if (!incomplete.empty())
    page.banner("INCOMPLETE: the run was interrupted, or its input ended too early: " + incomplete +
                ". All below stands for the part up to then.");
  addNumbers(page, team, view);
  addMessages(page, team, robots);
  addFigures(page, view);
  page.heading("Each robot's own report");
  std::vector<std::pair<std::string, std::string>> links;
  for (const RobotResult& robot : robots)
    links.push_back({robot.name, robot.name + "/report.html"});
  page.links(links);
  page.heading("Settings");
  page.paragraph("The full effective configuration; as config.ini it repeats the run.");
  page.preformatted(config);
  page.heading("Versions");
  page.table({{}, {{"slamot", kVersion}, {"MRPT", results::mrptVersion()}}});
  results::writeWhole(path, page.html());
  return page.missingPlots().empty() ? std::string()
                                     : "report.html: made without plots: " + page.missingPlots();
}
}  // namespace slamot::team
