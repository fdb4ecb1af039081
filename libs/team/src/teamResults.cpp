#include <slamot/team/teamResults.h>

#include <slamot/core/version.h>
#include <slamot/results/CsvText.h>
#include <slamot/results/TextFile.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <regex>

namespace slamot::team
{
namespace
{
using Json = nlohmann::ordered_json;
using Value = std::optional<double>;

Json orNull(const Value& v)
{
  return v ? Json(*v) : Json(nullptr);
}

/// Means of what there is.
class Mean
{
 public:
  void add(const Value& v)
  {
    if (v) sum_ += *v, ++count_;
  }
  [[nodiscard]] Value value() const { return count_ > 0 ? Value(sum_ / count_) : std::nullopt; }

 private:
  double sum_ = 0;
  int count_ = 0;
};

const eval::TargetEvaluation* targetOf(const RobotResult& robot, int id)
{
  for (const auto& t : robot.view.evaluation.trueTargets)
    if (t.id == id) return &t;
  return nullptr;
}

Json errorsJson(const eval::ErrorSummary& e)
{
  return {{"position_mean_error_m", orNull(e.positionMean)},
          {"position_median_error_m", orNull(e.positionMedian)},
          {"position_rmse_m", orNull(e.positionRmse)},
          {"heading_rmse_rad", orNull(e.headingRmse)},
          {"nees_mean", orNull(e.neesMean)},
          {"nees_position_mean", orNull(e.neesPositionMean)},
          {"coverage_95", orNull(e.coverage95)}};
}

std::map<int, const eval::Truth*> truthsOf(const Team& team, const std::vector<RobotResult>& robots)
{
  std::map<int, const eval::Truth*> out;
  for (std::size_t r = 0; r < robots.size(); ++r)
    if (team.member(r)) out[team.member(r)->number()] = &robots[r].view.truth;
  return out;
}

Json messagesJson(const fusion::Member& member, const FusionSummary& fusion)
{
  Json outcomes = Json::object();
  for (const auto& [name, count] : member.counts().rows()) outcomes[name] = count;
  return {{"sent", member.sent()},
          {"bytes_sent", member.bytesSent()},
          {"received", member.counts().messages()},
          {"fused", fusion.fused},
          {"candidates_fused", fusion.candidates},
          {"wrong_candidates_fused",
           fusion.wrongCandidates ? Json(*fusion.wrongCandidates) : Json(nullptr)},
          {"by_outcome", outcomes}};
}

std::string cell(const Value& v, const char* format)
{
  char text[40];
  std::snprintf(text, sizeof text, format, v.value_or(0));
  return v ? text : "-";
}
}  // namespace

std::optional<int> numberIn(const std::string& name)
{
  static const std::regex pattern("robot([0-9]{1,6})$");
  std::smatch match;
  if (!std::regex_search(name, match, pattern)) return {};
  return std::stoi(match[1]);
}

std::vector<int> robotNumbers(const std::vector<std::string>& names)
{
  std::vector<int> byName, byPlace;
  for (const std::string& name : names)
  {
    byPlace.push_back(static_cast<int>(byPlace.size()));
    if (const auto number = numberIn(name)) byName.push_back(*number);
  }
  return byName.size() == names.size() ? byName : byPlace;
}

FusionSummary summarise(const std::vector<fusion::FusionEvent>& events, const eval::Truth& own,
                        const std::map<int, const eval::Truth*>& truths)
{
  FusionSummary out;
  if (!own.robot.empty()) out.wrongCandidates = 0;
  for (const fusion::FusionEvent& e : events)
  {
    if (e.receipt.outcome != fusion::Outcome::kFused) continue;
    ++out.fused;
    if (e.receipt.candidate < 0) continue;
    ++out.candidates;
    const auto it = truths.find(e.receipt.sender);
    if (it == truths.end() || !out.wrongCandidates) continue;
    const auto from = it->second->robot.at(e.sent), me = own.robot.at(e.sent);
    if (!from || !me) continue;
    const fusion::Candidate& c = e.candidate;
    const Point2D seen =
        math::transform(from->pose, {c.range * std::cos(c.bearing), c.range * std::sin(c.bearing)});
    const double off = std::hypot(seen.x - me->pose.x, seen.y - me->pose.y);
    constexpr double kDeviations = 5;
    if (off > kDeviations * std::hypot(c.rangeStd, c.range * c.bearingStd)) ++*out.wrongCandidates;
  }
  return out;
}

std::vector<FusionSummary> fusionsOf(const Team& team, const std::vector<RobotResult>& robots)
{
  const auto truths = truthsOf(team, robots);
  std::vector<FusionSummary> out;
  for (std::size_t r = 0; r < robots.size(); ++r)
    out.push_back(summarise(team.events(r), robots[r].view.truth, truths));
  return out;
}

std::string teamJson(const Team& team, const std::vector<RobotResult>& robots, std::uint64_t seed,
                     const results::Timing& timing)
{
  const int target = team.options().target;
  const auto fusions = fusionsOf(team, robots);
  Json list = Json::array();
  bool complete = true;
  Mean robotError, robotNees, targetError, targetNees;
  for (std::size_t r = 0; r < robots.size(); ++r)
  {
    const results::RunView& view = robots[r].view;
    const auto* const t = targetOf(robots[r], target);
    complete = complete && view.record.complete;
    robotError.add(view.evaluation.robot.all.positionMean);
    robotNees.add(view.evaluation.robot.all.neesMean);
    if (t) targetError.add(t->all.positionMean);
    if (t) targetNees.add(t->all.neesMean);
    Json robot = {{"name", robots[r].name},
                  {"method", team.method(r)},
                  {"steps", view.record.steps.size()},
                  {"robot", errorsJson(view.evaluation.robot.all)},
                  {"target", t ? errorsJson(t->all) : Json(nullptr)}};
    if (t) robot["target"]["tracked_fraction"] = orNull(t->trackedFraction);
    const fusion::Member* const member = team.member(r);
    robot["messages"] = member ? messagesJson(*member, fusions[r]) : Json(nullptr);
    list.push_back(std::move(robot));
  }
  const Json out = {
      {"slamot_version", kVersion},
      {"mrpt_version", results::mrptVersion()},
      {"rule", team.options().ruleName},
      {"exchange_every", team.options().exchangeEvery},
      {"message_loss", team.options().radio.loss},
      {"message_delay_s", team.options().radio.delay},
      {"seed", seed},
      {"complete", complete},
      {"timing",
       {{"wall_s", timing.wallS}, {"cpu_s", timing.cpuS}, {"peak_rss_mb", timing.peakRssMb}}},
      {"team",
       {{"robot_position_mean_error_m", orNull(robotError.value())},
        {"robot_nees_mean", orNull(robotNees.value())},
        {"target_position_mean_error_m", orNull(targetError.value())},
        {"target_nees_mean", orNull(targetNees.value())}}},
      {"robots", list}};
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string teamTable(const Team& team, const std::vector<RobotResult>& robots)
{
  const auto fusions = fusionsOf(team, robots);
  std::string out = "team, rule " + team.options().ruleName + "\n";
  char line[200];
  std::snprintf(line, sizeof line, "%-24s %9s %6s %9s %6s %7s %7s %6s %6s\n", "", "robot [m]",
                "NEES", "target[m]", "NEES", "sent", "fused", "seen", "wrong");
  out += line;
  for (std::size_t r = 0; r < robots.size(); ++r)
  {
    const auto& all = robots[r].view.evaluation.robot.all;
    const auto* const t = targetOf(robots[r], team.options().target);
    const fusion::Member* const member = team.member(r);
    const FusionSummary& fusion = fusions[r];
    std::snprintf(line, sizeof line, "%-24s %9s %6s %9s %6s %7lld %7lld %6lld %6s\n",
                  robots[r].name.c_str(), cell(all.positionMean, "%.3f").c_str(),
                  cell(all.neesMean, "%.2f").c_str(),
                  cell(t ? t->all.positionMean : Value(), "%.3f").c_str(),
                  cell(t ? t->all.neesMean : Value(), "%.2f").c_str(),
                  static_cast<long long>(member ? member->sent() : 0),
                  static_cast<long long>(fusion.fused), static_cast<long long>(fusion.candidates),
                  fusion.wrongCandidates ? std::to_string(*fusion.wrongCandidates).c_str() : "-");
    out += line;
  }
  return out;
}

void writeFusions(const std::string& path, const std::vector<fusion::FusionEvent>& events)
{
  results::CsvText csv(
      "t,sent,sender,outcome,omega,candidate,target_fused,robot_before_x,robot_before_y,"
      "robot_before_cxx,robot_before_cxy,robot_before_cyy,robot_after_x,robot_after_y,"
      "robot_after_cxx,robot_after_cxy,robot_after_cyy,target_before_x,target_before_y,"
      "target_before_cxx,target_before_cxy,target_before_cyy,target_after_x,target_after_y,"
      "target_after_cxx,target_after_cxy,target_after_cyy");
  const auto add = [&](const Gaussian<Point2D>& g, bool known)
  {
    for (const double v : {g.mean.x, g.mean.y, g.cov(0, 0), g.cov(0, 1), g.cov(1, 1)})
      known ? csv.add(v) : csv.nothing();
  };
  for (const fusion::FusionEvent& e : events)
  {
    csv.add(e.time).add(e.sent).add(e.receipt.sender).add(std::string(name(e.receipt.outcome)));
    csv.add(e.receipt.omega).add(e.receipt.candidate).add(e.receipt.targetFused ? 1 : 0);
    add(e.robotBefore, true);
    add(e.robotAfter, true);
    add(e.targetBefore, e.hasTarget);
    add(e.targetAfter, e.hasTarget);
    csv.endRow();
  }
  results::writeWhole(path, csv.text());
}
}  // namespace slamot::team
