#pragma once

#include <slamot/mrpt/mrpt_compat.h>

#include <mrpt/img/CImage.h>
#include <mrpt/opengl/CFBORender.h>

#include <vector>

#include SLAMOT_SCENE_HEADER

namespace slamot::mrpt
{
struct Size
{
  int width, height;  ///< [px]
};

/// Draws scenes off-screen, with smooth edges.  MRPT's renderers draw into whichever of them was
/// made last: use only the newest.
class Canvas
{
 public:
  explicit Canvas(const Size& size);
  /// A scene's main viewport on white, seen by a camera; what is nearer to it than `near` or
  /// farther than `far` [m] is left out.
  [[nodiscard]] ::mrpt::img::CImage draw(MrptScene& scene, const slamot_viz::CCamera& camera,
                                         float near, float far);

 private:
  Size size_;
  ::mrpt::opengl::CFBORender renderer_;
};

/// How many times as large as the picture things are drawn, along each side.
inline constexpr int kOversampling = 2;  // the software renderer makes no smooth edges

/// A part of a picture.
struct Patch
{
  ::mrpt::img::CImage picture;
  int x, y;  ///< of its upper left corner [px]
};

/// What lies over the picture's main part, drawn: a scene's title and legend, if it has any.
[[nodiscard]] std::vector<Patch> drawOverlays(MrptScene& scene, const Size& picture);
void paste(::mrpt::img::CImage& picture, const std::vector<Patch>& patches);
}  // namespace slamot::mrpt
