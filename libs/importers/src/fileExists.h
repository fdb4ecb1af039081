#pragma once

#include <filesystem>
#include <string>

namespace slamot::importers
{
/// Also false where nobody may look.
inline bool fileExists(const std::string& path)
{
  std::error_code error;
  return std::filesystem::exists(path, error);
}
}  // namespace slamot::importers
