#include "Mesh.h"

#include <slamot/math/statistics.h>

#include <algorithm>

namespace slamot::mrpt
{
namespace
{
/// A circle's points, the last equal to the first.
template <class At>
Polyline around(int corners, At at)
{
  Polyline line;
  for (int i = 0; i <= corners; ++i)
  {
    const double a = math::kTwoPi * (i % corners) / corners;
    line.push_back(at(std::cos(a), std::sin(a)));
  }
  return line;
}

Point2D unit(const Point2D& a, const Point2D& b)
{
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  return length > 0 ? Point2D{(b.x - a.x) / length, (b.y - a.y) / length} : Point2D{0, 0};
}

/// Points at least `step` apart; the ends stay.
Polyline spaced(const Polyline& line, double step)
{
  Polyline out;
  for (std::size_t i = 0; i < line.size(); ++i)
  {
    const bool end = i == 0 || i + 1 == line.size();
    if (end || std::hypot(line[i].x - out.back().x, line[i].y - out.back().y) >= step)
      out.push_back(line[i]);
  }
  return out;
}
}  // namespace

Mesh::Mesh(const ::mrpt::img::TColor& colour)
    : colour_(colour), triangles_(slamot_viz::CSetOfTriangles::Create())
{
}

void Mesh::triangle(const Corner& a, const Corner& b, const Corner& c, const Point2D& outwards)
{
  const auto at = [](const Corner& k)
  {
    return ::mrpt::math::TPoint3Df(static_cast<float>(k.p.x), static_cast<float>(k.p.y),
                                   static_cast<float>(k.z));
  };
  // MRPT's light comes from (1, 1, 2): what faces it shows its true colour.  Upright faces lean
  // towards it too, or those turned away would be black.
  const ::mrpt::math::TVector3Df normal(static_cast<float>(0.408 + 0.7 * outwards.x),
                                        static_cast<float>(0.408 + 0.7 * outwards.y), 0.816f);
  const float length = normal.norm();
  const auto n = normal * (1.0f / length);
  slamot_viz::TTriangle t(at(a), at(b), at(c), n, n, n);
  t.setColor(colour_);
  triangles_->insertTriangle(t);
}

void Mesh::fan(const Point2D& centre, const Polyline& outline, double z)
{
  for (std::size_t i = 0; i + 1 < outline.size(); ++i)
    triangle({centre, z}, {outline[i], z}, {outline[i + 1], z});
}

void Mesh::sheet(const Point2D& low, const Point2D& high, double z)
{
  fan({(low.x + high.x) / 2, (low.y + high.y) / 2},
      {low, {high.x, low.y}, high, {low.x, high.y}, low}, z);
}

void Mesh::ribbon(const Polyline& line, double width, double z)
{
  const Polyline p = spaced(line, 0.6 * width);
  std::vector<Point2D> side;  // half a width to the left, mitred
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    const Point2D before =
        unit(p[i > 0 ? i - 1 : 0], p[i > 0 ? i : std::min<std::size_t>(1, p.size() - 1)]);
    const Point2D after = i + 1 < p.size() ? unit(p[i], p[i + 1]) : before;
    const Point2D along = unit({0, 0}, {before.x + after.x, before.y + after.y});
    const double stretch = std::min(2.0, 1 / std::max(0.1, along.x * after.x + along.y * after.y));
    side.push_back({-along.y * stretch * width / 2, along.x * stretch * width / 2});
  }
  for (std::size_t i = 0; i + 1 < p.size(); ++i)
  {
    const Point2D l0{p[i].x + side[i].x, p[i].y + side[i].y};
    const Point2D r0{p[i].x - side[i].x, p[i].y - side[i].y};
    const Point2D l1{p[i + 1].x + side[i + 1].x, p[i + 1].y + side[i + 1].y};
    const Point2D r1{p[i + 1].x - side[i + 1].x, p[i + 1].y - side[i + 1].y};
    triangle({r0, z}, {r1, z}, {l1, z});
    triangle({r0, z}, {l1, z}, {l0, z});
  }
}

void Mesh::ellipse(const Gaussian<Point2D>& g, double rim, double z, bool filled)
{
  const math::Ellipse axes = math::ellipse(g.cov);
  const double scale = std::sqrt(math::chiSquareQuantile(0.95, 2));
  const Pose2D centre(g.mean.x, g.mean.y, axes.direction);
  const auto outline = [&](double grown)
  {
    return around(36,
                  [&](double c, double s)
                  {
                    return math::transform(centre, {(scale * axes.longer + grown) * c,
                                                    (scale * axes.shorter + grown) * s});
                  });
  };
  const Polyline inner = outline(0), outer = outline(rim);
  for (std::size_t i = 0; i + 1 < inner.size(); ++i)
  {
    triangle({inner[i], z}, {outer[i], z}, {outer[i + 1], z});
    triangle({inner[i], z}, {outer[i + 1], z}, {inner[i + 1], z});
  }
  if (!filled) return;
  const auto solid = colour_;
  const auto pale = [](std::uint8_t c) { return static_cast<std::uint8_t>(255 - (255 - c) / 3); };
  colour_ = {pale(solid.R), pale(solid.G), pale(solid.B)};
  fan(g.mean, inner, z);
  colour_ = solid;
}

void Mesh::prism(const Point2D& centre, const Polyline& outline, double z0, double z1)
{
  fan(centre, outline, z1);
  for (std::size_t i = 0; i + 1 < outline.size(); ++i)
  {
    const Point2D &a = outline[i], &b = outline[i + 1], along = unit(a, b);
    const Point2D outwards{along.y, -along.x};
    triangle({a, z0}, {b, z0}, {b, z1}, outwards);
    triangle({a, z0}, {b, z1}, {a, z1}, outwards);
  }
}

void Mesh::post(const Point2D& centre, double radius, double z0, double z1)
{
  prism(centre,
        around(16,
               [&](double c, double s) -> Point2D {
                 return {centre.x + radius * c, centre.y + radius * s};
               }),
        z0, z1);
}

void Mesh::cross(const Point2D& centre, double arm, double width, double z)
{
  ribbon({{centre.x - arm, centre.y}, {centre.x + arm, centre.y}}, width, z);
  ribbon({{centre.x, centre.y - arm}, {centre.x, centre.y + arm}}, width, z);
}

slamot_viz::CSetOfTriangles::Ptr Mesh::object(const std::string& name) const
{
  triangles_->setName(name);
  return triangles_;
}

Polyline dart(const Pose2D& pose, double length)
{
  constexpr double kOutline[][2] = {{0.6, 0}, {-0.4, 0.38}, {-0.22, 0}, {-0.4, -0.38}, {0.6, 0}};
  Polyline line;
  for (const auto& corner : kOutline)
    line.push_back(math::transform(pose, {length * corner[0], length * corner[1]}));
  return line;
}
}  // namespace slamot::mrpt
