#pragma once

#include <slamot/mrpt/Scene.h>

#include <cmath>

namespace slamot::mrpt
{
/// The ground that a scene covers, and the sizes that follow from it.
struct SceneFrame
{
  double xMin = 0, xMax = 0, yMin = 0, yMax = 0;  ///< [m], on the grid's lines
  double unit = 0.1;                              ///< [m]: a hundredth of its larger side
  double gridStep = 1;                            ///< [m]: 1, 2 or 5 times a power of ten

  explicit SceneFrame(const SceneData& data);
  /// Such as "1 m".
  [[nodiscard]] std::string gridText() const;
};
}  // namespace slamot::mrpt
