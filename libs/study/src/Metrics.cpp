#include <algorithm>

#include "metricEntries.h"

namespace slamot::study
{
namespace
{
const std::vector<MetricEntry>& entries()
{
  static const std::vector<MetricEntry> list = []
  {
    std::vector<MetricEntry> out;
    for (auto* part :
         {robotMetrics, targetMetrics, particleMetrics, mapMetrics, boundMetrics, messageMetrics})
      for (MetricEntry& e : part()) out.push_back(std::move(e));
    return out;
  }();
  return list;
}
}  // namespace

const std::vector<Metric>& metrics()
{
  static const std::vector<Metric> list = []
  {
    std::vector<Metric> out;
    for (const MetricEntry& e : entries()) out.push_back(e.metric);
    return out;
  }();
  return list;
}

std::optional<std::size_t> metricByName(const std::string& name)
{
  const auto& list = metrics();
  const auto it =
      std::find_if(list.begin(), list.end(), [&](const Metric& m) { return m.name == name; });
  if (it == list.end()) return std::nullopt;
  return static_cast<std::size_t>(it - list.begin());
}

std::vector<std::optional<double>> measure(const eval::Record& record,
                                           const eval::Evaluation& evaluation,
                                           const MessageFigures* messages,
                                           const BoundFigures* bound)
{
  std::vector<std::optional<double>> out;
  for (const MetricEntry& e : entries())
    out.push_back(e.value({record, evaluation, messages, bound}));
  return out;
}

std::vector<std::optional<double>> meanOf(
    const std::vector<std::vector<std::optional<double>>>& robots)
{
  if (robots.empty()) return std::vector<std::optional<double>>(entries().size());
  return presentMeans(robots);
}
}  // namespace slamot::study
