#include "Progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace slamot::apps
{
namespace
{
constexpr int kBarWidth = 30;
constexpr double kRedraw = 0.1;  // [s], on a terminal
constexpr double kLineAfter = 2.0,
                 kLineAtLast = 15;  // [s], elsewhere: with a tenth more done, or at all

double seconds(std::chrono::steady_clock::duration d)
{
  return std::chrono::duration<double>(d).count();
}

std::string timeLeft(double elapsed, double share)
{
  if (share < 0.01 || elapsed < 0.2) return "";
  const auto left = static_cast<long>(elapsed * (1 - share) / share + 0.5);
  char text[48];
  if (left < 60)
    std::snprintf(text, sizeof text, ", %ld s left", left);
  else
    std::snprintf(text, sizeof text, ", %ld:%02ld min left", left / 60, left % 60);
  return text;
}
}  // namespace

Progress::Progress(std::string unit, bool quiet)
    : unit_(std::move(unit)),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_(start_)
{
}

void Progress::update(std::size_t count, double share)
{
  if (quiet_) return;
  const Clock::time_point now = Clock::now();
  const double since = seconds(now - last_);
  const bool due = terminal_
                       ? since >= kRedraw
                       : (since >= kLineAfter && share >= lastShare_ + 0.1) || since >= kLineAtLast;
  if (!due) return;
  last_ = now;
  lastShare_ = share;
  draw(count, std::clamp(share, 0.0, 1.0), seconds(now - start_));
}

void Progress::draw(std::size_t count, double share, double elapsed)
{
  const double rate = elapsed > 0 ? static_cast<double>(count) / elapsed : 0;
  char numbers[128];
  std::snprintf(numbers, sizeof numbers, "%3.0f%%  %zu %s, %.0f/s%s", 100 * share, count,
                unit_.c_str(), rate, timeLeft(elapsed, share).c_str());
  if (terminal_)
  {
    std::string bar(kBarWidth, ' ');
    std::fill_n(bar.begin(), static_cast<int>(share * kBarWidth), '=');
    std::fprintf(stderr, "\r[%s] %s\x1b[K", bar.c_str(), numbers);
  }
  else
    std::fprintf(stderr, "slamot: %s\n", numbers);
  drawn_ = true;
}

void Progress::finish()
{
  if (terminal_ && drawn_) std::fprintf(stderr, "\r\x1b[K");
  drawn_ = false;
}
}  // namespace slamot::apps
