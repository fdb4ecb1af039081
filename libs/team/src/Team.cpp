#include <slamot/team/Team.h>

#include <slamot/core/Error.h>

namespace slamot::team
{
namespace
{
using core::Error;
using core::ExitStatus;

/// One robot's view of a filter that all share.
class SharedFilter : public core::Filter
{
 public:
  SharedFilter(filters::CentralizedEkf& ekf, int robot) : ekf_(ekf), robot_(robot) {}
  /// The step's motion alone.
  void move(core::Step step)
  {
    step.landmarks.reset();
    step.blobs.reset();
    ekf_.process(robot_, step);
  }
  /// What the step shows, after move().
  core::Update process(const core::Step& step) override
  {
    core::Step scan = step;
    scan.odometry.reset();
    return ekf_.process(robot_, scan);
  }
  [[nodiscard]] core::Estimate estimate() const override { return ekf_.estimate(robot_); }

 private:
  filters::CentralizedEkf& ekf_;
  int robot_;
};

std::set<int> numbersOf(const std::vector<Log>& logs)
{
  std::set<int> out;
  for (const Log& log : logs)
    if (!out.insert(log.number).second)
      throw Error(ExitStatus::kConfig, "the team",
                  "two robots have the number " + std::to_string(log.number),
                  "name the logs X.robot<number>.rawlog");
  return out;
}
}  // namespace

std::vector<std::string> methodsOf(core::Config& config, std::size_t robots)
{
  core::Params p(config, "team");
  if (!p.has("methods")) return std::vector<std::string>(robots, core::methodOf(config));
  auto out = p.list("methods");
  if (out.size() == 1) out.resize(robots, out.front());
  if (out.size() != robots)
    p.fail("methods",
           "names " + std::to_string(out.size()) + " filters for " + std::to_string(robots) +
               " robots",
           "name one for all or one for each");
  return out;
}

std::string methodAlone(core::Config& config)
{
  core::Params p(config, "team");
  const auto names = p.has("methods") ? p.list("methods") : std::vector<std::string>();
  if (names.empty() || config.has("run", "method")) return core::methodOf(config);
  for (const std::string& name : names)
    if (name != names.front())
      p.fail("methods", "names several filters, but this is one robot",
             "name its own: --set run.method=NAME");
  config.set("run", "method", names.front());
  return core::methodOf(config);
}

core::FilterContext contextOf(const core::Starts& starts, int number, std::uint64_t seed,
                              int threads)
{
  core::FilterContext out;
  out.starts = starts;
  // Filters that draw at random must not draw the same.
  out.seed = seed + 1'000'003 * static_cast<std::uint64_t>(number);
  out.threads = threads;
  return out;
}

MemberFilter makeFilter(core::Config& config, const std::string& method,
                        const core::FilterContext& context)
{
  MemberFilter out;
  out.filter = core::FilterRegistry::instance().make(method, config, context);
  out.asMember = dynamic_cast<core::TeamFilter*>(out.filter.get());
  if (!out.asMember)
    throw Error(ExitStatus::kConfig, config.name() + " [team]",
                "the filter " + method + " can't be one of a team",
                "use ekf-slamot or rbpf-slamot");
  return out;
}

Team::Team(core::Config& config, const std::vector<Log>& logs, std::uint64_t seed, int threads)
    : options_(fusion::TeamOptions::from(config, seed)), radio_(options_.radio)
{
  std::vector<core::FilterContext> contexts;
  for (std::size_t r = 0; r < logs.size(); ++r)
    contexts.push_back(contextOf(logs[r].starts, logs[r].number, seed, threads));
  const std::set<int> numbers = numbersOf(logs);
  methods_ = methodsOf(config, logs.size());
  if (options_.centralized)
    centralize(config, contexts, logs);
  else
    gather(config, contexts, logs, numbers);
  for (std::size_t r = 0; r < logs.size(); ++r)
  {
    fusion::TeamRobot robot;
    robot.source = logs[r].source;
    robot.filter = filters_[r].get();
    if (options_.centralized)
      robot.move = [shared = static_cast<SharedFilter*>(filters_[r].get())](const core::Step& step)
      { shared->move(step); };
    else
      robot.member = members_[r].get();
    robots_.push_back(std::move(robot));
  }
}

void Team::centralize(core::Config& config, const std::vector<core::FilterContext>& contexts,
                      const std::vector<Log>& logs)
{
  for (const std::string& method : methods_)
    if (method != "ekf-slamot")
      throw Error(ExitStatus::kConfig, config.name() + " [team] rule",
                  "is centralized, which is one EKF, but " + method + " is asked for",
                  "use ekf-slamot, or another rule");
  std::vector<int> ids;
  for (const Log& log : logs) ids.push_back(options_.mateIdentities ? log.number : core::kNoId);
  core::Params params(config, "ekf-slamot");
  shared_ = std::make_unique<filters::CentralizedEkf>(params, contexts, options_.mateLabel, ids);
  for (std::size_t r = 0; r < logs.size(); ++r)
    filters_.push_back(std::make_unique<SharedFilter>(*shared_, static_cast<int>(r)));
}

void Team::gather(core::Config& config, const std::vector<core::FilterContext>& contexts,
                  const std::vector<Log>& logs, const std::set<int>& numbers)
{
  for (std::size_t r = 0; r < logs.size(); ++r)
  {
    auto made = makeFilter(config, methods_[r], contexts[r]);
    members_.push_back(
        std::make_unique<fusion::Member>(logs[r].number, numbers, *made.asMember, options_));
    filters_.push_back(std::move(made.filter));
  }
}

core::RunResult Team::run(const std::vector<std::vector<core::Sink*>>& sinks,
                          const core::RunOptions& options)
{
  for (std::size_t r = 0; r < robots_.size(); ++r) robots_[r].sinks = sinks[r];
  return fusion::runTeam(robots_, radio_, options);
}
}  // namespace slamot::team
