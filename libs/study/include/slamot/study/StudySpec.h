#pragma once

#include <slamot/core/Config.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace slamot::study
{
/// An ini file that a study refers to, as it was read, and what the study changes in it.
struct ConfigFile
{
  std::string name;                                         ///< for messages
  std::string text;                                         ///< as read
  std::vector<std::pair<std::string, std::string>> values;  ///< Section.key and what it is set to

  /// The file with the study's values.  \throws core::Error (kConfig) on a malformed file.
  [[nodiscard]] core::Config config() const;
};

/// A filter with its configuration; section [method.NAME].
struct Method
{
  std::string name;   ///< of its section
  std::string label;  ///< for tables and plots
  ConfigFile file;    ///< its configuration
};

/// What is varied; section [vary.NAME].
struct Axis
{
  std::string name;   ///< of its section
  std::string label;  ///< for tables and plots
  /// Section.key, each of the scenario or of methods.
  std::vector<std::string> keys;
  std::vector<std::string> values;  ///< as shown
  /// What the keys are set to, by value and key: all to the same, or each to a word of its own.
  std::vector<std::vector<std::string>> settings;
};

/// Metrics side by side; section [table.NAME].
struct TableSpec
{
  std::string name;                  ///< of its section
  std::string title;                 ///< above the table
  std::vector<std::string> metrics;  ///< the columns, by metrics() names
  std::string reference;  ///< the method by whose means others' are divided; empty: means
  std::vector<std::string> methods;  ///< the rows; empty: all
};

/// A figure of metrics over an axis, or of errors over a run's time, one panel for each: section
/// [plot.NAME].
struct PlotSpec
{
  std::string name;                  ///< of its section, and of the files
  std::string title;                 ///< above the plot
  bool overTime = false;             ///< x = time: see ErrorCurves
  std::size_t axis = 0;              ///< else: place in StudySpec::axes
  std::vector<std::string> metrics;  ///< or names of curves
  /// Only cells with these values: places of axes and of values in them.
  std::map<std::size_t, std::size_t> fixed;
  std::vector<std::string> methods;  ///< only these; empty: all
  bool logX = false;                 ///< logarithmic axis
  bool logY = false;                 ///< logarithmic axis
};

/// Figures that others published, printed beside: section [published.NAME].
struct Published
{
  std::string label;                            ///< for the row
  std::string method;                           ///< whose row it stands under; empty: at the end
  std::map<std::string, std::string> byAxis;    ///< and in which cells; by name, as shown
  std::map<std::string, std::string> byMetric;  ///< as printed there
};

/// Sets `Section.key=value`, as of --set, where the key may itself be a Section.key of another
/// file: it belongs to the longest of the sections.  \param more sections that need not be there
/// \throws core::Error (kConfig) on another form.
void assign(core::Config& config, const std::string& assignment,
            const std::vector<std::string>& more = {});

/// A Monte-Carlo study: methods, data, what is varied, seeds, and what is to be shown.
struct StudySpec
{
  std::string name;                  ///< the file's name
  std::string title;                 ///< of the page of tables
  std::string note;                  ///< below the title
  bool simulated = true;             ///< else rawlogs
  ConfigFile scenario;               ///< if simulated
  std::vector<std::string> rawlogs;  ///< else: paths
  std::vector<Method> methods;       ///< in the order of [study] methods
  std::string reference;             ///< the method to which others are compared; empty: none
  std::vector<Axis> axes;            ///< in the order of [study] vary
  int seeds = 1;                     ///< how many, from firstSeed on
  std::uint64_t firstSeed = 1;       ///< the least
  std::string align;                 ///< auto | none | first-pose | rigid
  double landmarkCutoff = 1;         ///< see eval::EvaluationOptions [m]
  double gospaCutoff = 1;            ///< the same [m]
  bool bound = true;                 ///< if simulated: whether to compute each world's bound
  int timeBins = 0;                  ///< parts of a run's time in which to keep its errors; 0: none
  std::vector<TableSpec> tables;     ///< of the page, in the order of [study] tables
  std::vector<PlotSpec> plots;       ///< in the order of the file
  std::vector<Published> published;  ///< in the order of the file
  std::string effective;             ///< the study itself as an ini text, see repeatable()

  /// Reads a study; files that it names are relative to its own.  `set` are overrides, as of --set.
  /// \throws core::Error (kConfig) naming file, section and key; kUnreadable for a missing rawlog.
  static StudySpec load(const std::string& path, const std::vector<std::string>& set = {});
};
}  // namespace slamot::study
