#include <slamot/results/CsvText.h>
#include <slamot/results/RecordFiles.h>
#include <slamot/results/TextFile.h>
#include <slamot/results/Tum.h>

#include <algorithm>
#include <filesystem>

namespace slamot::results
{
namespace
{
using Outcome = core::Pairing::Outcome;

constexpr const char* kPoseColumns = "t,x,y,theta,cxx,cxy,cxt,cyy,cyt,ctt";

std::string robotCsv(const eval::Record& record)
{
  CsvText csv(kPoseColumns);
  for (const eval::RobotRow& row : record.rows) csv.add(row.time).add(row.robot).endRow();
  return csv.text();
}

std::string targetCsv(const eval::Record& record, const eval::TargetTrack& track)
{
  CsvText csv(std::string(kPoseColumns) + ",vx,vy,last_seen,identified,label");
  for (const eval::TargetRow& row : track.rows)
    csv.add(record.rows[row.row].time)
        .add(row.pose)
        .add(row.velocity.x())
        .add(row.velocity.y())
        .add(row.lastSeen)
        .add(track.identified ? 1 : 0)
        .add(track.label)
        .endRow();
  return csv.text();
}

std::string landmarksCsv(const eval::Record& record)
{
  CsvText csv("id,x,y,cxx,cxy,cyy,sightings");
  for (const core::LandmarkEstimate& m : record.landmarks)
  {
    const auto& [mean, cov] = m.position;
    csv.add(m.id).add(mean.x).add(mean.y).add(cov(0, 0)).add(cov(0, 1)).add(cov(1, 1));
    csv.add(m.sightings).endRow();
  }
  return csv.text();
}

std::string diagnosticsCsv(const eval::Record& record)
{
  CsvText csv("t,scan,ess,resampled,known,new,rejected,dropped");
  for (const eval::StepRow& s : record.steps)
  {
    csv.add(s.time).add(s.scan ? 1 : 0);
    s.ess ? csv.add(*s.ess) : csv.nothing();
    csv.add(s.resampled ? 1 : 0).add(s.known).add(s.created).add(s.rejected).add(s.dropped);
    csv.endRow();
  }
  return csv.text();
}

std::string pairingsCsv(const eval::Record& record)
{
  CsvText csv("t,kind,index,seen_id,outcome,id");
  for (const eval::PairingRow& p : record.pairings)
  {
    const Outcome o = p.pairing.outcome;
    csv.add(p.time).add(std::string(p.pairing.isBlob ? "blob" : "landmark")).add(p.pairing.index);
    csv.add(p.seenId);
    csv.add(std::string(o == Outcome::kKnown ? "known" : o == Outcome::kNew ? "new" : "rejected"));
    csv.add(p.pairing.id).endRow();
  }
  return csv.text();
}

eval::Trajectory robotPath(const eval::Record& record)
{
  eval::Trajectory out;
  for (const eval::RobotRow& row : record.rows) out.poses.push_back({row.time, row.robot.mean});
  return out;
}

eval::Trajectory odometryPath(const eval::Record& record)
{
  eval::Trajectory out;
  for (const eval::RobotRow& row : record.rows) out.poses.push_back({row.time, row.odometry});
  return out;
}

eval::Trajectory targetPath(const eval::Record& record, const eval::TargetTrack& track)
{
  eval::Trajectory out;
  for (const eval::TargetRow& row : track.rows)
    out.poses.push_back({record.rows[row.row].time, row.pose.mean});
  return out;
}
}  // namespace

void saveRecord(const std::string& folder, const eval::Record& record)
{
  const auto path = [&](const std::string& name)
  { return (std::filesystem::path(folder) / name).string(); };
  saveTum(path("robot.tum"), robotPath(record));
  if (!record.path.empty())
  {
    std::filesystem::create_directories(path("path"));
    saveTum(path("path/robot.tum"), record.path);
  }
  writeWhole(path("robot.csv"), robotCsv(record));
  if (record.hasOdometry) saveTum(path("odometry.tum"), odometryPath(record));
  for (const eval::TargetTrack& track : record.targets)
  {
    const std::string name = "target_" + std::to_string(track.id);
    saveTum(path(name + ".tum"), targetPath(record, track));
    writeWhole(path(name + ".csv"), targetCsv(record, track));
  }
  writeWhole(path("landmarks.csv"), landmarksCsv(record));
  writeWhole(path("diagnostics.csv"), diagnosticsCsv(record));
  writeWhole(path("pairings.csv"), pairingsCsv(record));
}
}  // namespace slamot::results
