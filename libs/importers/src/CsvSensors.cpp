#include "CsvSensors.h"

#include <filesystem>

namespace slamot::importers
{
namespace
{
using core::ExitStatus;

bool exists(const std::string& path)
{
  std::error_code error;
  return std::filesystem::exists(path, error);
}

bool isInfinite(std::string_view s)
{
  if (!s.empty() && s[0] == '+') s.remove_prefix(1);
  return s == "inf" || s == "Inf" || s == "INF";
}

/// Range [m], bearing [rad] and their deviations, from a row.
struct Polar
{
  std::optional<double> range;
  double bearing = 0, rangeStd = 0, bearingStd = 0;
};

Polar polar(const TextTable& table, std::size_t column, bool rangeOptional)
{
  Polar out;
  if (rangeOptional && table.empty(column))
  {
    // What deviation an absent range has doesn't matter, but it must not be nonsense.
    if (!table.empty(column + 2)) (void)table.nonNegative(column + 2);
  }
  else
  {
    out.range = table.number(column);
    out.rangeStd = table.positive(column + 2);
  }
  out.bearing = math::wrapToPi(table.number(column + 1));
  out.bearingStd = table.positive(column + 3);
  return out;
}

bool inView(const core::FieldOfView& fov, const Polar& p)
{
  if (p.range) return *p.range > 0 && fov.contains(*p.range, p.bearing);
  return p.bearing >= fov.bearingMin && p.bearing <= fov.bearingMax;
}

class SightingRows : public SensorRows
{
 public:
  SightingRows(const std::string& path, const core::FieldOfView& fov, Associations& associations)
      : SensorRows(TextTable::csv(path)), fov_(fov), associations_(&associations)
  {
    table_.matchHeader({{"t", "range", "bearing", "std_range", "std_bearing", "id"}});
    advance();
  }

 private:
  void add(core::Step& step, Counts& counts) override
  {
    if (!step.landmarks) step.landmarks.emplace().fov = fov_;
    if (table_.emptyFrom(1)) return;
    const Polar p = polar(table_, 1, false);
    const int id = table_.integer(5, core::kNoId);
    if (!inView(fov_, p))
    {
      ++step.dropped;
      ++counts.outOfView;
      return;
    }
    auto& list = step.landmarks->sightings;
    if (id != core::kNoId) associations_->push_back({step.time, static_cast<int>(list.size()), id});
    list.push_back({*p.range, p.bearing, p.rangeStd, p.bearingStd, id});
  }

  core::FieldOfView fov_;
  Associations* associations_;
};

class BlobRows : public SensorRows
{
 public:
  BlobRows(const std::string& path, const core::FieldOfView& fov)
      : SensorRows(TextTable::csv(path)), fov_(fov)
  {
    table_.matchHeader({{"t", "label", "range", "bearing", "std_range", "std_bearing", "id"}});
    advance();
  }

 private:
  [[nodiscard]] std::string label() const
  {
    const std::string_view text = table_.text(1);
    bool plain = !text.empty();
    for (const char c : text) plain = plain && c >= ' ' && c <= '~' && c != '"';
    if (!plain)
      table_.failAt(1, ExitStatus::kUnreadable, quoted(text) + " is not a label",
                    "write a word of plain characters, such as target or robot");
    return std::string(text);
  }

  void add(core::Step& step, Counts& counts) override
  {
    if (!step.blobs) step.blobs.emplace().fov = fov_;
    if (table_.emptyFrom(1)) return;
    const Polar p = polar(table_, 2, true);
    core::Blob blob{label(),    p.range,      p.bearing,
                    p.rangeStd, p.bearingStd, table_.integer(6, core::kNoId)};
    if (inView(fov_, p))
    {
      step.blobs->blobs.push_back(std::move(blob));
      return;
    }
    ++step.dropped;
    ++counts.outOfView;
  }

  core::FieldOfView fov_;
};

class LaserRows : public SensorRows
{
 public:
  explicit LaserRows(const std::string& path) : SensorRows(TextTable::csv(path))
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

void SensorRows::advance()
{
  time_.reset();
  if (!table_.next()) return;
  const double time = table_.number(0);
  if (time < last_)
    table_.failAt(0, ExitStatus::kNonsense, "the time goes backwards",
                  "sort the rows by time; times count from the start, 0");
  last_ = time;
  time_ = time;
}

void SensorRows::take(core::Step& step, Counts& counts)
{
  add(step, counts);
  advance();
}

std::vector<std::unique_ptr<SensorRows>> openSensors(const std::string& folder,
                                                     const core::FieldOfView& fov,
                                                     Associations& associations)
{
  std::vector<std::unique_ptr<SensorRows>> out;
  const std::string sightings = folder + "/landmark_sightings.csv", blobs = folder + "/blobs.csv",
                    lasers = folder + "/scans.csv";
  if (exists(sightings))
    out.push_back(std::make_unique<SightingRows>(sightings, fov, associations));
  if (exists(blobs)) out.push_back(std::make_unique<BlobRows>(blobs, fov));
  if (exists(lasers)) out.push_back(std::make_unique<LaserRows>(lasers));
  return out;
}
}  // namespace slamot::importers
