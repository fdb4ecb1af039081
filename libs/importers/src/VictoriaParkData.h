#pragma once

#include <slamot/core/Step.h>
#include <slamot/eval/Truth.h>
#include <slamot/importers/TextTable.h>
#include <slamot/importers/VictoriaPark.h>

/// The tables of the Victoria Park log, each read row by row.
namespace slamot::importers::victoria_park
{
inline constexpr int kBeams = 361;  ///< from right to left in half degrees

/// inputs.txt: speed and steering, each held until the next row.
class Inputs
{
 public:
  Inputs(const std::string& folder, const VictoriaParkOptions& options);

  [[nodiscard]] double begin() const { return begin_; }
  [[nodiscard]] double progress() const { return table_.progress(); }

  struct Motion
  {
    double end = 0;          ///< the time asked for, or that of the last row [s]
    Gaussian<Pose2D> mount;  ///< of the laser's mount
  };
  /// The motion from where the last one ended (at first begin()) to a time not before that.
  Motion until(double time);

 private:
  struct Row
  {
    double time = 0, speed = 0, steering = 0;
  };
  std::optional<Row> read();

  const VictoriaParkOptions* options_;
  TextTable table_;
  double begin_ = 0, time_ = 0;
  std::optional<Row> row_, next_;
};

/// A table whose rows tell of scans, in rising order of time.
class ScanTable
{
 public:
  /// Opens it at its first row.  \param delay [s] is taken off the times.
  ScanTable(TextTable table, double delay);

  /// When the scan of this row was taken; none at the end [s].
  [[nodiscard]] std::optional<double> time() const { return time_; }
  [[nodiscard]] const TextTable& row() const { return table_; }
  void advance();

 private:
  TextTable table_;
  double delay_ = 0, logged_ = 0;
  std::optional<double> time_;
};

/// trees.txt.
class Trees
{
 public:
  Trees(const std::string& folder, const VictoriaParkOptions& options);

  /// When the next tree was seen; none at the end [s].
  [[nodiscard]] std::optional<double> time() const { return table_.time(); }
  struct Tree
  {
    double range = 0, bearing = 0;  ///< from the laser, bearing 0 ahead [m, rad]
  };
  /// All trees of that time.
  std::vector<Tree> take();

 private:
  ScanTable table_;
};

/// laser_cm.txt, where there is one.
class Lasers
{
 public:
  Lasers(const std::string& folder, const VictoriaParkOptions& options);

  [[nodiscard]] bool exist() const { return table_.has_value(); }
  /// When the next scan was taken; none at the end [s].
  [[nodiscard]] std::optional<double> time() const
  {
    return table_ ? table_->time() : std::nullopt;
  }
  /// The scan of that time.
  std::shared_ptr<const core::LaserScan> take();

 private:
  double yaw_;
  std::optional<ScanTable> table_;
};

/// The GPS fixes, without heading; empty if there is no such file.
eval::Trajectory readFixes(const std::string& folder);
}  // namespace slamot::importers::victoria_park
