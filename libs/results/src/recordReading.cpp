#include <slamot/core/Error.h>
#include <slamot/results/RecordFiles.h>
#include <slamot/results/Summary.h>
#include <slamot/results/TextFile.h>
#include <slamot/results/Tum.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <functional>

namespace slamot::results
{
namespace fs = std::filesystem;
namespace
{
using Outcome = core::Pairing::Outcome;

/// One line of a CSV file, read from left to right.
class CsvRow
{
 public:
  CsvRow(const LineReader& line, std::size_t columns) : line_(line), parts_(line.commaSeparated())
  {
    if (parts_.size() != columns)
      line.fail("has " + std::to_string(parts_.size()) + " columns, not " + std::to_string(columns),
                "mend the line");
  }
  double number() { return line_.number(parts_[at_++], "value"); }
  int whole() { return line_.wholeNumber(parts_[at_++], "value"); }
  std::string_view text() { return parts_[at_++]; }
  std::optional<double> optional()
  {
    if (!parts_[at_].empty()) return number();
    ++at_;
    return std::nullopt;
  }
  Gaussian<Pose2D> pose()
  {
    Gaussian<Pose2D> g;
    g.mean.x = number(), g.mean.y = number(), g.mean.phi = number();
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) g.cov(i, j) = g.cov(j, i) = number();
    return g;
  }

 private:
  const LineReader& line_;
  std::vector<std::string_view> parts_;
  std::size_t at_ = 0;
};

// Reads a file that may be absent; `read` takes one row.
void readCsv(const fs::path& path, std::size_t columns,
             const std::function<void(CsvRow&, const LineReader&)>& read)
{
  if (!fs::exists(path)) return;
  LineReader line(path.string());
  if (!line.next() || line.commaSeparated().size() != columns)
    line.fail("the header has not " + std::to_string(columns) + " columns",
              "give a folder that slamot run wrote");
  while (line.next())
  {
    if (line.text().empty()) continue;
    CsvRow row(line, columns);
    read(row, line);
  }
}

void readRobot(const fs::path& folder, eval::Record& record)
{
  readCsv(folder / "robot.csv", 10,
          [&](CsvRow& row, const LineReader& line)
          {
            eval::RobotRow out;
            out.time = row.number();
            out.robot = row.pose();
            if (!record.rows.empty() && out.time <= record.rows.back().time)
              line.fail("the time is not after the line's before", "sort by time");
            record.rows.push_back(out);
          });
}

void readOdometry(const fs::path& folder, eval::Record& record)
{
  const fs::path path = folder / "odometry.tum";
  record.hasOdometry = fs::exists(path);
  if (!record.hasOdometry) return;
  const eval::Trajectory odometry = loadTum(path.string());
  for (eval::RobotRow& row : record.rows)
  {
    const auto pose = odometry.at(row.time);
    if (!pose)
      throw core::Error(core::ExitStatus::kNonsense, path.string(), "ends before robot.csv",
                        "give a folder that slamot run wrote");
    row.odometry = pose->pose;
  }
}

void readTarget(const fs::path& path, int id, eval::Record& record)
{
  eval::TargetTrack track;
  track.id = id;
  readCsv(path, 15,
          [&](CsvRow& row, const LineReader& line)
          {
            const double time = row.number();
            const auto at = std::lower_bound(record.rows.begin(), record.rows.end(), time,
                                             [](const auto& r, double t) { return r.time < t; });
            if (at == record.rows.end() || at->time != time)
              line.fail("robot.csv has no such time", "give a folder that slamot run wrote");
            eval::TargetRow out;
            out.row = static_cast<std::size_t>(at - record.rows.begin());
            out.pose = row.pose();
            out.velocity.x() = row.number();
            out.velocity.y() = row.number();
            out.lastSeen = row.number();
            track.identified = row.whole() != 0;
            track.label = row.text();
            track.rows.push_back(out);
          });
  if (!track.rows.empty()) record.targets.push_back(std::move(track));
}

void readTargets(const fs::path& folder, eval::Record& record)
{
  std::vector<int> ids;
  for (const auto& entry : fs::directory_iterator(folder))
  {
    const std::string name = entry.path().filename().string();
    int id = 0;
    if (name.rfind("target_", 0) != 0) continue;
    std::from_chars(name.data() + 7, name.data() + name.size(), id);
    if (name == "target_" + std::to_string(id) + ".csv") ids.push_back(id);
  }
  std::sort(ids.begin(), ids.end());
  for (const int id : ids)
    readTarget(folder / ("target_" + std::to_string(id) + ".csv"), id, record);
  std::stable_partition(record.targets.begin(), record.targets.end(),
                        [](const eval::TargetTrack& t) { return t.identified; });
}

void readLandmarks(const fs::path& folder, eval::Record& record)
{
  readCsv(folder / "landmarks.csv", 7,
          [&](CsvRow& row, const LineReader&)
          {
            core::LandmarkEstimate m;
            m.id = row.whole();
            m.position.mean.x = row.number(), m.position.mean.y = row.number();
            m.position.cov(0, 0) = row.number();
            m.position.cov(0, 1) = m.position.cov(1, 0) = row.number();
            m.position.cov(1, 1) = row.number();
            m.sightings = row.whole();
            record.landmarks.push_back(m);
          });
}

void readDiagnostics(const fs::path& folder, eval::Record& record)
{
  readCsv(folder / "diagnostics.csv", 8,
          [&](CsvRow& row, const LineReader&)
          {
            eval::StepRow s;
            s.time = row.number();
            s.scan = row.whole() != 0;
            s.ess = row.optional();
            s.resampled = row.whole() != 0;
            s.known = row.whole(), s.created = row.whole(), s.rejected = row.whole();
            s.dropped = row.whole();
            record.steps.push_back(s);
          });
  // A scan belongs to the first row that is not before it.
  for (const eval::StepRow& s : record.steps)
  {
    if (!s.scan) continue;
    const auto at = std::lower_bound(record.rows.begin(), record.rows.end(), s.time,
                                     [](const auto& r, double t) { return r.time < t; });
    if (at != record.rows.end()) at->scan = true;
  }
}

void readPairings(const fs::path& folder, eval::Record& record)
{
  readCsv(folder / "pairings.csv", 6,
          [&](CsvRow& row, const LineReader& line)
          {
            eval::PairingRow p;
            p.time = row.number();
            p.pairing.isBlob = row.text() == "blob";
            p.pairing.index = row.whole();
            p.seenId = row.whole();
            const std::string_view outcome = row.text();
            if (outcome != "known" && outcome != "new" && outcome != "rejected")
              line.fail("the outcome is not known, new or rejected", "mend the line");
            p.pairing.outcome = outcome == "known" ? Outcome::kKnown
                                : outcome == "new" ? Outcome::kNew
                                                   : Outcome::kRejected;
            p.pairing.id = row.whole();
            record.pairings.push_back(p);
          });
}
}  // namespace

eval::Record loadTumRecord(const std::string& path)
{
  eval::Record record;
  record.hasOdometry = false;
  for (const eval::TimedPose& p : loadTum(path).poses)
  {
    eval::RobotRow row;
    row.time = p.time;
    row.robot.mean = p.pose;
    record.rows.push_back(row);
  }
  return record;
}

eval::Record loadRecord(const std::string& folder)
{
  const fs::path path(folder);
  if (!fs::exists(path / "robot.csv"))
  {
    if (fs::exists(path / "robot.tum")) return loadTumRecord((path / "robot.tum").string());
    throw core::Error(core::ExitStatus::kUnreadable, folder,
                      "is no result folder: it has no robot.csv and no robot.tum",
                      "give a folder that slamot run wrote, or a TUM file");
  }
  eval::Record record;
  readRobot(path, record);
  readOdometry(path, record);
  if (const fs::path final = path / "path" / "robot.tum"; fs::exists(final))
    record.path = loadTum(final.string());
  readTargets(path, record);
  if (const auto summary = loadSummary(folder))
  {
    record.hasMap = summary->hasMap;
    record.complete = summary->complete;
    record.observations = summary->observations;
    record.particles = summary->particles;
  }
  readLandmarks(path, record);
  readDiagnostics(path, record);
  readPairings(path, record);
  return record;
}
}  // namespace slamot::results
