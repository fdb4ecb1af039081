#pragma once

#include <slamot/reproduce/PaperSpec.h>
#include <slamot/study/execute.h>
#include <slamot/study/results.h>

#include <memory>

namespace slamot::reproduce
{
/// A study of a paper, laid out; sections of the same paper that ask for the same share it.
struct StudyRun
{
  std::string folder;                 ///< within that of the reproduction
  std::string path;                   ///< of its file
  std::vector<std::string> set;       ///< what its sections change in the study, as by --set
  std::unique_ptr<study::Plan> plan;  ///< its cells and runs
  study::Outcome outcome;             ///< once collected
};

/// A picture of one run, as drawn: one or two SVG images side by side, or why there is none.
struct Drawn
{
  std::vector<std::pair<std::string, std::string>>
      titlesAndImages;  ///< images are SVG; empty: there is none
  std::string missing;  ///< why there is none; else empty
};

/// Papers with their studies: laid out, run by study::execute(), collected, and shown as one page.
class Reproduction
{
 public:
  /// As PaperSpec::Options.
  struct Options
  {
    bool isQuick = false;                    ///< see PaperSpec::Options
    std::vector<std::string> set;            ///< Section.key=value, as of --set
    std::optional<std::uint64_t> firstSeed;  ///< see PaperSpec::Options
  };

  /// Lays out all studies of the papers that a name stands for, see PaperList::find().
  /// \throws core::Error as PaperSpec::load() and study::Plan.
  Reproduction(const std::string& name, const std::string& configFolder, const Options& options);

  /// What is to be run, with its folders in `folder`.
  [[nodiscard]] std::vector<study::Job> jobs(const std::string& folder) const;

  /// Reads the records that are in these folders, which may each hold a part.
  void collect(const std::vector<std::string>& folders);

  /// Makes the pictures that are not in `folder` yet, or of something else, and reads all.
  /// \return false if it was stopped
  bool draw(const std::string& folder, const std::atomic<bool>* stop);

  /// Writes each study's tables, as slamot study does, and reproduction.html, last and whole.
  /// \return what the user should know: plots are missing; else empty
  /// \throws core::Error (kUnreadable) if a file can't be written.
  [[nodiscard]] std::string publish(const std::string& folder) const;

  /// Whether seeds and cells are those of a quick reproduction.
  [[nodiscard]] bool isQuick() const { return isQuick_; }
  /// As it was asked for: a paper's, or a list's.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Of the page.
  [[nodiscard]] const std::string& title() const { return title_; }
  /// In the order of the page.
  [[nodiscard]] const std::vector<PaperSpec>& papers() const { return papers_; }
  /// In the order in which papers ask for them; none twice in a paper.
  [[nodiscard]] const std::vector<StudyRun>& studies() const { return studies_; }
  /// A section's study; null if it has none, or is left out.
  [[nodiscard]] const StudyRun* studyOf(std::size_t paper, std::size_t section) const;
  /// Its pictures, in the order of the section; empty until drawn.
  [[nodiscard]] const std::vector<Drawn>& picturesOf(std::size_t paper, std::size_t section) const;
  /// Runs that are missing, and that failed.
  [[nodiscard]] std::size_t missing() const;
  /// Runs that threw.
  [[nodiscard]] std::size_t failed() const;

 private:
  void layOut(const PaperSpec& paper, const std::string& within);

  std::string name_, title_;
  bool isQuick_ = false;
  std::vector<PaperSpec> papers_;
  std::vector<StudyRun> studies_;
  std::vector<std::vector<std::optional<std::size_t>>> places_;  ///< in studies_
  std::vector<std::vector<std::vector<Drawn>>> pictures_;
};

/// The whole page.  It depends on the records and pictures alone, not on who made them; its last
/// section, `cost`, on the CPU times in them.
/// \param missingPlots is told why plots are missing; else left empty
[[nodiscard]] std::string pageOf(const Reproduction& reproduction, std::string& missingPlots);
}  // namespace slamot::reproduce
