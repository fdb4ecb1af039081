#include <slamot/live/Peers.h>
#include <slamot/live/runLive.h>

#include <algorithm>
#include <cstdio>

namespace slamot::live
{
namespace
{
constexpr double kBeaconPeriod = 0.5;     // [s]
constexpr double kBeaconShortest = 0.02;  // [s]: to one who is behind, or new
constexpr double kPatience = 0.05;        // [s]: so often Ctrl-C is looked at

std::string seconds(double s)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.2f s", s);
  return text;
}

/// A step that the filter took in, and the sinks not yet.
struct Pending
{
  core::Step step;
  core::Update update;
};

class RealTimeRun
{
 public:
  RealTimeRun(fusion::TeamRobot& robot, fusion::Radio& radio, Network& network,
              const LiveOptions& options, const RealTimeOptions& timing)
      : robot_(robot),
        radio_(radio),
        network_(network),
        o_(options),
        timing_(timing),
        self_(robot.member->number()),
        peers_(self_, options.team),
        beacons_(network.open("clock", Delivery::kNewest)),
        estimates_(network.open("estimates", Delivery::kNewest))
  {
  }

  LiveResult run()
  {
    for (core::Sink* sink : robot_.sinks) sink->begin(robot_.filter->estimate());
    try
    {
      next_ = robot_.source->next();
      result_.interrupted = !awaitTeam();
      startClock();
      while (next_ && !result_.interrupted) result_.interrupted = !advance();
      passOn();
    }
    catch (...)
    {
      finish(false);
      throw;
    }
    finish(!result_.interrupted);
    result_.sessionsHeard = peers_.sessions();
    return result_;
  }

 private:
  [[nodiscard]] bool isStopped() const { return o_.run.stop && o_.run.stop->load(); }
  void tellNews(const std::string& text) const
  {
    if (o_.onNews) o_.onNews(text);
  }
  void finish(bool complete)
  {
    for (core::Sink* sink : robot_.sinks) sink->finish(complete);
  }

  // False: stopped.
  bool awaitTeam()
  {
    const double until = wallTime() + timing_.waitS;
    while (!(peers_.areAllHeard() && ready_.size() + 1 == o_.team.size()) && wallTime() < until)
    {
      if (isStopped()) return false;
      exchangeBeacons();
      network_.wait(kPatience);
    }
    return !isStopped();
  }

  void startClock()
  {
    TeamClock::Options options;
    options.zero = timing_.clockZero.value_or(next_ ? next_->time : 0);
    options.speed = timing_.speed;
    options.startAt = timing_.startAt;
    clock_.emplace(options, wallTime());
    nextBeacon_ = 0;
  }

  // One step, when it is due; false: stopped before it.
  bool advance()
  {
    if (!awaitDue()) return false;
    passOn();
    late_ = clock_->at(wallTime()) - next_->time;
    pending_ = std::make_unique<Pending>();
    pending_->step = std::move(*next_);
    pending_->update = robot_.member->process(pending_->step);
    if (robot_.member->isDue() && late_ <= timing_.maxAge)
      estimates_->publish(robot_.member->tell());
    exchangeBeacons();
    hear();
    if (o_.run.onProgress) o_.run.onProgress(result_.steps + 1, robot_.source->progress());
    next_ = robot_.source->next();
    return true;
  }

  bool awaitDue()
  {
    for (;;)
    {
      if (isStopped()) return false;
      exchangeBeacons();
      const double left = clock_->wallAt(next_->time) - wallTime();
      if (left <= 0) return true;
      late_ = 0;
      hear();
      network_.wait(std::min(left, kPatience));
    }
  }

  // The last step goes to the sinks, as it stands with what was fused since.
  void passOn()
  {
    if (!pending_) return;
    pending_->update.estimate = robot_.filter->estimate();
    for (core::Sink* sink : robot_.sinks) sink->accept(pending_->step, pending_->update);
    ++result_.steps;
    pending_.reset();
  }

  void hear()
  {
    // Whoever is far behind would count everything as from the future.
    if (!pending_ || late_ > timing_.maxAge) return;
    const double now = clock_->at(wallTime());
    for (const Bytes& bytes : estimates_->take())
    {
      const auto decoded = fusion::decode(bytes);
      const auto* const message = std::get_if<fusion::Message>(&decoded);
      if (message) note(message->sender, message->session);
      radio_.send(message ? message->sender : -1, self_, now, bytes);
    }
    for (Bytes& bytes : radio_.receive(self_, now)) inbox_.push_back(std::move(bytes));
    std::vector<Bytes> later;
    for (Bytes& bytes : inbox_)
      if (isForLater(bytes, now))
        later.push_back(std::move(bytes));
      else
        robot_.member->hear(std::move(bytes));
    inbox_ = std::move(later);
    const auto events = robot_.member->settle();
    for (const auto& event : events)
    {
      if (o_.onFusion) o_.onFusion(event);
      robot_.events.push_back(event);
    }
  }

  // Whether a message is of after the last step, as the next step or one after it will be: however
  // long that takes.
  [[nodiscard]] bool isForLater(const Bytes& bytes, double now) const
  {
    const auto decoded = fusion::decode(bytes);
    const auto* const message = std::get_if<fusion::Message>(&decoded);
    if (!message) return false;
    const double time = message->estimate.time;
    return time > pending_->step.time && time <= now + timing_.maxAge;
  }

  void exchangeBeacons()
  {
    const double wall = wallTime();
    if (wall >= nextBeacon_)
    {
      nextBeacon_ = wall + kBeaconPeriod;
      lastBeacon_ = wall;
      const auto clock = clock_ ? std::optional(clock_->at(wall)) : std::nullopt;
      beacons_->publish(
          encode(Beacon{self_, o_.session, timing_.speed, clock, peers_.areAllHeard()}));
    }
    for (const Bytes& bytes : beacons_->take())
      if (const auto beacon = decodeBeacon(bytes)) hear(*beacon, wallTime());
    for (const int silent : peers_.fallSilent(wall))
      tellNews("robot " + std::to_string(silent) + " is silent" + when());
  }

  // Who is there, by beacons and by messages.
  void note(int sender, std::uint64_t session)
  {
    const std::string who = "robot " + std::to_string(sender);
    const Peers::News news = peers_.hear(sender, session, wallTime());
    if (news == Peers::News::kDouble)
      tellNews("another robot has the number " + std::to_string(self_) + "; give each its own");
    if (news == Peers::News::kStranger) tellNews(who + " is not of the team [dds] team, not heard");
    if (news == Peers::News::kRestarted) tellNews(who + " was started again" + when());
    if (news == Peers::News::kCame) tellNews(who + " is there" + when());
    if (news == Peers::News::kRestarted || news == Peers::News::kCame) isNew_.insert(sender);
  }

  void hear(const Beacon& beacon, double wall)
  {
    note(beacon.sender, beacon.session);
    if (!peers_.isOfTeam(beacon.sender)) return;
    if (beacon.clock || beacon.hearsAll) ready_.insert(beacon.sender);
    if (!clock_) return;
    const std::string who = "robot " + std::to_string(beacon.sender);
    const bool isNew = isNew_.erase(beacon.sender) > 0;
    if (isNew && !clock_->canFollow(beacon, wall))
      tellNews(who + " has another clock (speed, or times in its log), not followed");
    // Whoever is new or behind need not wait for this one's clock.
    const double apart = clock_->at(wall) - beacon.clock.value_or(0);
    if (isNew || apart > kBeaconShortest * timing_.speed)
      nextBeacon_ = std::min(nextBeacon_, lastBeacon_ + kBeaconShortest);
    const double ahead = clock_->hear(beacon, wall);
    if (ahead > timing_.maxAge)
      tellNews("put forward by " + seconds(ahead) + " to the clock of " + who);
  }

  [[nodiscard]] std::string when() const
  {
    return clock_ ? ", " + seconds(clock_->at(wallTime())) : "";
  }

  fusion::TeamRobot& robot_;
  fusion::Radio& radio_;
  Network& network_;
  const LiveOptions& o_;
  RealTimeOptions timing_;
  int self_;
  Peers peers_;
  std::set<int> ready_;  // who hears all, or waits for nobody
  std::set<int> isNew_;  // whose clock was not yet looked at
  std::unique_ptr<Topic> beacons_, estimates_;
  std::optional<TeamClock> clock_;          // none while the team is waited for
  double nextBeacon_ = 0, lastBeacon_ = 0;  // by the wall
  std::optional<core::Step> next_;
  double late_ = 0;  // how long after its time the last step was taken in [s]
  std::unique_ptr<Pending> pending_;
  std::vector<Bytes> inbox_;  // heard, for a later step
  LiveResult result_;
};
}  // namespace

LiveResult runRealTime(fusion::TeamRobot& robot, fusion::Radio& radio, Network& network,
                       const LiveOptions& options, const RealTimeOptions& timing)
{
  return RealTimeRun(robot, radio, network, options, timing).run();
}
}  // namespace slamot::live
