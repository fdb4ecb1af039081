#include <slamot/reproduce/PaperSpec.h>

#include <slamot/core/Error.h>
#include <slamot/core/Params.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "paperReading.h"

namespace slamot::reproduce
{
namespace
{
namespace fs = std::filesystem;

/// Names in a list, none of them twice; none at all where the key is missing.
std::vector<std::string> names(core::Params& p, const std::string& key)
{
  std::vector<std::string> out;
  if (!p.has(key)) return out;
  std::set<std::string> seen;
  for (const std::string& name : p.list(key))
  {
    if (!seen.insert(name).second) p.fail(key, name + " comes twice", "remove one");
    out.push_back(name);
  }
  return out;
}

/// Keys `set.Section.key` and `quick.Section.key` as assignments, the latter if they count; what
/// the command line sets counts most.
std::vector<std::string> overrides(core::Params& p, const PaperSpec::Options& options)
{
  const auto isTold = [&](const std::string& key)
  {
    const std::string told = p.section() + ".set." + key + "=";
    return std::any_of(options.set.begin(), options.set.end(),
                       [&](const std::string& s) { return s.rfind(told, 0) == 0; });
  };
  std::vector<std::string> out;
  for (const std::string& key : p.keys())
  {
    const bool isSet = key.rfind("set.", 0) == 0, isQuick = key.rfind("quick.", 0) == 0;
    if (!isSet && !isQuick) continue;
    const std::string name = key.substr(key.find('.') + 1), value = p.text(key);
    const bool hasQuick = options.isQuick && p.has("quick." + name) && !isTold(name);
    if (isSet != hasQuick) out.push_back(name + "=" + value);
  }
  if (options.firstSeed) out.push_back("study.first_seed=" + std::to_string(*options.firstSeed));
  return out;
}

template <class List>
void checkNames(core::Params& p, const std::string& key, const std::vector<std::string>& wanted,
                const List& there, const std::string& what)
{
  for (const std::string& name : wanted)
  {
    const auto isIt = [&](const auto& x) { return x.name == name; };
    if (std::any_of(there.begin(), there.end(), isIt)) continue;
    std::string known;
    for (const auto& x : there) known += (known.empty() ? "" : ", ") + x.name;
    p.fail(key, "'" + name + "' is no " + what + " of its study",
           known.empty() ? "it has none" : "known: " + known);
  }
}

/// \return the study as its file has it: what is left out of a quick reproduction is there.
study::StudySpec readStudy(core::Params& p, const fs::path& folder, Section& section)
{
  const std::string path = (folder / section.studyPath).string();
  if (!fs::is_regular_file(path))
    p.fail("study", path + " can't be read", "studies are relative to this file");
  // From where the shipped ones are named; of others, from where the paper is.
  const bool isShipped = folder.filename() == "config-ini";
  section.shownPath = (isShipped ? "config-ini/" : "") + section.studyPath;
  section.studyPath = path;
  study::StudySpec asFiled = study::StudySpec::load(path);
  section.study = section.set.empty() ? asFiled : study::StudySpec::load(path, section.set);
  return asFiled;
}

Section readSection(core::Config& paper, const std::string& name, const fs::path& folder,
                    const PaperSpec::Options& options)
{
  core::Params p(paper, "section." + name);
  Section out;
  out.name = name;
  out.title = p.text("title", name);
  out.text = p.text("text", "");
  out.studyPath = p.text("study", "");
  out.isLeftOut = !p.flag("in_quick", true) && options.isQuick;
  out.set = overrides(p, options);
  out.tables = names(p, "tables");
  out.folded = names(p, "folded");
  out.plots = names(p, "plots");
  const auto pictures = names(p, "pictures"), claims = names(p, "claims");
  if (out.studyPath.empty())
  {
    if (!out.tables.empty() || !out.plots.empty() || !pictures.empty() || !out.folded.empty())
      p.fail("study", "missing", "tables, plots and pictures are of a study: name its file");
    out.claims = readClaims(paper, p, claims, nullptr);
    return out;
  }
  const study::StudySpec asFiled = readStudy(p, folder, out);
  checkNames(p, "tables", out.tables, out.study.tables, "table");
  checkNames(p, "folded", out.folded, out.study.tables, "table");
  checkNames(p, "plots", out.plots, out.study.plots, "plot");
  const Studies studies{asFiled, out.study};
  out.pictures = readPictures(paper, p, pictures, studies);
  out.claims = readClaims(paper, p, claims, &studies);
  return out;
}

/// `reproduce.<name>.ini` gives the name.
std::string nameOf(const std::string& path)
{
  std::string name = fs::path(path).stem().string();
  if (name.rfind("reproduce.", 0) == 0) name = name.substr(10);
  return name;
}

/// What is there, for messages.
std::string known(const std::string& folder)
{
  std::vector<std::string> found;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
  {
    const std::string file = entry.path().filename().string();
    if (file.rfind("reproduce.", 0) == 0 && entry.path().extension() == ".ini")
      found.push_back(nameOf(file));
  }
  std::sort(found.begin(), found.end());
  std::string out;
  for (const std::string& name : found) out += (out.empty() ? "" : ", ") + name;
  return out.empty() ? "there is none in " + folder : "known: " + out;
}
}  // namespace

PaperSpec PaperSpec::load(const std::string& path, const Options& options)
{
  core::Config paper = core::Config::load(path);
  for (const std::string& assignment : options.set) study::assign(paper, assignment);
  core::Params p(paper, "paper");
  PaperSpec out;
  out.name = nameOf(path);
  out.title = p.text("title");
  out.citation = p.text("citation");
  out.text = p.text("text", "");
  const fs::path folder = fs::path(path).parent_path();
  std::set<std::string> claims;
  for (const std::string& name : p.list("sections"))
  {
    if (!paper.has("section." + name))
      p.fail("sections", "there is no [section." + name + "]", "add it");
    out.sections.push_back(readSection(paper, name, folder, options));
    for (const Claim& claim : out.sections.back().claims)
      if (!claims.insert(claim.name).second)
        core::Params(paper, "section." + name)
            .fail("claims", claim.name + " is of another section, too", "name it once");
  }
  paper.requireAllRead();
  return out;
}

PaperList PaperList::find(const std::string& name, const std::string& folder)
{
  const bool isPath = name.find('/') != std::string::npos || fs::path(name).extension() == ".ini";
  const std::string path =
      isPath ? name : (fs::path(folder) / ("reproduce." + name + ".ini")).string();
  if (!fs::is_regular_file(path))
    throw core::Error(core::ExitStatus::kConfig, isPath ? path : "reproduce " + name,
                      isPath ? "can't be read" : "is not known",
                      isPath ? "give the path of a reproduction" : known(folder));
  core::Config config = core::Config::load(path);
  if (!config.has("papers")) return {"", {path}};
  core::Params p(config, "papers");
  PaperList out{p.text("title"), {}};
  for (const std::string& file : names(p, "files"))
  {
    out.files.push_back((fs::path(path).parent_path() / file).string());
    if (!fs::is_regular_file(out.files.back()))
      p.fail("files", out.files.back() + " can't be read", "they are relative to this file");
  }
  if (out.files.empty()) p.fail("files", "missing", "list reproductions, as reproduce.mine.ini");
  config.requireAllRead();
  return out;
}
}  // namespace slamot::reproduce
