#pragma once

#include <memory>
#include <string>

namespace slamot::video
{
/// An mp4 in the making.  It is in its place once finish() has returned; without that, nothing is.
class VideoFile
{
 public:
  virtual ~VideoFile() = default;
  /// \param bgr rows of blue, green, red bytes, from the top, `stride` bytes apart.
  virtual void add(const unsigned char* bgr, std::size_t stride) = 0;
  /// \throws core::Error (kUnreadable) if it could not be written whole.
  virtual void finish() = 0;
};

/// Size and speed of a film.
struct VideoFormat
{
  int width = 0;    ///< [px], even
  int height = 0;   ///< [px], even
  double fps = 25;  ///< frames a second
};

/// The module's one function, by the name kOpenVideo.
/// \throws core::Error (kUnreadable) if there can be no such file.
using OpenVideo = std::unique_ptr<VideoFile>(const std::string& path, const VideoFormat& format);
inline constexpr const char* kOpenVideo =
    "slamotOpenVideo";  ///< symbol of a function of type OpenVideo
}  // namespace slamot::video
