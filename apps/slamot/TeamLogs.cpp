#include "TeamLogs.h"

#include <slamot/core/Error.h>
#include <slamot/results/TruthFiles.h>
#include <unistd.h>

#include <filesystem>

#include "rawlogOutput.h"

namespace slamot::apps
{
namespace fs = std::filesystem;
using core::Error;
using core::ExitStatus;

TeamLogs::TeamLogs(const std::string& rawlog)
    : stem_(fs::path(rawlogOutput(rawlog)).replace_extension().string()),
      folder_(stem_ + "." + std::to_string(::getpid()) + ".part")
{
  std::error_code error;
  fs::create_directory(folder_, error);
  if (error)
    throw Error(ExitStatus::kUnreadable, rawlog, "can't be written: " + error.message(),
                "write elsewhere");
}

TeamLogs::~TeamLogs()
{
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

std::string TeamLogs::pathOf(int robot) const
{
  return stem_ + ".robot" + std::to_string(robot) + ".rawlog";
}

std::string TeamLogs::partOf(int robot) const
{
  return (fs::path(folder_) / fs::path(pathOf(robot)).filename()).string();
}

void TeamLogs::place()
{
  std::vector<std::string> made;
  try
  {
    placeAll(made);
  }
  catch (...)
  {
    std::error_code ignored;
    for (const std::string& path : made) fs::remove_all(path, ignored);
    throw;
  }
}

void TeamLogs::placeAll(std::vector<std::string>& made) const
{
  for (const auto& [robot, truth] : truths_)
  {
    const std::string folder = results::truthFolder(pathOf(robot));
    if (!fs::exists(folder)) made.push_back(folder);
    results::saveTruth(folder, truth);
  }
  for (const auto& [robot, truth] : truths_)
  {
    std::error_code error;
    fs::rename(partOf(robot), pathOf(robot), error);
    if (error)
      throw Error(ExitStatus::kUnreadable, pathOf(robot), "can't be written: " + error.message(),
                  "write elsewhere");
    made.push_back(pathOf(robot));
  }
}
}  // namespace slamot::apps
