#pragma once

#include <slamot/math/geometry.h>
#include <slamot/scans/BlockMaxima.h>

#include <array>

namespace slamot::scans
{
/// A bit of wall, or whatever stood around a cell of a map.
struct Surface
{
  Point2D centre;        ///< [m]
  Vector2 normal{1, 0};  ///< of a wall
  double tilt = 0;       ///< variance of the normal's direction [rad²]
  bool isKnown = false;  ///< else too few points tell of it
  bool isWall = false;   ///< else only that something is near its centre
  double variance = 0;   ///< of points across the wall, or of each coordinate [m²]
};

/// What scans that were taken near each other saw, prepared for matching: for every cell the
/// nearest surface, and how likely a beam ends there.  Likelihood fields: Thrun, Burgard, Fox 2005,
/// section 6.4.
class LocalMap
{
 public:
  static constexpr double kCell = 0.05;  ///< [m]
  static constexpr double kHit = 255;    ///< a cell's value where something was seen

  /// \param points [m]; those farther than `farthest` from the origin are left out.
  LocalMap(const std::vector<Point2D>& points, double farthest);

  /// Whether there is no surface in it.
  [[nodiscard]] bool empty() const { return surfaces_.empty(); }

  /// The cell that a point lies in; may lie outside the map.
  [[nodiscard]] std::array<int, 2> cellOf(const Point2D& p) const
  {
    return {static_cast<int>(std::floor((p.x - origin_.x) / kCell)),
            static_cast<int>(std::floor((p.y - origin_.y) / kCell))};
  }
  /// How likely beams end in cells, as maxima over blocks; level 0: the cells' own values.
  [[nodiscard]] const BlockMaxima& field() const { return field_; }
  /// Nothing is farther off than some cells, if there is one.
  [[nodiscard]] const Surface* nearest(const Point2D& p) const;

 private:
  struct Sums;
  void enclose(const std::vector<Point2D>& points);
  std::vector<Sums> addUp(const std::vector<Point2D>& points);
  void fitSurfaces(const std::vector<Sums>& cells);
  [[nodiscard]] BlockMaxima::Level spread(const std::vector<Sums>& cells);
  [[nodiscard]] std::size_t index(int x, int y) const
  {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  Point2D origin_;
  int width_ = 0, height_ = 0;         // in cells
  std::vector<std::int32_t> nearest_;  // by cell: place in surfaces_, or -1
  std::vector<Surface> surfaces_;
  BlockMaxima field_;
};
}  // namespace slamot::scans
