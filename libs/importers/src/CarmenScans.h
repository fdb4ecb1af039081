#pragma once

#include <deque>

#include "CarmenLog.h"

namespace slamot::importers::carmen
{
/// The scans of a log, each with the pose that odometry gives it: that of its own message, or one
/// between the ODOM lines around it.
class Scans
{
 public:
  Scans(const std::string& path, const CarmenOptions& options);

  /// The next one in time; its odometry is its pose.
  std::optional<Message> next();

  [[nodiscard]] const Log& log() const { return log_; }
  /// Scans left out: no ODOM line before or after them within 1 s.
  [[nodiscard]] std::size_t unplaced() const { return unplaced_; }

 private:
  void take(Message message);
  void place(const Message& odometry);

  Log log_;
  bool odometryLines_;
  std::optional<Message> odometry_;  // the last ODOM line
  std::deque<Message> waiting_, ready_;
  std::size_t unplaced_ = 0;
};
}  // namespace slamot::importers::carmen
