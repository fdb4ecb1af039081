#pragma once

#include "Story.h"

namespace slamot::apps
{
struct FilmOptions
{
  double fps = 25;
  std::optional<double> speed;  ///< seconds of the run in one of the film; none: at most 30 s of it
};

/// Writes an mp4 of a run, whole or not at all.  Its last picture stays for a second.
/// \return false if it was interrupted.
/// \throws core::Error: kConfig for sizes that a video can't have, or too many frames; kUnreadable
/// if it can't be written; kInternal where there is no OpenGL.
bool writeFilm(const std::string& path, const Story& story, const mrpt::RenderOptions& look,
               const FilmOptions& options);
}  // namespace slamot::apps
