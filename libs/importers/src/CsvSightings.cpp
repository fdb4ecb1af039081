#include "CsvSensors.h"

namespace slamot::importers
{
namespace
{
using core::ExitStatus;

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
  SightingRows(const std::string& path, double startTime, const core::FieldOfView& fov,
               Associations& associations)
      : SensorRows(TextTable::csv(path), startTime), fov_(fov), associations_(&associations)
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
  BlobRows(const std::string& path, double startTime, const core::FieldOfView& fov)
      : SensorRows(TextTable::csv(path), startTime), fov_(fov)
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

}  // namespace

std::unique_ptr<SensorRows> sightingRows(const std::string& path, double startTime,
                                         const core::FieldOfView& fov, Associations& associations)
{
  return std::make_unique<SightingRows>(path, startTime, fov, associations);
}

std::unique_ptr<SensorRows> blobRows(const std::string& path, double startTime,
                                     const core::FieldOfView& fov)
{
  return std::make_unique<BlobRows>(path, startTime, fov);
}
}  // namespace slamot::importers
