#include <slamot/core/Error.h>
#include <slamot/results/RecordFiles.h>
#include <slamot/results/ResultFolder.h>
#include <slamot/results/TextFile.h>
#include <unistd.h>

#include <exception>
#include <filesystem>

namespace slamot::results
{
namespace fs = std::filesystem;
namespace
{
using core::Error;
using core::ExitStatus;

constexpr const char* kSummary = "summary.json";
constexpr const char* kTeam = "team.json";  // in its place, in a team's folder

// Without a slash at the end, so that a name can be added.
fs::path placeOf(const std::string& path)
{
  const fs::path place = fs::absolute(path).lexically_normal();
  return place.has_filename() ? place : place.parent_path();
}

// The nearest folder upwards that is there.
fs::path existingParent(fs::path path)
{
  while (!fs::exists(path) && path.has_relative_path()) path = path.parent_path();
  return path;
}
}  // namespace

std::string defaultFolder(const std::string& method, const std::string& dataset)
{
  return (fs::path("slamot-out") / (method + "-" + fs::path(dataset).stem().string())).string();
}

void requirePlaceFor(const std::string& path)
{
  const fs::path place = placeOf(path);
  std::error_code error;
  if (fs::exists(place, error))
  {
    const bool free = fs::is_directory(place, error) &&
                      (fs::is_empty(place, error) || fs::exists(place / kSummary, error) ||
                       fs::exists(place / kTeam, error));
    if (!free)
      throw Error(ExitStatus::kConfig, path, "is there and is no older result",
                  "give another --output");
  }
  const fs::path parent = existingParent(place.parent_path());
  if (!fs::is_directory(parent, error) || access(parent.c_str(), W_OK) != 0)
    throw Error(ExitStatus::kConfig, path, "can't be made in " + parent.string(),
                "give another --output");
}

ResultFolder::ResultFolder(const std::string& path) : path_(placeOf(path).string())
{
  requirePlaceFor(path);
  temporary_ = path_ + ".partial-" + std::to_string(getpid());
  std::error_code error;
  fs::remove_all(temporary_, error);
  fs::create_directories(temporary_, error);
  if (error)
    throw Error(ExitStatus::kUnreadable, path_, "can't be made: " + error.message(),
                "give another --output");
}

ResultFolder::~ResultFolder()
{
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void ResultFolder::publish()
{
  const std::string old = path_ + ".old-" + std::to_string(getpid());
  std::error_code error;
  if (fs::exists(path_)) fs::rename(path_, old, error);
  if (!error) fs::rename(temporary_, path_, error);
  if (error)
    throw Error(ExitStatus::kUnreadable, path_, "can't be replaced: " + error.message(),
                "give another --output");
  fs::remove_all(old, error);
}

void writeResult(const std::string& path, const RunInfo& info, const eval::Record& record,
                 const eval::Evaluation& evaluation, const Timing& timing,
                 const std::function<void(const std::string& folder)>& addFiles)
{
  ResultFolder folder(path);
  const auto file = [&](const char* name)
  { return (fs::path(folder.temporary()) / name).string(); };
  saveRecord(folder.temporary(), record);
  writeWhole(file("config.ini"), info.config);
  std::exception_ptr failure;
  try
  {
    if (addFiles) addFiles(folder.temporary());
  }
  catch (...)
  {
    failure = std::current_exception();  // pictures can be made again, a long run not so easily
  }
  writeWhole(file(kSummary), summaryJson(info, record, evaluation, timing));
  folder.publish();
  if (failure) std::rethrow_exception(failure);
}
}  // namespace slamot::results
