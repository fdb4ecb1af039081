#include <slamot/mrpt/CObservationColorBlobs.h>

#include "Mesh.h"

#if MRPT_VERSION >= 0x030000
#include <mrpt/viz/CSimpleLine.h>
#include <mrpt/viz/stock_objects.h>
#else
#include <mrpt/opengl/CSimpleLine.h>
#include <mrpt/opengl/stock_objects.h>
#endif

#include <algorithm>
#include <cmath>

namespace slamot::obs
{
namespace
{
constexpr double kRayLength = 5;     // [m], of a blob without range
constexpr double kMarkRadius = 0.2;  // [m]

// One colour for a label, whatever else is in the log.
::mrpt::img::TColorf colorOf(const std::string& label)
{
  static const ::mrpt::img::TColorf palette[] = {{0.9f, 0.2f, 0.1f}, {0.1f, 0.4f, 0.9f},
                                                 {0.1f, 0.6f, 0.2f}, {0.8f, 0.5f, 0.0f},
                                                 {0.6f, 0.2f, 0.7f}, {0.0f, 0.6f, 0.6f}};
  unsigned sum = 0;
  for (const unsigned char c : label) sum = sum * 31u + c;
  return palette[sum % std::size(palette)];
}

::mrpt::math::TPoint3D pointOnRobot(const CObservationColorBlobs& o, double range, double bearing,
                                    double elevation)
{
  ::mrpt::math::TPoint3D p;
  o.sensorPoseOnRobot.composePoint(
      {range * std::cos(elevation) * std::cos(bearing),
       range * std::cos(elevation) * std::sin(bearing), range * std::sin(elevation)},
      p);
  return p;
}

void addLine(slamot_viz::CSetOfObjects& out, const ::mrpt::math::TPoint3D& a,
             const ::mrpt::math::TPoint3D& b, const ::mrpt::img::TColorf& color)
{
  auto line = slamot_viz::CSimpleLine::Create(a.x, a.y, a.z, b.x, b.y, b.z);
  line->setColor(color);
  out.insert(line);
}

void addBlob(slamot_viz::CSetOfObjects& out, const CObservationColorBlobs& o,
             const CObservationColorBlobs::Blob& b)
{
  const auto color = colorOf(b.label);
  const double length = b.range.value_or(std::min(o.rangeMax, kRayLength));
  const auto end = pointOnRobot(o, length, b.bearing, b.elevation);
  addLine(out, pointOnRobot(o, 0, 0, 0), end, color);
  if (!b.range) return;
  // Not a sphere of MRPT's: it would be black where it looks away from the light.
  slamot::mrpt::Mesh mark(color.asTColor());
  mark.post({0, 0}, kMarkRadius, -kMarkRadius, kMarkRadius);
  auto object = mark.object(b.id >= 0 ? b.label + " " + std::to_string(b.id) : b.label);
  object->setLocation(end);
  object->enableShowName();
  out.insert(object);
}
}  // namespace

void CObservationColorBlobs::getVisualizationInto(slamot_viz::CSetOfObjects& o) const
{
  auto corner = slamot_viz::stock_objects::CornerXYZSimple(0.5f);
  corner->setPose(sensorPoseOnRobot);
  o.insert(corner);
  const double length = std::min(rangeMax, kRayLength);
  for (const double edge : {bearingMin, bearingMax})
    addLine(o, pointOnRobot(*this, 0, 0, 0), pointOnRobot(*this, length, edge, 0),
            {0.6f, 0.6f, 0.6f});
  for (const Blob& b : blobs) addBlob(o, *this, b);
}
}  // namespace slamot::obs
