#include <slamot/core/Error.h>
#include <slamot/live/Announcement.h>
#include <slamot/live/runLive.h>

#include <algorithm>
#include <deque>
#include <limits>

namespace slamot::live
{
namespace
{
using core::Error;
using core::ExitStatus;

constexpr double kPatience = 0.05;  // [s]: so often Ctrl-C is looked at
constexpr double kFarewell = 1;     // [s]: so long one who leaves waits for others to hear it

std::string nameOf(int robot)
{
  return "robot " + std::to_string(robot);
}

/// What is known of another robot.
struct Other
{
  std::optional<std::uint64_t> session;
  std::uint64_t sequence = 0;  // that is expected
  double next = -std::numeric_limits<double>::infinity();
  bool hasLeft = false;
  std::deque<std::pair<double, Bytes>> messages;  // with their times, not yet sent on
};

class LockstepRun
{
 public:
  LockstepRun(fusion::TeamRobot& robot, fusion::Radio& radio, Network& network,
              const LiveOptions& options, const LockstepOptions& limits)
      : robot_(robot),
        radio_(radio),
        network_(network),
        o_(options),
        limits_(limits),
        self_(robot.member->number()),
        topic_(network.open("steps", Delivery::kAll))
  {
    for (const int number : options.team)
      if (number != self_) others_[number];
  }

  LiveResult run()
  {
    for (core::Sink* sink : robot_.sinks) sink->begin(robot_.filter->estimate());
    try
    {
      next_ = robot_.source->next();
      announce(Announcement::Kind::kHello, 0, {});
      bool goesOn = awaitOthers(-std::numeric_limits<double>::infinity());
      while (goesOn && next_) goesOn = advance();
      result_.interrupted = !goesOn;
      if (!goesOn) announce(Announcement::Kind::kLeft, now_, {});
    }
    catch (...)
    {
      leaveInTrouble();
      throw;
    }
    finish(!result_.interrupted);
    // Whoever ends must not take with it what others still wait for.
    flush(result_.interrupted ? kFarewell : limits_.silenceS);
    for (const auto& [number, other] : others_)
      result_.sessionsHeard[number] = other.session ? 1 : 0;
    return result_;
  }

 private:
  [[nodiscard]] bool isStopped() const { return o_.run.stop && o_.run.stop->load(); }
  void finish(bool complete)
  {
    for (core::Sink* sink : robot_.sinks) sink->finish(complete);
  }
  void flush(double longest)
  {
    const double until = wallTime() + longest;
    while (!topic_->flush(kPatience) && wallTime() < until) continue;
  }
  void leaveInTrouble()
  {
    finish(false);
    try
    {
      announce(Announcement::Kind::kLeft, now_, {});
      flush(kFarewell);
    }
    catch (const Error&)
    {
      // The first trouble is the one to tell.
    }
  }

  // One step; false: stopped before it was settled, which leaves it out.
  bool advance()
  {
    core::Step step = std::move(*next_);
    now_ = step.time;
    core::Update update = robot_.member->process(step);
    const Bytes message = robot_.member->isDue() ? robot_.member->tell() : Bytes();
    next_ = robot_.source->next();
    announce(Announcement::Kind::kStep, now_, message);
    if (!awaitOthers(now_)) return false;
    settle();
    update.estimate = robot_.filter->estimate();
    for (core::Sink* sink : robot_.sinks) sink->accept(step, update);
    ++result_.steps;
    if (o_.run.onProgress) o_.run.onProgress(result_.steps, robot_.source->progress());
    return !isStopped();
  }

  void announce(Announcement::Kind kind, double time, const Bytes& message)
  {
    Announcement a;
    a.kind = kind;
    a.sender = self_;
    a.session = o_.session;
    a.sequence = announced_++;
    a.time = time;
    a.next = next_ ? next_->time : std::numeric_limits<double>::infinity();
    a.message = message;
    topic_->publish(encode(a));
  }

  // Until all others have told all that they had to tell up to a time; false: stopped.
  bool awaitOthers(double time)
  {
    double lastNews = wallTime();
    for (;;)
    {
      if (take()) lastNews = wallTime();
      const auto late = std::find_if(others_.begin(), others_.end(),
                                     [&](const auto& o) { return o.second.next <= time; });
      if (late == others_.end()) return true;
      if (late->second.hasLeft) fail(late->first, "ended before its log did");
      if (isStopped()) return false;
      if (wallTime() - lastNews > (late->second.session ? limits_.silenceS : limits_.waitS))
        fail(late->first, late->second.session ? "fell silent" : "was not heard");
      network_.wait(kPatience);
    }
  }

  // Takes in announcements; whether there were any.
  bool take()
  {
    const auto packets = topic_->take();
    for (const Bytes& packet : packets)
    {
      auto a = decodeAnnouncement(packet);
      if (!a || a->sender == self_) continue;
      const auto it = others_.find(a->sender);
      if (it == others_.end()) fail(a->sender, "is not of the team, but in lockstep");
      take(*a, it->second);
    }
    return !packets.empty();
  }

  void take(Announcement& a, Other& other)
  {
    if (!other.session && a.kind == Announcement::Kind::kLeft) return;  // of an earlier run
    if (!other.session && o_.onNews) o_.onNews(nameOf(a.sender) + " is there");
    if (!other.session) other.session = a.session;
    if (a.session < *other.session) return;  // what is left of an earlier run
    if (a.session > *other.session) fail(a.sender, "was started again");
    if (a.sequence != other.sequence++) fail(a.sender, "was not heard in full");
    other.hasLeft = a.kind == Announcement::Kind::kLeft;
    if (other.hasLeft) return;
    other.next = a.next;
    if (!a.message.empty()) other.messages.emplace_back(a.time, std::move(a.message));
  }

  void settle()
  {
    for (auto& [number, other] : others_)
      while (!other.messages.empty() && other.messages.front().first <= now_)
      {
        const auto& [time, bytes] = other.messages.front();
        radio_.send(number, self_, time, bytes);
        other.messages.pop_front();
      }
    for (Bytes& bytes : radio_.receive(self_, now_)) robot_.member->hear(std::move(bytes));
    const auto events = robot_.member->settle();
    for (const auto& event : events)
    {
      if (o_.onFusion) o_.onFusion(event);
      robot_.events.push_back(event);
    }
  }

  [[noreturn]] void fail(int robot, const std::string& what) const
  {
    throw Error(ExitStatus::kLimit, "lockstep",
                nameOf(robot) + " " + what + ", step " + std::to_string(result_.steps),
                "start all robots of [dds] team again");
  }

  fusion::TeamRobot& robot_;
  fusion::Radio& radio_;
  Network& network_;
  const LiveOptions& o_;
  LockstepOptions limits_;
  int self_;
  std::unique_ptr<Topic> topic_;
  std::map<int, Other> others_;
  std::optional<core::Step> next_;
  double now_ = 0;
  std::uint64_t announced_ = 0;
  LiveResult result_;
};
}  // namespace

LiveResult runLockstep(fusion::TeamRobot& robot, fusion::Radio& radio, Network& network,
                       const LiveOptions& options, const LockstepOptions& limits)
{
  return LockstepRun(robot, radio, network, options, limits).run();
}
}  // namespace slamot::live
