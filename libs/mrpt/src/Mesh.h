#pragma once

#include <slamot/math/gaussian.h>
#include <slamot/mrpt/Scene.h>
#include <slamot/mrpt/mrpt_compat.h>

#include SLAMOT_VIZ(CSetOfTriangles.h)

namespace slamot::mrpt
{
/// Flat and upright shapes of one colour, collected into one object: lines of OpenGL have no
/// thickness where there is no graphics card, and one object draws faster than a thousand.
class Mesh
{
 public:
  explicit Mesh(const ::mrpt::img::TColor& colour);

  /// A line of some width [m] at height z.
  void ribbon(const Polyline& line, double width, double z);
  /// A rectangle between two corners.
  void sheet(const Point2D& low, const Point2D& high, double z);
  /// The ellipse that holds 95% of a Gaussian: pale, with a rim of this width [m]; or the rim only.
  void ellipse(const Gaussian<Point2D>& g, double rim, double z, bool filled = true);
  /// What stands on a convex or star-shaped outline about `centre`, from z0 to z1.
  void prism(const Point2D& centre, const Polyline& outline, double z0, double z1);
  void post(const Point2D& centre, double radius, double z0, double z1);
  void cross(const Point2D& centre, double arm, double width, double z);

  /// The object, to be put into a scene.
  [[nodiscard]] slamot_viz::CSetOfTriangles::Ptr object(const std::string& name) const;

 private:
  struct Corner
  {
    Point2D p;
    double z;
  };
  /// \param outwards where the face looks to, for its shade; (0, 0): upwards.
  void triangle(const Corner& a, const Corner& b, const Corner& c,
                const Point2D& outwards = {0, 0});
  void fan(const Point2D& centre, const Polyline& outline, double z);

  ::mrpt::img::TColor colour_;
  slamot_viz::CSetOfTriangles::Ptr triangles_;
};

/// An outline like a dart that heads along the pose.
[[nodiscard]] Polyline dart(const Pose2D& pose, double length);
}  // namespace slamot::mrpt
