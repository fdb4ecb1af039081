#include "CsvSensors.h"

#include "fileExists.h"

namespace slamot::importers
{
void SensorRows::advance()
{
  time_.reset();
  if (!table_.next()) return;
  const double time = table_.number(0);
  if (time < last_)
    table_.failAt(0, core::ExitStatus::kNonsense,
                  last_ == start_ ? "the time lies before the start" : "the time goes backwards",
                  last_ == start_ ? "times count from the start: 0, or --start-time"
                                  : "sort the rows by time");
  last_ = time;
  time_ = time;
}

void SensorRows::take(core::Step& step, Counts& counts)
{
  add(step, counts);
  advance();
}

std::vector<std::unique_ptr<SensorRows>> openSensors(const std::string& folder, double startTime,
                                                     const core::FieldOfView& fov,
                                                     Associations& associations)
{
  std::vector<std::unique_ptr<SensorRows>> out;
  const std::string sightings = folder + "/landmark_sightings.csv", blobs = folder + "/blobs.csv",
                    lasers = folder + "/scans.csv";
  if (fileExists(sightings)) out.push_back(sightingRows(sightings, startTime, fov, associations));
  if (fileExists(blobs)) out.push_back(blobRows(blobs, startTime, fov));
  if (fileExists(lasers)) out.push_back(laserRows(lasers, startTime));
  return out;
}
}  // namespace slamot::importers
