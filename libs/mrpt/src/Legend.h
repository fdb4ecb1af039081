#pragma once

#include "Mesh.h"

namespace slamot::mrpt
{
/// What the colours of a scene mean, in viewports of its own at the window's top: it stays readable
/// however the user turns the scene.
class Legend
{
 public:
  Legend(MrptScene& scene, const std::string& title);

  void line(const std::string& text, const ::mrpt::img::TColor& colour);
  void thinLine(const std::string& text, const ::mrpt::img::TColor& colour);
  void ellipse(const std::string& text, const ::mrpt::img::TColor& colour);
  void dots(const std::string& text, const ::mrpt::img::TColor& colour);
  void cross(const std::string& text, const ::mrpt::img::TColor& colour);

  /// Puts it into the scene.
  void finish();

 private:
  struct Entry
  {
    std::string text;
    Mesh mark;
  };
  Mesh& add(const std::string& text, const ::mrpt::img::TColor& colour);
  /// The height of the newest line; they run downwards, one unit each.
  [[nodiscard]] double y() const { return -static_cast<double>(entries_.size()); }

  MrptScene& scene_;
  std::string title_;
  std::vector<Entry> entries_;
};
}  // namespace slamot::mrpt
