#include "SceneFrame.h"

#include <algorithm>
#include <charconv>

namespace slamot::mrpt
{
namespace
{
struct Cover
{
  double xMin = 1e300, xMax = -1e300, yMin = 1e300, yMax = -1e300;

  void add(const Point2D& p)
  {
    xMin = std::min(xMin, p.x), xMax = std::max(xMax, p.x);
    yMin = std::min(yMin, p.y), yMax = std::max(yMax, p.y);
  }
  void add(const SceneTrack& track)
  {
    for (const auto* pieces : {&track.path, &track.truth})
      for (const Polyline& piece : *pieces)
        for (const Point2D& p : piece) add(p);
  }
};

Cover coverOf(const SceneData& data)
{
  Cover cover;
  cover.add(data.robot);
  for (const SceneMember& m : data.team) cover.add(m.robot), cover.add(m.target);
  for (const auto& t : data.targets) cover.add(t);
  for (const auto& l : data.landmarks) cover.add(l.position.mean);
  for (const Point2D& p : data.trueLandmarks) cover.add(p);
  for (const Point2D& p : data.laserPoints) cover.add(p);
  if (cover.xMin > cover.xMax) cover.add({0, 0});
  return cover;
}

/// 1, 2 or 5 times a power of ten, near a tenth of the length.
double niceStep(double length)
{
  const double power = std::pow(10.0, std::floor(std::log10(length / 10)));
  const double part = length / 10 / power;
  return power * (part < 1.5 ? 1 : part < 3.5 ? 2 : part < 7.5 ? 5 : 10);
}
}  // namespace

SceneFrame::SceneFrame(const SceneData& data)
{
  const Cover c = coverOf(data);
  const double side = std::max({c.xMax - c.xMin, c.yMax - c.yMin, 1.0});
  gridStep = niceStep(side);
  const auto down = [&](double v) { return gridStep * std::floor(v / gridStep - 0.2); };
  const auto up = [&](double v) { return gridStep * std::ceil(v / gridStep + 0.2); };
  xMin = down(c.xMin), xMax = up(c.xMax), yMin = down(c.yMin), yMax = up(c.yMax);
  unit = std::max(xMax - xMin, yMax - yMin) / 100;
}

std::string SceneFrame::gridText() const
{
  char text[40];
  const auto end =
      std::to_chars(text, text + sizeof text, gridStep, std::chars_format::general, 6).ptr;
  return std::string(text, end) + " m";
}
}  // namespace slamot::mrpt
