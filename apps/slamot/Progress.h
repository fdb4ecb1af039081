#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace slamot::apps
{
/// How far a command is, on stderr: a bar with rate and time left on a terminal, else a plain line
/// now and then; nothing if quiet.
class Progress
{
 public:
  /// \param unit what is counted, such as "steps".
  Progress(std::string unit, bool quiet);
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// \param share of the work that is done, 0 to 1.
  void update(std::size_t count, double share);
  /// Leaves the bar's line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void draw(std::size_t count, double share, double elapsed);

  std::string unit_;
  bool quiet_, terminal_, drawn_ = false;
  Clock::time_point start_, last_;
  double lastShare_ = 0;
};
}  // namespace slamot::apps
