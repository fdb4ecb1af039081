#include <slamot/core/Error.h>
#include <slamot/importers/CsvFolder.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <filesystem>

#include "CsvExtras.h"
#include "CsvOdometry.h"
#include "CsvSensors.h"

namespace slamot::importers
{
namespace
{
constexpr double kSameTime = 1e-6;  // [s]

class CsvFolder : public Import
{
 public:
  CsvFolder(const std::string& folder, double startTime)
      : odometry_(folder, startTime),
        starts_(readStarts(folder)),
        truth_(readTruth(folder)),
        sensors_(openSensors(folder, startTime, readFov(folder), seen_))
  {
    starts_.time = counts_.start = startTime;
    // What was seen before the robot moved makes a step of its own.
    if (auto step = sensed(startTime)) steps_.push_back(std::move(*step));
  }

  std::optional<core::Step> next() override
  {
    while (steps_.empty())
    {
      const auto motion = odometry_.next();
      if (!motion)
      {
        finish();
        return std::nullopt;
      }
      checkFirst(*motion);
      cut(*motion);
    }
    core::Step step = std::move(steps_.front());
    steps_.pop_front();
    return deliver(std::move(step));
  }

  [[nodiscard]] double progress() const override { return odometry_.progress(); }
  [[nodiscard]] const core::Starts& starts() const override { return starts_; }
  [[nodiscard]] const eval::Truth& truth() const override { return truth_; }

 private:
  /// When a sensor reports next [s]; none at the end.
  [[nodiscard]] std::optional<double> nextReport() const
  {
    std::optional<double> first;
    for (const auto& rows : sensors_)
      if (rows->time() && (!first || *rows->time() < *first)) first = rows->time();
    return first;
  }

  /// A step of what sensors report up to a time, without odometry; none if they report nothing.
  std::optional<core::Step> sensed(double time)
  {
    std::optional<core::Step> step;
    for (auto& rows : sensors_)
      while (rows->time() && *rows->time() <= time + kSameTime)
      {
        if (!step) step.emplace().time = time;
        rows->take(*step, counts_);
      }
    return step;
  }

  /// Makes the steps of one step of odometry: one, or more if sensors report within it.
  void cut(const OdometryStep& odometry)
  {
    const double duration = odometry.end - odometry.begin;
    double from = 0;
    for (auto t = nextReport(); t && *t < odometry.end - kSameTime; t = nextReport())
    {
      core::Step step = *sensed(*t);
      const double to = (*t - odometry.begin) / duration;
      step.odometry = odometry.motion.part(from, to);
      steps_.push_back(std::move(step));
      from = to;
    }
    core::Step step = sensed(odometry.end).value_or(core::Step{});
    step.time = odometry.end;
    step.odometry = odometry.motion.part(from, 1);
    steps_.push_back(std::move(step));
  }

  /// Warns of a first step that holds a velocity for far longer than the second: a clock that did
  /// not start with the drive.
  void checkFirst(const OdometryStep& odometry)
  {
    const double duration = odometry.end - odometry.begin;
    if (++odometrySteps_ == 1) firstDuration_ = duration;
    if (odometrySteps_ != 2 || firstDuration_ < 1 || firstDuration_ < 10 * duration) return;
    char text[200];
    std::snprintf(
        text, sizeof text,
        "odometry.csv: the first step lasts %.6g s, from %.10g s on, the second %.6g s; if "
        "the drive began later, give --start-time",
        firstDuration_, starts_.time.value_or(0), duration);
    warnings_.emplace_back(text);
  }

  /// Reads what is left, so that its faults are found, and settles the truth.
  void finish()
  {
    core::Step late;
    Counts lateCounts;
    const std::size_t known = seen_.size();
    for (auto& rows : sensors_)
      while (rows->time()) rows->take(late, lateCounts);
    seen_.resize(known);
    counts_.outOfTime += static_cast<std::size_t>(late.dropped) + late.lasers.size() +
                         (late.landmarks ? late.landmarks->sightings.size() : 0) +
                         (late.blobs ? late.blobs->blobs.size() : 0);
    for (const eval::TrueAssociation& a : seen_)
      if (truth_.landmarks.count(a.id)) truth_.associations.push_back(a);
    seen_.clear();
  }

  CsvOdometry odometry_;
  core::Starts starts_;
  eval::Truth truth_;
  Associations seen_;
  std::vector<std::unique_ptr<SensorRows>> sensors_;
  std::deque<core::Step> steps_;
  std::size_t odometrySteps_ = 0;
  double firstDuration_ = 0;  // [s]
};
}  // namespace

std::unique_ptr<Import> openCsvFolder(const std::string& folder, double startTime)
{
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw core::Error(core::ExitStatus::kUnreadable, folder, "is not a folder",
                      "give a folder with an odometry.csv");
  return std::make_unique<CsvFolder>(folder, startTime);
}
}  // namespace slamot::importers
