#pragma once

#include <slamot/core/Error.h>

#include <filesystem>
#include <string>

namespace slamot::mrpt
{
/// Through a temporary, so that the file is there whole or not at all.
/// \param save writes to the path that it is given; false: it failed.
/// \throws core::Error of kUnreadable if it can't be written.
template <class Save>
void saveWhole(const std::string& path, const Save& save)
{
  const std::filesystem::path p(path);
  // A picture's format goes by the name's end.
  const std::string temporary = (p.parent_path() / ("partial." + p.filename().string())).string();
  std::error_code error;
  if (save(temporary)) std::filesystem::rename(temporary, path, error);
  const bool done = !error && std::filesystem::exists(path);
  std::filesystem::remove(temporary, error);
  if (!done)
    throw core::Error(core::ExitStatus::kUnreadable, path, "can't be written",
                      "check the folder and its space");
}
}  // namespace slamot::mrpt
