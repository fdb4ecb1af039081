#include <slamot/live/TeamClock.h>

#include <chrono>
#include <cmath>

namespace slamot::live
{
double wallTime()
{
  using Seconds = std::chrono::duration<double>;
  using std::chrono::steady_clock, std::chrono::system_clock;
  static const double atStart = Seconds(system_clock::now().time_since_epoch()).count();
  static const steady_clock::time_point start = steady_clock::now();
  return atStart + Seconds(steady_clock::now() - start).count();
}

TeamClock::TeamClock(const Options& options, double wall)
    : options_(options), start_(options.startAt.value_or(wall))
{
}

bool TeamClock::canFollow(const Beacon& beacon, double wall) const
{
  const double sameSpeed = 1e-9 * options_.speed;
  return std::abs(beacon.speed - options_.speed) <= sameSpeed &&
         (!beacon.clock || *beacon.clock - at(wall) <= kFarthest);
}

double TeamClock::hear(const Beacon& beacon, double wall)
{
  if (options_.startAt || !beacon.clock || !canFollow(beacon, wall)) return 0;
  const double ahead = *beacon.clock - at(wall);
  if (ahead <= 0) return 0;
  start_ -= ahead / options_.speed;
  return ahead;
}
}  // namespace slamot::live
