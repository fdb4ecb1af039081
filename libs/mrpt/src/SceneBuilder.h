#pragma once

#include <slamot/mrpt/mrpt_compat.h>

#include <mrpt/img/TColor.h>

#include "SceneFrame.h"

namespace slamot::mrpt
{
/// Puts what is to be drawn into MRPT's scenes.
class SceneBuilder
{
 public:
  /// \param frame ground and sizes: the data's own, or those of a whole run whose moment it is.
  SceneBuilder(const SceneData& data, const SceneFrame& frame) : data_(data), frame_(frame) {}

  /// Adds all objects to the scene's main viewport.
  void addObjects(MrptScene& scene);

 private:
  using Colour = ::mrpt::img::TColor;

  [[nodiscard]] double u() const { return frame_.unit; }
  [[nodiscard]] double z(int layer) const { return 0.5 * u() * layer; }
  void addTargetBody(const SceneTrack& target, const Colour& colour, double lift);
  [[nodiscard]] Gaussian<Point2D> scaled(const Gaussian<Point2D>& g) const;
  void insert(const slamot_viz::CRenderizable::Ptr& object);

  void addGround();
  void addPoints(const std::string& name, const std::vector<Point2D>& points, const Colour& colour,
                 int layer, float size);
  void addLandmarks();
  void addSightings();
  void addTeam();
  void addPath(const SceneTrack& track, const Colour& colour, double width, double lift = 0);
  void addTrack(const SceneTrack& track, const Colour& colour);
  void addEllipse(const std::string& name, const Gaussian<Point2D>& g, const Colour& colour);
  void addTruth(const SceneTrack& track, const Colour& colour);
  void addParticles();

  const SceneData& data_;
  SceneFrame frame_;
  MrptScene* scene_ = nullptr;
};
}  // namespace slamot::mrpt
