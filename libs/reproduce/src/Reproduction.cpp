#include <slamot/reproduce/Reproduction.h>

#include <slamot/core/Config.h>
#include <slamot/core/Error.h>
#include <slamot/results/TextFile.h>

#include <algorithm>
#include <filesystem>

#include "pictures.h"

namespace slamot::reproduce
{
namespace
{
namespace fs = std::filesystem;

/// `study.<name>.ini` gives the name.
std::string folderOf(const std::string& studyPath)
{
  std::string name = fs::path(studyPath).stem().string();
  if (name.rfind("study.", 0) == 0) name = name.substr(6);
  return name;
}

bool isOf(const core::Config& paper, const std::string& assignment)
{
  const auto sections = paper.sections();
  return std::any_of(sections.begin(), sections.end(),
                     [&](const std::string& s) { return assignment.rfind(s + ".", 0) == 0; });
}

/// What is set in each of the papers: of several, in those that have the section.
std::vector<std::vector<std::string>> setsOf(const std::vector<std::string>& files,
                                             const std::vector<std::string>& set)
{
  if (files.size() == 1) return {set};
  std::vector<std::vector<std::string>> out(files.size());
  for (const std::string& assignment : set)
  {
    bool isTaken = false;
    for (std::size_t i = 0; i < files.size(); ++i)
    {
      if (!isOf(core::Config::load(files[i]), assignment)) continue;
      out[i].push_back(assignment);
      isTaken = true;
    }
    if (!isTaken)
      throw core::Error(core::ExitStatus::kConfig, "--set " + assignment,
                        "no paper has such a section",
                        "write one of theirs, as section.table1.set.study.seeds=50");
  }
  return out;
}
}  // namespace

Reproduction::Reproduction(const std::string& name, const std::string& configFolder,
                           const Options& options)
    : name_(name), isQuick_(options.isQuick)
{
  const PaperList list = PaperList::find(name, configFolder);
  const auto sets = setsOf(list.files, options.set);
  for (std::size_t i = 0; i < list.files.size(); ++i)
    papers_.push_back(
        PaperSpec::load(list.files[i], {options.isQuick, sets[i], options.firstSeed}));
  title_ = list.title.empty() ? papers_.front().title : list.title;
  for (const PaperSpec& paper : papers_) layOut(paper, list.title.empty() ? "" : paper.name + "/");
}

void Reproduction::layOut(const PaperSpec& paper, const std::string& within)
{
  auto& places = places_.emplace_back();
  auto& pictures = pictures_.emplace_back();
  for (const Section& section : paper.sections)
  {
    places.emplace_back();
    pictures.emplace_back();
    if (!section.isRun()) continue;
    const auto isSame = [&](const StudyRun& s) {
      return s.path == section.studyPath && s.set == section.set && s.folder.rfind(within, 0) == 0;
    };
    const auto same = std::find_if(studies_.begin(), studies_.end(), isSame);
    places.back() = static_cast<std::size_t>(same - studies_.begin());
    if (same != studies_.end()) continue;
    std::string folder = within + folderOf(section.studyPath);
    const auto isTaken = [&](const StudyRun& s) { return s.folder == folder; };
    // Another study, or the same with other settings: its records are others.
    while (std::any_of(studies_.begin(), studies_.end(), isTaken)) folder += "." + section.name;
    studies_.push_back(
        {folder, section.studyPath, section.set, std::make_unique<study::Plan>(section.study), {}});
  }
}

std::vector<study::Job> Reproduction::jobs(const std::string& folder) const
{
  std::vector<study::Job> out;
  for (const StudyRun& s : studies_)
    out.push_back({s.plan.get(), (fs::path(folder) / s.folder).string()});
  return out;
}

void Reproduction::collect(const std::vector<std::string>& folders)
{
  for (StudyRun& s : studies_)
  {
    std::vector<std::string> parts;
    for (const std::string& folder : folders)
      parts.push_back((fs::path(folder) / s.folder).string());
    s.outcome = study::collect(*s.plan, parts);
  }
}

bool Reproduction::draw(const std::string& folder, const std::atomic<bool>* stop)
{
  for (std::size_t p = 0; p < papers_.size(); ++p)
    for (std::size_t s = 0; s < papers_[p].sections.size(); ++s)
    {
      const StudyRun* study = studyOf(p, s);
      pictures_[p][s].clear();
      if (!study) continue;
      for (const Picture& picture : papers_[p].sections[s].pictures)
      {
        if (stop && stop->load()) return false;
        pictures_[p][s].push_back(
            drawn(picture, *study->plan, (fs::path(folder) / study->folder).string()));
      }
    }
  return true;
}

std::string Reproduction::publish(const std::string& folder) const
{
  std::string missingPlots;
  const std::string page = pageOf(*this, missingPlots);
  for (const StudyRun& s : studies_)
  {
    const std::string own = (fs::path(folder) / s.folder).string();
    study::saveSpec(own, s.plan->spec);
    study::saveTables(own, *s.plan, s.outcome);
  }
  std::error_code error;
  fs::create_directories(folder, error);  // there may be no study; writing tells what is wrong
  results::writeWhole((fs::path(folder) / "reproduction.html").string(), page);
  return missingPlots.empty() ? std::string()
                              : "reproduction.html: made without plots: " + missingPlots;
}

const StudyRun* Reproduction::studyOf(std::size_t paper, std::size_t section) const
{
  const auto place = places_[paper][section];
  return place ? &studies_[*place] : nullptr;
}

const std::vector<Drawn>& Reproduction::picturesOf(std::size_t paper, std::size_t section) const
{
  return pictures_[paper][section];
}

std::size_t Reproduction::missing() const
{
  std::size_t out = 0;
  for (const StudyRun& s : studies_) out += s.outcome.missing;
  return out;
}

std::size_t Reproduction::failed() const
{
  std::size_t out = 0;
  for (const StudyRun& s : studies_) out += s.outcome.failed;
  return out;
}
}  // namespace slamot::reproduce
