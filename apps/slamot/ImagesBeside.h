#pragma once

#include <string>

namespace slamot::apps
{
/// The images beside a rawlog in the making, `X_Images`: they are X.rawlog's own, and take the
/// place of those of an older one whole, with the log.
class ImagesBeside
{
 public:
  /// \throws core::Error (kConfig) where a folder of that name holds what simulate did not write.
  explicit ImagesBeside(const std::string& log);
  ~ImagesBeside();
  ImagesBeside(const ImagesBeside&) = delete;
  ImagesBeside& operator=(const ImagesBeside&) = delete;

  /// Where to write them, `name` by `name`.
  [[nodiscard]] std::string pathOf(const std::string& name) const;
  /// Puts them in their place; where there are none, takes older ones away.
  /// \throws core::Error (kUnreadable).
  void place();

  /// The name of an image taken at a time [s].
  [[nodiscard]] static std::string nameOf(double time);

 private:
  std::string folder_, temporary_;
};

/// What a detection should ask before it starts: that images can be linked beside its log `to`.
/// \throws core::Error (kConfig) where a folder of other images is.
void requirePlaceForLink(const std::string& to);

/// Lets a log find the images that another keeps in files beside it, by a link; an older link goes.
/// \throws core::Error (kUnreadable).
void linkImages(const std::string& from, const std::string& to);
}  // namespace slamot::apps
