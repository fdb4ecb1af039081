#include "CarmenScans.h"

#include <slamot/eval/Trajectory.h>

namespace slamot::importers::carmen
{
namespace
{
constexpr double kLongestGap = 1;  // [s], between the ODOM lines around a scan
constexpr std::size_t kMostWaiting = 1000;
}  // namespace

Scans::Scans(const std::string& path, const CarmenOptions& options)
    : log_(path, options), odometryLines_(options.odometryLines)
{
}

std::optional<Message> Scans::next()
{
  while (ready_.empty())
  {
    auto message = log_.next();
    if (!message)
    {
      unplaced_ += waiting_.size();
      waiting_.clear();
      return std::nullopt;
    }
    if (odometryLines_)
      take(std::move(*message));
    else if (!message->isOdometry)
      ready_.push_back(std::move(*message));
  }
  Message out = std::move(ready_.front());
  ready_.pop_front();
  return out;
}

void Scans::take(Message message)
{
  if (message.isOdometry) return place(message);
  if (odometry_ && odometry_->time == message.time)
  {
    message.odometry = odometry_->odometry;
    ready_.push_back(std::move(message));
    return;
  }
  if (odometry_ && message.time - odometry_->time <= kLongestGap && waiting_.size() < kMostWaiting)
    waiting_.push_back(std::move(message));
  else
    ++unplaced_;
}

void Scans::place(const Message& odometry)
{
  for (Message& scan : waiting_)
  {
    const eval::Trajectory around{
        {{odometry_->time, odometry_->odometry, true}, {odometry.time, odometry.odometry, true}}};
    const auto pose = around.at(scan.time, kLongestGap);
    unplaced_ += pose ? 0 : 1;
    if (!pose) continue;
    scan.odometry = pose->pose;
    ready_.push_back(std::move(scan));
  }
  waiting_.clear();
  odometry_ = odometry;
}
}  // namespace slamot::importers::carmen
