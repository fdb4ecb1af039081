#include <slamot/fusion/runTeam.h>

#include <algorithm>
#include <limits>

namespace slamot::fusion
{
namespace
{
class TeamRun
{
 public:
  TeamRun(std::vector<TeamRobot>& robots, Radio& radio) : robots_(robots), radio_(radio)
  {
    next_.resize(robots.size());
    updates_.resize(robots.size());
  }

  void begin()
  {
    for (TeamRobot& r : robots_)
      for (core::Sink* sink : r.sinks) sink->begin(r.filter->estimate());
    for (std::size_t r = 0; r < robots_.size(); ++r) next_[r] = robots_[r].source->next();
  }

  /// One instant; how many steps it was, 0 at the end.
  std::size_t advance()
  {
    double now = std::numeric_limits<double>::infinity();
    for (const auto& step : next_)
      if (step) now = std::min(now, step->time);
    std::vector<std::size_t> moving;
    for (std::size_t r = 0; r < robots_.size(); ++r)
      if (next_[r] && next_[r]->time == now) moving.push_back(r);
    for (const std::size_t r : moving)
      if (robots_[r].move) robots_[r].move(*next_[r]);
    for (const std::size_t r : moving)
      updates_[r] = robots_[r].member ? robots_[r].member->process(*next_[r])
                                      : robots_[r].filter->process(*next_[r]);
    exchange(moving, now);
    for (const std::size_t r : moving)
    {
      updates_[r].estimate = robots_[r].filter->estimate();
      for (core::Sink* sink : robots_[r].sinks) sink->accept(*next_[r], updates_[r]);
      next_[r] = robots_[r].source->next();
    }
    return moving.size();
  }

  void finish(bool complete)
  {
    for (TeamRobot& r : robots_)
      for (core::Sink* sink : r.sinks) sink->finish(complete);
  }

  [[nodiscard]] double progress() const
  {
    double least = 1;
    for (std::size_t r = 0; r < robots_.size(); ++r)
      if (next_[r]) least = std::min(least, robots_[r].source->progress());
    return least;
  }

 private:
  void exchange(const std::vector<std::size_t>& moving, double now)
  {
    for (const std::size_t r : moving)
    {
      Member* const from = robots_[r].member;
      if (!from || !from->isDue()) continue;
      const Bytes bytes = from->tell();
      for (std::size_t to = 0; to < robots_.size(); ++to)
        if (next_[to] && robots_[to].member && to != r)
          radio_.send(from->number(), robots_[to].member->number(), now, bytes);
    }
    for (const std::size_t r : moving)
    {
      Member* const member = robots_[r].member;
      if (!member) continue;
      for (Bytes& bytes : radio_.receive(member->number(), now)) member->hear(std::move(bytes));
      const auto events = member->settle();
      robots_[r].events.insert(robots_[r].events.end(), events.begin(), events.end());
    }
  }

  std::vector<TeamRobot>& robots_;
  Radio& radio_;
  std::vector<std::optional<core::Step>> next_;
  std::vector<core::Update> updates_;
};
}  // namespace

core::RunResult runTeam(std::vector<TeamRobot>& robots, Radio& radio,
                        const core::RunOptions& options)
{
  core::RunResult result;
  TeamRun run(robots, radio);
  try
  {
    run.begin();
    while (const std::size_t steps = run.advance())
    {
      result.steps += steps;
      if (options.onProgress) options.onProgress(result.steps, run.progress());
      if (!options.stop || !options.stop->load()) continue;
      result.interrupted = true;
      break;
    }
  }
  catch (...)
  {
    run.finish(false);
    throw;
  }
  run.finish(!result.interrupted);
  return result;
}
}  // namespace slamot::fusion
