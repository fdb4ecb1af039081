#pragma once

#include <slamot/reproduce/Condition.h>
#include <slamot/study/StudySpec.h>

namespace slamot::reproduce
{
/// What a paper claims, and how it is judged; section [claim.NAME].
struct Claim
{
  /// One condition, with a label for the page.
  struct Part
  {
    std::string label;    ///< in words; empty: the condition's own
    Condition condition;  ///< what must be so
  };
  std::string name;         ///< of its section
  std::string says;         ///< the claim, in our words
  std::string where;        ///< in the paper
  std::string note;         ///< for the reader, whatever the verdict
  std::vector<Part> parts;  ///< all must be met for the claim to hold
  std::string untestable;   ///< why it can't be tested; empty: it can
};

/// A picture of one run; section [picture.NAME].
struct Picture
{
  /// What is drawn.
  enum class Kind
  {
    kMap,           ///< paths, targets and landmarks from above
    kScans,         ///< laser returns, drawn from the estimated path and from odometry
    kRobotErrors,   ///< over time, with the filter's own bounds
    kTargetErrors,  ///< the same of the first target
    kNees           ///< normalised squared errors, with the band of a consistent filter
  };
  std::string name;                         ///< of its section
  std::string caption;                      ///< below it
  Kind kind = Kind::kMap;                   ///< which of these
  std::string method;                       ///< of the study, by its name
  std::map<std::string, std::string> cell;  ///< axes by name, values as shown; absent: the first
  std::uint64_t seed = 1;                   ///< of the run
};

/// A part of a paper and the study that repeats it; section [section.NAME].
struct Section
{
  std::string name;                 ///< of its section
  std::string title;                ///< heading on the page
  std::string text;                 ///< below the heading
  std::string studyPath;            ///< empty: nothing is run
  std::string shownPath;            ///< the same for a reader: does not depend on the machine
  std::vector<std::string> set;     ///< what is changed in the study, as by --set
  bool isLeftOut = false;           ///< of a quick reproduction
  study::StudySpec study;           ///< with these changes, if it is run
  std::vector<std::string> tables;  ///< of the study: names
  std::vector<std::string> folded;  ///< tables that the page shows when asked to: names
  std::vector<std::string> plots;   ///< of the study: names
  std::vector<Picture> pictures;    ///< in the order of the page
  std::vector<Claim> claims;        ///< that this study decides

  /// Whether there is a study to run for it.
  [[nodiscard]] bool isRun() const { return !studyPath.empty() && !isLeftOut; }
};

/// What is repeated of one paper: an ini file reproduce.NAME.ini.
struct PaperSpec
{
  std::string name;               ///< of the file, without reproduce. and .ini
  std::string title;              ///< of the paper
  std::string citation;           ///< who, where, when
  std::string text;               ///< what the page says first about it
  std::vector<Section> sections;  ///< in the order of the page

  /// What the command line changes in all papers.
  struct Options
  {
    bool isQuick = false;  ///< fewer seeds and cells: the keys `quick.` of sections are heeded
    std::vector<std::string> set;            ///< Section.key=value, as of --set
    std::optional<std::uint64_t> firstSeed;  ///< of each study; absent: its own
  };
  /// Reads it and its studies; files that it names are relative to its own.
  /// \throws core::Error (kConfig) naming file, section and key: also on a claim about a metric, a
  /// method or a cell that its study has not.
  static PaperSpec load(const std::string& path, const Options& options);
};

/// What a name stands for: a reproduction in `folder` (reproduce.NAME.ini), or a file's own path;
/// and where that file has a section [papers], those that it lists.
struct PaperList
{
  std::string title;               ///< empty: that of the one paper
  std::vector<std::string> files;  ///< paths
  /// \throws core::Error (kConfig) if there is none.
  static PaperList find(const std::string& name, const std::string& folder);
};
}  // namespace slamot::reproduce
