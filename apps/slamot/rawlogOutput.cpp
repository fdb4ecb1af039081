#include "rawlogOutput.h"

#include <slamot/core/Error.h>

#include <filesystem>

namespace slamot::apps
{
namespace fs = std::filesystem;
using core::Error;
using core::ExitStatus;

std::string rawlogOutput(const std::string& path)
{
  if (fs::path(path).extension() != ".rawlog")
    throw Error(ExitStatus::kConfig, "--output " + path, "is not named as a rawlog",
                "end it in .rawlog");
  const fs::path folder = fs::path(path).parent_path();
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error)
    throw Error(ExitStatus::kUnreadable, folder.string(), "can't be made: " + error.message(),
                "write elsewhere");
  return path;
}

std::string count(std::size_t n, const std::string& what)
{
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}
}  // namespace slamot::apps
