#include "CsvSensors.h"

namespace slamot::importers
{
namespace
{
using core::ExitStatus;

bool isInfinite(std::string_view s)
{
  if (!s.empty() && s[0] == '+') s.remove_prefix(1);
  return s == "inf" || s == "Inf" || s == "INF";
}

class LaserRows : public SensorRows
{
 public:
  LaserRows(const std::string& path, double startTime) : SensorRows(TextTable::csv(path), startTime)
  {
    TextTable::Names wanted = {"t", "angle_min", "angle_step", "range_max", "r0"};
    for (std::size_t i = wanted.size(); i < table_.header().size(); ++i)
      wanted.push_back("r" + std::to_string(i - 4));
    if (wanted != table_.header())
      table_.fail(ExitStatus::kUnreadable, "the header is not that of laser scans",
                  "it must be t,angle_min,angle_step,range_max,r0,r1,... with at least one beam");
    advance();
  }

 private:
  void add(core::Step& step, Counts&) override
  {
    auto scan = std::make_shared<core::LaserScan>();
    scan->angleMin = table_.number(1);
    scan->angleStep = table_.number(2);
    scan->rangeMax = table_.positive(3);
    scan->ranges.reserve(table_.columns() - 4);
    for (std::size_t i = 4; i < table_.columns(); ++i)
      scan->ranges.push_back(static_cast<float>(beam(i, scan->rangeMax)));
    step.lasers.push_back(std::move(scan));
  }

  /// What is beyond the sensor's reach, at or below zero, or empty, is no return.
  [[nodiscard]] double beam(std::size_t column, double rangeMax) const
  {
    const double noReturn = 2 * rangeMax;
    if (table_.empty(column) || isInfinite(table_.text(column))) return noReturn;
    const double range = table_.number(column);
    return range > 0 && range <= rangeMax ? range : noReturn;
  }
};
}  // namespace

std::unique_ptr<SensorRows> laserRows(const std::string& path, double startTime)
{
  return std::make_unique<LaserRows>(path, startTime);
}
}  // namespace slamot::importers
