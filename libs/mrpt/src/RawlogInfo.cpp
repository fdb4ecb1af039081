#include <mrpt/obs/CAction.h>
#include <mrpt/obs/CObservation.h>
#include <slamot/mrpt/RawlogInfo.h>

#include <cctype>
#include <cstdio>
#include <filesystem>
#include <map>

#include <slamot/mrpt/timestamp.h>
#include "scanLog.h"

namespace slamot::mrpt
{
namespace
{
constexpr std::size_t kMostSensors = 1000;  // further labels count as one
constexpr std::size_t kMostLabels = 20;     // further ones are not told
constexpr double kShortestStep = 1e-4;      // [s]; on average, below it times are not of the drive

// Fit for a terminal, whatever a damaged or strange log holds.
std::string printable(const std::string& label)
{
  constexpr std::size_t kLongest = 60;
  std::string out = label.substr(0, kLongest);
  for (char& c : out)
    if (std::isprint(static_cast<unsigned char>(c)) == 0) c = '?';
  return out;
}

class SensorTable
{
 public:
  void add(const Entry::Part& part)
  {
    std::string label;
    std::optional<double> time;
    if (const auto* o = dynamic_cast<const ::mrpt::obs::CObservation*>(part.object.get()))
      label = printable(o->sensorLabel), time = toSeconds(o->timestamp);
    else if (const auto* a = dynamic_cast<const ::mrpt::obs::CAction*>(part.object.get()))
      time = toSeconds(a->timestamp);
    if (sensors_.size() >= kMostSensors) label = "(further labels)";
    SensorInfo& sensor = sensors_[{part.className, label}];
    sensor.className = part.className, sensor.label = label;
    sensor.used = sensor.used || part.object != nullptr;
    ++sensor.count;
    if (!time) return;
    if (!sensor.firstTime) sensor.firstTime = time;
    sensor.lastTime = time;
  }

  [[nodiscard]] std::vector<SensorInfo> list() const
  {
    std::vector<SensorInfo> out;
    for (const auto& [key, sensor] : sensors_) out.push_back(sensor);
    return out;
  }

 private:
  std::map<std::pair<std::string, std::string>, SensorInfo> sensors_;
};

void count(const core::Step& step, RawlogInfo& info)
{
  if (step.landmarks)
  {
    SightingInfo& seen = info.landmarks;
    ++seen.scans;
    seen.empty += step.landmarks->sightings.empty() ? 1 : 0;
    seen.count += step.landmarks->sightings.size();
    seen.ranged = seen.count;
    for (const core::Sighting& s : step.landmarks->sightings)
      seen.identified += s.id != core::kNoId ? 1 : 0;
  }
  if (!step.blobs) return;
  SightingInfo& seen = info.blobs;
  ++seen.scans;
  seen.empty += step.blobs->blobs.empty() ? 1 : 0;
  seen.count += step.blobs->blobs.size();
  for (const core::Blob& b : step.blobs->blobs)
  {
    seen.identified += b.id != core::kNoId ? 1 : 0;
    seen.ranged += b.range ? 1 : 0;
    if (seen.labels.size() < kMostLabels) seen.labels.insert(printable(b.label));
  }
}

// With stand-ins for what a config would give, so that their want does not hide other faults.
RawlogSource::Options lenient()
{
  RawlogSource::Options options;
  options.odometry.fromLog = false;
  return options;
}

std::string format(const char* text, std::size_t n)
{
  char out[160];
  std::snprintf(out, sizeof out, text, n);
  return out;
}

void addNotes(RawlogInfo& info, const LogFacts& facts)
{
  const auto note = [&](const std::string& text) { info.notes.push_back(text); };
  if (info.steps == 0) note("holds no odometry, landmark sighting, blob or laser scan");
  if (lacksCovariance(facts))
    note(
        "odometry comes without covariance: set [odometer] noise = model, v_std_mps and "
        "omega_std_deg_per_s");
  if (info.dropped > 0)
    note(format("%zu sightings are at range zero or below, or out of the field of view: dropped",
                info.dropped));
  if (facts.beginsWithFrame)
    note(
        "begins with a frame: it and the last action belong to no pair, left out; set [log] "
        "first_frame = use to use it");
  if (info.steps > 0 && !info.firstTime)
    note("no entry has a valid time: steps are taken 0.1 s apart");
  else if (info.steps > 10 &&
           *info.lastTime - *info.firstTime < kShortestStep * static_cast<double>(info.steps))
    note(
        "times are too close together to be those of the drive: set [log] step_period_s to replace "
        "them");
  for (const SensorInfo& sensor : info.sensors)
    if (!sensor.used)
      note("slamot does not use " + sensor.className +
           (sensor.className == "mrpt::obs::CObservationImage" ? " but in slamot detect" : ""));
}
}  // namespace

std::optional<double> SensorInfo::rate() const
{
  if (count < 2 || !firstTime || !(*lastTime > *firstTime)) return std::nullopt;
  return static_cast<double>(count - 1) / (*lastTime - *firstTime);
}

RawlogInfo inspectRawlog(const std::string& path)
{
  RawlogInfo info;
  SensorTable table;
  const auto onEntry = [&](const Entry& entry)
  {
    ++info.entries;
    if (entry.kind == Entry::Kind::kComment) return;
    for (const Entry::Part& part : entry.parts) table.add(part);
  };
  const LogScan scan =
      scanLog(path, lenient(), onEntry, [&](const core::Step& step) { count(step, info); });
  std::error_code none;
  if (std::filesystem::is_regular_file(path, none))
    info.bytes = std::filesystem::file_size(path, none);
  info.error = scan.error;
  info.packed = scan.facts.packed, info.hasFrames = scan.facts.hasFrames;
  info.steps = scan.facts.steps, info.dropped = scan.facts.dropped;
  info.firstTime = scan.facts.firstTime, info.lastTime = scan.facts.lastTime;
  info.sensors = table.list();
  addNotes(info, scan.facts);
  try
  {
    info.starts = startsOf(scan.facts, path);
  }
  catch (const core::Error& e)
  {
    if (!info.error) info.error = e;
  }
  return info;
}
}  // namespace slamot::mrpt
