#pragma once

#include <slamot/core/Step.h>
#include <slamot/importers/Carmen.h>
#include <slamot/importers/TextTable.h>

#include <map>

/// The messages of a CARMEN log that tell of laser scans and odometry.
namespace slamot::importers::carmen
{
struct Message
{
  double time = 0;                              ///< ipc_timestamp [s]
  std::size_t order = 0;                        ///< among all messages of the file
  Pose2D odometry;                              ///< of the robot, in odometry's own frame
  bool isOdometry = false;                      ///< an ODOM line, else a scan's message
  std::shared_ptr<const core::LaserScan> scan;  ///< none: of an ODOM line, or of no beams
};

/// Messages in rising order of time.
class Log
{
 public:
  Log(const std::string& path, const CarmenOptions& options);

  std::optional<Message> next();

  [[nodiscard]] const TextTable& table() const { return table_; }
  [[nodiscard]] std::size_t unknown() const { return unknown_; }
  /// The first kinds that are not known, for a warning.
  [[nodiscard]] const std::vector<std::string>& unknownKinds() const { return unknownKinds_; }

 private:
  [[nodiscard]] bool mustRead() const;
  bool read();
  void noteUnknown(std::string_view kind);

  const CarmenOptions* options_;
  TextTable table_;
  // Of one instant, poses of odometry go first.
  std::map<std::tuple<double, bool, std::size_t>, Message> queue_;
  std::size_t queuedBeams_ = 0, order_ = 0;
  bool ended_ = false;
  double delivered_ = -1e300, newest_ = -1e300;
  std::size_t unknown_ = 0;
  std::vector<std::string> unknownKinds_;
};

/// The message in a row, if it is of a kind that is read here.
/// \param known is set to whether the kind is known at all.
std::optional<Message> readMessage(const TextTable& row, const CarmenOptions& options, bool& known);
}  // namespace slamot::importers::carmen
