#include "metricEntries.h"

namespace slamot::study
{
namespace
{
std::function<Value(const Measured&)> exchanged(double MessageFigures::*which)
{
  return [which](const Measured& r)
  { return r.messages ? Value(r.messages->*which) : std::nullopt; };
}
}  // namespace

std::vector<MetricEntry> messageMetrics()
{
  return {
      {{"messages_sent", "messages sent", 1}, exchanged(&MessageFigures::sent)},
      {{"message_bytes", "bytes sent", 0}, exchanged(&MessageFigures::bytes)},
      {{"messages_fused", "messages fused", 1}, exchanged(&MessageFigures::fused)},
      {{"candidates_fused", "of them with a sighting", 1}, exchanged(&MessageFigures::candidates)},
      {{"candidates_wrong", "of these wrong", 3},
       [](const Measured& r) { return r.messages ? r.messages->wrong : std::nullopt; }},
  };
}
}  // namespace slamot::study
