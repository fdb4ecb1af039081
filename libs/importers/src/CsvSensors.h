#pragma once

#include <slamot/core/Step.h>
#include <slamot/importers/Import.h>
#include <slamot/importers/TextTable.h>

#include <memory>

namespace slamot::importers
{
/// The rows of one sensor's file, read one ahead.
class SensorRows
{
 public:
  virtual ~SensorRows() = default;

  /// Time of the next row [s]; none at the end.
  [[nodiscard]] std::optional<double> time() const { return time_; }
  /// Adds the next row to a step and goes on.
  void take(core::Step& step, Counts& counts);

 protected:
  SensorRows(TextTable table, double startTime)
      : table_(std::move(table)), start_(startTime), last_(startTime)
  {
  }
  void advance();
  virtual void add(core::Step& step, Counts& counts) = 0;

  TextTable table_;

 private:
  std::optional<double> time_;
  double start_, last_;
};

/// What the sightings' rows tell of which landmark was seen, for the truth.
using Associations = std::vector<eval::TrueAssociation>;

/// Each opens one file, whose times must not lie before the start; sightings with an id are noted
/// in `associations`, which must live on.
std::unique_ptr<SensorRows> sightingRows(const std::string& path, double startTime,
                                         const core::FieldOfView& fov, Associations& associations);
std::unique_ptr<SensorRows> blobRows(const std::string& path, double startTime,
                                     const core::FieldOfView& fov);
std::unique_ptr<SensorRows> laserRows(const std::string& path, double startTime);

/// The rows of landmark_sightings.csv, blobs.csv and scans.csv, as far as the folder has them.
std::vector<std::unique_ptr<SensorRows>> openSensors(const std::string& folder, double startTime,
                                                     const core::FieldOfView& fov,
                                                     Associations& associations);
}  // namespace slamot::importers
