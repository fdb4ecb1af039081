#pragma once

#include <gtest/gtest.h>
#include <slamot/core/Error.h>
#include <slamot/core/Filter.h>
#include <slamot/laws/Drive.h>

#include <string>

namespace slamot::test
{
/// The ways to run rbpf-slamot that behave differently inside.
struct Way
{
  bool informed, knownIds, differentialDrive;
};
inline const Way kWays[] = {
    {false, true, true}, {false, false, false}, {true, true, false}, {true, false, true}};

inline std::string nameOf(const ::testing::TestParamInfo<Way>& info)
{
  const Way& w = info.param;
  return std::string(w.informed ? "Informed" : "Motion") + (w.knownIds ? "Known" : "Nn");
}

inline laws::World worldOf(const Way& way)
{
  laws::World world;
  world.identities = way.knownIds;
  return world;
}
inline laws::Drive drive(const Way& way, std::uint64_t seed, const Pose2D& start = {})
{
  return laws::drive(worldOf(way), seed, start);
}
inline int idOf(const Way& way, int id)
{
  return way.knownIds ? id : core::kNoId;
}

/// Parameters that suit laws::World.
inline std::string keysOf(const Way& way, int particles = 40)
{
  return "particles = " + std::to_string(particles) +
         "\nproposal = " + (way.informed ? "informed" : "motion") +
         "\nassociation = " + (way.knownIds ? "known" : "nn") + "\n" +
         (way.differentialDrive
              ? "target_motion = differential-drive\ntarget_speed_mps = 0.8\n"
                "target_turn_rate_deg_per_s = 11.459155902616464\ntarget_speed_noise_mps = 0.1\n"
                "target_turn_rate_noise_deg_per_s = 5.729577951308232\n"
              : "target_velocity_std_mps = 0.8\ntarget_velocity_time_s = 2\n");
}

/// All that a filter tells, bit for bit.
inline std::string bytes(const core::Filter& filter)
{
  std::string out;
  const auto put = [&](const auto& value)
  { out.append(reinterpret_cast<const char*>(&value), sizeof value); };
  const auto putMatrix = [&](const auto& m)
  {
    for (const double v : m.reshaped()) put(v);
  };
  const core::Estimate e = filter.estimate();
  put(e.time), put(e.robot.mean.x), put(e.robot.mean.y), put(e.robot.mean.phi),
      putMatrix(e.robot.cov);
  for (const auto& t : e.targets)
  {
    put(t.id), put(t.pose.mean.x), put(t.pose.mean.y), put(t.pose.mean.phi), putMatrix(t.pose.cov);
    putMatrix(t.velocity), putMatrix(t.velocityCov), put(t.lastSeen);
  }
  if (e.landmarks)
    e.landmarks->visit(
        [&](const core::LandmarkEstimate& l)
        {
          put(l.id), put(l.position.mean.x), put(l.position.mean.y), putMatrix(l.position.cov);
          put(l.sightings);
        });
  for (const auto& p : filter.particles())
    put(p.pose.x), put(p.pose.y), put(p.pose.phi), put(p.weight);
  return out;
}
}  // namespace slamot::test
