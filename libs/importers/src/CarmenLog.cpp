#include "CarmenLog.h"

#include <algorithm>

namespace slamot::importers::carmen
{
namespace
{
using core::ExitStatus;

constexpr double kOutOfOrder = 1;  // [s]; modules of a robot stamp and send each at its own pace
constexpr std::size_t kMostBeams = std::size_t{1} << 22, kMostMessages = std::size_t{1} << 16;
constexpr std::size_t kMostKinds = 3;
}  // namespace

Log::Log(const std::string& path, const CarmenOptions& options)
    : options_(&options), table_(TextTable::words(path))
{
}

std::optional<Message> Log::next()
{
  while (mustRead() && read())
  {
  }
  if (queue_.empty()) return std::nullopt;
  Message out = std::move(queue_.begin()->second);
  queue_.erase(queue_.begin());
  if (out.scan) queuedBeams_ -= out.scan->ranges.size();
  delivered_ = out.time;
  return out;
}

/// Until nothing earlier can come; bounded also where a log's clock stands still.
bool Log::mustRead() const
{
  if (ended_ || queuedBeams_ > kMostBeams || queue_.size() > kMostMessages) return false;
  return queue_.empty() || std::get<0>(queue_.begin()->first) > newest_ - kOutOfOrder;
}

bool Log::read()
{
  if (!table_.next())
  {
    ended_ = true;
    return false;
  }
  bool known = false;
  auto message = readMessage(table_, *options_, known);
  if (!known) noteUnknown(table_.text(0));
  if (!message) return true;
  if (message->time < std::max(delivered_, newest_ - kOutOfOrder))
    table_.fail(ExitStatus::kNonsense, "the time goes back by over 1 s",
                "sort the lines by their ipc time, the last field but two");
  message->order = order_++;
  newest_ = std::max(newest_, message->time);
  if (message->scan) queuedBeams_ += message->scan->ranges.size();
  const std::tuple key{message->time, !message->isOdometry, message->order};
  queue_.emplace(key, std::move(*message));
  return true;
}

void Log::noteUnknown(std::string_view kind)
{
  ++unknown_;
  const std::string name = quoted(kind);
  const auto& kinds = unknownKinds_;
  if (kinds.size() < kMostKinds && std::find(kinds.begin(), kinds.end(), name) == kinds.end())
    unknownKinds_.push_back(name);
}
}  // namespace slamot::importers::carmen
