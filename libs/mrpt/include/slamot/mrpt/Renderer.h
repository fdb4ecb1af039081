#pragma once

#include <slamot/mrpt/Scene.h>

#include <mrpt/img/CImage.h>

namespace slamot::mrpt
{
/// One moment of a run, as it is drawn.
struct Moment
{
  SceneData scene;      ///< what is known by then
  std::string caption;  ///< a line at the bottom
  Pose2D lookedAt;      ///< where a camera that follows the robot looks, and along which heading
};

/// Draws moments of one run to pictures, with neither display nor graphics card: all with the same
/// ground, sizes and legend.  Use only the one that was made last: they share OpenGL's context.
class Renderer
{
 public:
  /// \param whole all of the run: its ground and legend are those of every picture.
  /// \throws core::Error (kInternal) where there is no OpenGL.
  Renderer(const SceneData& whole, const RenderOptions& options);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// \throws core::Error (kInternal) if OpenGL fails.
  [[nodiscard]] ::mrpt::img::CImage draw(const Moment& moment);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Writes a PNG, whole or not at all.  \throws core::Error (kUnreadable) if it can't be.
void savePng(const std::string& path, const ::mrpt::img::CImage& picture);
}  // namespace slamot::mrpt
