#include "Snapshot.h"

#include <algorithm>

namespace slamot::laws
{
namespace
{
template <class T>
void put(std::string& out, const T& value)
{
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}
template <class S>
void put(std::string& out, const Gaussian<S>& g)
{
  for (int i = 0; i < kDim<S>; ++i) put(out, g.mean[i]);
  for (const double c : g.cov.reshaped()) put(out, c);
}
void put(std::string& out, const core::Estimate& estimate)
{
  const Snapshot s = snapshot(estimate);
  put(out, s.estimate.time);
  put(out, s.estimate.robot);
  for (const core::TargetEstimate& t : s.estimate.targets)
  {
    out += t.label;
    put(out, t.id), put(out, t.pose), put(out, t.lastSeen);
    for (const double v : t.velocity) put(out, v);
    for (const double c : t.velocityCov.reshaped()) put(out, c);
  }
  for (const core::LandmarkEstimate& l : s.landmarks)
    put(out, l.id), put(out, l.position), put(out, l.sightings);
}

/// Largest difference of two beliefs about one thing; angles wrapped.
template <class S>
double distance(const Gaussian<S>& a, const Gaussian<S>& b)
{
  double d = 0;
  for (int i = 0; i < kDim<S>; ++i)
  {
    const double e = a.mean[i] - b.mean[i];
    d = std::max(d, std::abs(i == 2 ? math::wrapToPi(e) : e) / std::max(1.0, std::abs(a.mean[i])));
  }
  return std::max(d, (a.cov - b.cov).cwiseAbs().maxCoeff() / std::max(1.0, a.cov.norm()));
}

Gaussian<Pose2D> moved(const Gaussian<Pose2D>& g, const Pose2D& by)
{
  const Matrix3 r = math::poseRotation(by.phi);
  return {math::compose(by, g.mean), r * g.cov * r.transpose()};
}
}  // namespace

Snapshot snapshot(const core::Estimate& estimate)
{
  Snapshot s{estimate, {}};
  s.estimate.landmarks = nullptr;
  if (estimate.landmarks)
    estimate.landmarks->visit([&](const core::LandmarkEstimate& l) { s.landmarks.push_back(l); });
  return s;
}

Snapshot moved(const Snapshot& snapshot, const Pose2D& by)
{
  const Matrix2 r = math::poseRotation(by.phi).topLeftCorner<2, 2>();
  Snapshot out = snapshot;
  out.estimate.robot = moved(snapshot.estimate.robot, by);
  for (core::TargetEstimate& t : out.estimate.targets)
  {
    t.pose = moved(t.pose, by);
    t.velocity = r * t.velocity;
    t.velocityCov = r * t.velocityCov * r.transpose();
  }
  for (core::LandmarkEstimate& l : out.landmarks)
    l.position = {math::transform(by, l.position.mean), r * l.position.cov * r.transpose()};
  return out;
}

std::string difference(const Snapshot& a, const Snapshot& b, double tolerance)
{
  // A comparison that NaN fails.
  const auto differs = [&](double d) { return !(d <= tolerance); };
  if (differs(distance(a.estimate.robot, b.estimate.robot))) return "the robot's pose differs";
  if (a.estimate.targets.size() != b.estimate.targets.size())
    return "the number of targets differs";
  for (std::size_t i = 0; i < a.estimate.targets.size(); ++i)
  {
    const auto &s = a.estimate.targets[i], &t = b.estimate.targets[i];
    if (s.id != t.id || differs(distance(s.pose, t.pose)) ||
        differs((s.velocity - t.velocity).norm()) ||
        differs((s.velocityCov - t.velocityCov).norm()))
      return "target " + std::to_string(s.id) + " differs";
  }
  if (a.landmarks.size() != b.landmarks.size()) return "the number of landmarks differs";
  for (std::size_t i = 0; i < a.landmarks.size(); ++i)
    if (a.landmarks[i].id != b.landmarks[i].id ||
        differs(distance(a.landmarks[i].position, b.landmarks[i].position)))
      return "landmark " + std::to_string(a.landmarks[i].id) + " differs";
  return {};
}

std::string bytes(const core::Filter& filter)
{
  std::string out;
  put(out, filter.estimate());
  for (const core::WeightedPose& p : filter.particles())
    put(out, p.pose.x), put(out, p.pose.y), put(out, p.pose.phi), put(out, p.weight);
  return out;
}

std::string bytes(const core::Update& update)
{
  std::string out;
  put(out, update.estimate);
  for (const core::Pairing& p : update.pairings)
    put(out, p.isBlob), put(out, p.index), put(out, p.outcome), put(out, p.id);
  put(out, update.diagnostics.ess.value_or(-1));
  put(out, update.diagnostics.particles);
  put(out, update.diagnostics.resampled);
  return out;
}
}  // namespace slamot::laws
