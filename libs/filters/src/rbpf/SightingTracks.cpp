#include "SightingTracks.h"

#include <Eigen/LU>
#include <algorithm>

namespace slamot::filters::rbpf
{
namespace
{
constexpr double kLongestPause = 2;  // [s] between sightings of a track
constexpr double kGate =
    5.99;  // 95% of two degrees of freedom: a wrong link costs more than a missing one
}  // namespace

void SightingTracks::move(const Gaussian<Pose2D>& increment)
{
  const double c = std::cos(increment.mean.phi), s = std::sin(increment.mean.phi);
  Matrix2 back;  // from the old frame's axes to the new one's
  back << c, s, -s, c;
  for (Track& t : tracks_)
  {
    if (t.hits == 0) continue;
    const Vector2 p = back * Vector2(t.at.x - increment.mean.x, t.at.y - increment.mean.y);
    t.at = {p[0], p[1]};
    Eigen::Matrix<double, 2, 3> G;
    G << -back, Vector2(p[1], -p[0]);
    t.cov = back * t.cov * back.transpose() + G * increment.cov * G.transpose();
  }
}

Gaussian<Point2D> SightingTracks::pointOf(const Ray& ray) const
{
  const Ray own{ray.range,
                ray.cosB,
                ray.sinB,
                ray.bearing,
                settings_.rangeStd * settings_.rangeStd,
                settings_.bearingStd * settings_.bearingStd,
                true};
  return invert(Eye({0, 0, 0}), own);
}

void SightingTracks::link(const std::vector<Ray>& rays, double time)
{
  for (Track& t : tracks_)
    if (t.hits > 0 && time - t.seen > kLongestPause) t.hits = 0;
  candidates_.clear();
  for (std::size_t j = 0; j < rays.size(); ++j)
  {
    const Gaussian<Point2D> z = pointOf(rays[j]);
    for (std::size_t k = 0; k < tracks_.size(); ++k)
    {
      const Track& t = tracks_[k];
      if (t.hits == 0) continue;
      const Matrix2 S = t.cov + z.cov;
      const Vector2 d(z.mean.x - t.at.x, z.mean.y - t.at.y);
      const double d2 = d.dot(S.inverse() * d);
      if (d2 <= kGate)
        candidates_.push_back(
            {d2, static_cast<std::int32_t>(j), static_cast<std::int32_t>(k), true});
    }
  }
  matches_.assign(rays.size(), kNew);
  matchGreedily(candidates_, matches_);
  places_.clear();
  for (std::size_t j = 0; j < rays.size(); ++j)
  {
    auto at = matches_[j] >= 0 ? tracks_.begin() + matches_[j]
                               : std::find_if(tracks_.begin(), tracks_.end(),
                                              [](const Track& t) { return t.hits == 0; });
    if (at == tracks_.end()) at = tracks_.insert(at, Track{});
    const Gaussian<Point2D> z = pointOf(rays[j]);
    *at = {z.mean, z.cov, time, at->hits + 1};
    places_.push_back(static_cast<std::size_t>(at - tracks_.begin()));
  }
}
}  // namespace slamot::filters::rbpf
