#include "ImagesBeside.h"

#include <slamot/core/Error.h>
#include <slamot/mrpt/RawlogEditor.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace slamot::apps
{
namespace
{
namespace fs = std::filesystem;
using core::Error;
using core::ExitStatus;

constexpr const char *kPrefix = "CAMERA_", *kEnding = ".png";

bool isLink(const fs::path& path)
{
  std::error_code error;
  return fs::is_symlink(fs::symlink_status(path, error));
}

bool isThere(const fs::path& path)
{
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

/// Whether it can be lost: a link, or a folder of nothing but simulated images.
bool isOurs(const fs::path& folder)
{
  if (isLink(folder)) return true;
  std::error_code error;
  if (!fs::is_directory(folder, error)) return false;
  fs::directory_iterator files(folder, error);
  return !error && std::all_of(begin(files), end(files),
                               [](const fs::directory_entry& entry)
                               {
                                 const std::string name = entry.path().filename().string();
                                 return entry.is_regular_file() && name.rfind(kPrefix, 0) == 0 &&
                                        entry.path().extension() == kEnding;
                               });
}

void check(const fs::path& path, const std::error_code& error, const char* what)
{
  if (error)
    throw Error(ExitStatus::kUnreadable, path.string(), what + (": " + error.message()),
                "choose another place with --output");
}
}  // namespace

ImagesBeside::ImagesBeside(const std::string& log)
    : folder_(mrpt::RawlogEditor::imagesFolder(log)),
      temporary_(folder_ + ".partial-" + std::to_string(::getpid()))
{
  if (isThere(folder_) && !isOurs(folder_))
    throw Error(ExitStatus::kConfig, folder_,
                "is there and holds other files than simulated images, which are to replace it",
                "move it away, or give another --output");
}

ImagesBeside::~ImagesBeside()
{
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

std::string ImagesBeside::nameOf(double time)
{
  char name[64];
  std::snprintf(name, sizeof name, "%s%.6f%s", kPrefix, time, kEnding);
  return name;
}

std::string ImagesBeside::pathOf(const std::string& name) const
{
  return (fs::path(temporary_) / name).string();
}

void ImagesBeside::place()
{
  std::error_code error;
  fs::remove_all(folder_, error);
  check(folder_, error, "can't be replaced");
  if (fs::exists(temporary_)) fs::rename(temporary_, folder_, error);
  check(folder_, error, "can't be written");
}

void requirePlaceForLink(const std::string& to)
{
  const std::string link = mrpt::RawlogEditor::imagesFolder(to);
  if (isThere(link) && !isLink(link))
    throw Error(ExitStatus::kConfig, link,
                "is there, and the new log would take its images for its own",
                "move it away, or give another --output");
}

void linkImages(const std::string& from, const std::string& to)
{
  const fs::path source = mrpt::RawlogEditor::imagesFolder(from);
  const fs::path link = mrpt::RawlogEditor::imagesFolder(to);
  std::error_code error;
  if (isLink(link)) fs::remove(link, error);
  check(link, error, "can't be replaced");
  std::error_code absent;
  if (fs::is_directory(source, absent))
    fs::create_directory_symlink(fs::absolute(source), link, error);
  check(link, error, "can't be made");
}
}  // namespace slamot::apps
