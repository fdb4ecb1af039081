#include "film.h"

#include <slamot/core/Error.h>
#include <slamot/video/VideoFile.h>

#include <algorithm>
#include <cmath>

#include "Command.h"
#include "Progress.h"
#include "modules.h"

namespace slamot::apps
{
namespace
{
using core::Error;
using core::ExitStatus;

constexpr double kLongest = 30;      // [s], unless a speed is given
constexpr double kMostFrames = 1e5;  // over an hour

void requireEven(const char* option, int pixels)
{
  if (pixels % 2 == 0) return;
  throw Error(ExitStatus::kConfig, std::string("command line ") + option,
              std::to_string(pixels) + " is odd, which a video's size can't be",
              "take " + std::to_string(pixels + 1));
}

/// Seconds of the run between frames.
double stepOf(const Story& story, const FilmOptions& options)
{
  const double speed = options.speed.value_or(std::max(1.0, story.duration() / kLongest));
  const double frames = story.duration() / speed * options.fps;
  if (!(frames <= kMostFrames))
    throw Error(ExitStatus::kConfig, "command line --speed",
                "would make over " + std::to_string(static_cast<int>(kMostFrames)) + " frames",
                "raise it, or lower --fps");
  return speed / options.fps;
}

void add(video::VideoFile& file, const ::mrpt::img::CImage& picture)
{
  file.add(picture.ptr<unsigned char>(0, 0), picture.getRowStride());
}
}  // namespace

bool writeFilm(const std::string& path, const Story& story, const mrpt::RenderOptions& look,
               const FilmOptions& options)
{
  requireEven("--width", look.width);
  requireEven("--height", look.height);
  const std::vector<std::size_t> rows = momentsOf(story, stepOf(story, options));
  auto& open = *moduleFunction<video::OpenVideo>("slamot-video", video::kOpenVideo);
  const auto file = open(path, {look.width, look.height, options.fps});
  mrpt::Renderer renderer(story.whole(), look);
  Progress progress("frames", false);
  ::mrpt::img::CImage picture;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    if (interrupted) return false;
    if (i == 0 || rows[i] != rows[i - 1]) picture = renderer.draw(story.at(rows[i]));
    add(*file, picture);
    progress.update(i + 1, static_cast<double>(i + 1) / static_cast<double>(rows.size()));
  }
  for (long i = 1; i < std::lround(options.fps); ++i) add(*file, picture);
  file->finish();
  return true;
}
}  // namespace slamot::apps
