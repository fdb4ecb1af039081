#pragma once

#include <slamot/reproduce/Condition.h>
#include <slamot/study/StudySpec.h>

namespace slamot::reproduce
{
/// What a paper claims, and how it is judged; section [claim.<name>].
struct Claim
{
  struct Part
  {
    std::string label;  ///< in words; empty: the condition's own
    Condition condition;
  };
  std::string name;
  std::string says;   ///< the claim, in our words
  std::string where;  ///< in the paper
  std::string note;   ///< for the reader, whatever the verdict
  std::vector<Part> parts;
  std::string untestable;  ///< why it can't be tested; empty: it can
};

/// A picture of one run; section [picture.<name>].
struct Picture
{
  enum class Kind
  {
    kMap,           ///< paths, targets and landmarks from above
    kScans,         ///< laser returns, drawn from the estimated path and from odometry
    kRobotErrors,   ///< over time, with the filter's own bounds
    kTargetErrors,  ///< the same of the first target
    kNees
  };
  std::string name, caption;
  Kind kind = Kind::kMap;
  std::string method;
  std::map<std::string, std::string> cell;  ///< axes by name, values as shown; absent: the first
  std::uint64_t seed = 1;
};

/// A part of a paper and the study that repeats it; section [section.<name>].
struct Section
{
  std::string name, title, text;
  std::string studyPath;                           ///< empty: nothing is run
  std::vector<std::string> set;                    ///< what is changed in the study, as by --set
  bool isLeftOut = false;                          ///< of a quick reproduction
  study::StudySpec study;                          ///< with these changes, if it is run
  std::vector<std::string> tables, folded, plots;  ///< of the study: names
  std::vector<Picture> pictures;
  std::vector<Claim> claims;

  [[nodiscard]] bool isRun() const { return !studyPath.empty() && !isLeftOut; }
};

/// What is repeated of one paper: an ini file reproduce.<name>.ini.
struct PaperSpec
{
  std::string name;  ///< of the file, without reproduce. and .ini
  std::string title, citation, text;
  std::vector<Section> sections;

  struct Options
  {
    bool isQuick = false;
    std::vector<std::string> set;  ///< Section.key=value, as of --set
    std::optional<std::uint64_t> firstSeed;
  };
  /// Reads it and its studies; files that it names are relative to its own.
  /// \throws core::Error (kConfig) naming file, section and key: also on a claim about a metric, a
  /// method or a cell that its study has not.
  static PaperSpec load(const std::string& path, const Options& options);
};

/// What a name stands for: a reproduction in `folder` (reproduce.<name>.ini), or a file's own path;
/// and where that file has a section [papers], those that it lists.
struct PaperList
{
  std::string title;               ///< empty: that of the one paper
  std::vector<std::string> files;  ///< paths
  /// \throws core::Error (kConfig) if there is none.
  static PaperList find(const std::string& name, const std::string& folder);
};
}  // namespace slamot::reproduce
