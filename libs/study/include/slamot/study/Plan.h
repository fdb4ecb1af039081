#pragma once

#include <slamot/study/StudySpec.h>

namespace slamot::study
{
/// One combination of a log (if there are several) and of values of the axes.
struct Cell
{
  std::size_t rawlog = 0;           ///< place in StudySpec::rawlogs; 0 in a simulated study
  std::vector<std::size_t> values;  ///< places in Axis::values, one for each axis
};

/// A method under conditions of its own.  Cells that make no difference to a method share a group,
/// so nothing is run twice: odometry does not care for the number of particles.
struct Group
{
  std::size_t cell = 0;    ///< the first that it is for
  std::size_t method = 0;  ///< place in StudySpec::methods
  std::string hash;        ///< of all that its results depend on, but the seed
  std::string folder;      ///< of its records, within the folder of records
};

/// One seed of a group.
struct Run
{
  std::size_t group = 0;   ///< place in Plan::groups
  std::uint64_t seed = 0;  ///< of the world, if simulated, and of the filter
};

/// What a study consists of.
struct Plan
{
  StudySpec spec;           ///< what it was laid out from
  std::vector<Cell> cells;  ///< each combination of logs and of axes' values, the last axis fastest
  std::vector<Group> groups;                      ///< all that differ in what they run
  std::vector<std::vector<std::size_t>> groupOf;  ///< by cell and method
  std::vector<Run> runs;  ///< all seeds of the first group, of the second, ...

  /// Lays out the study; opens every group's data and filter once, so that what is wrong with them
  /// is known before hours of work.  \throws core::Error as openTrial().
  explicit Plan(StudySpec study);

  /// The place of a group's run with a seed, by the seed's place.
  [[nodiscard]] std::size_t runAt(std::size_t group, int seedPlace) const
  {
    return group * static_cast<std::size_t>(spec.seeds) + static_cast<std::size_t>(seedPlace);
  }
  /// A record's path within the study's folder.
  [[nodiscard]] std::string recordPath(const Run& run) const;
  /// What a cell is, for tables: the log, if there are several, then the values.
  [[nodiscard]] std::vector<std::string> cellValues(const Cell& cell) const;
  /// The heads of these columns: labels, or names for files.
  [[nodiscard]] std::vector<std::string> cellLabels() const;
  /// The same as names for files: those of the axes' sections.
  [[nodiscard]] std::vector<std::string> cellNames() const;
};
}  // namespace slamot::study
