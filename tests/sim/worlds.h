#pragma once

#include <gtest/gtest.h>
#include <slamot/core/Error.h>
#include <slamot/models/RangeBearing.h>
#include <slamot/sim/World.h>

#include <string>
#include <vector>

namespace slamot::test
{
inline core::Config experiment1()
{
  return core::Config::load(SLAMOT_CONFIG_INI "/sim.experiment1.ini");
}

/// Experiment 1 with some keys changed, each as Section.key=value.
inline sim::Scenario scenario(const std::vector<std::string>& changes = {})
{
  core::Config config = experiment1();
  for (const std::string& change : changes) config.set(change);
  const sim::Scenario out = sim::Scenario::from(config);
  config.requireAllRead();
  return out;
}

/// A shipped scenario `sim.<name>.ini` with some keys changed.
inline sim::Scenario shipped(const std::string& name, const std::vector<std::string>& changes = {})
{
  core::Config config = core::Config::load(SLAMOT_CONFIG_INI "/sim." + name + ".ini");
  for (const std::string& change : changes) config.set(change);
  const sim::Scenario out = sim::Scenario::from(config);
  config.requireAllRead();
  return out;
}

inline core::Config team300()
{
  return core::Config::load(SLAMOT_CONFIG_INI "/sim.team-300m.ini");
}

/// The team in the world of 300 m, with some keys changed.
inline sim::Scenario team(const std::vector<std::string>& changes = {})
{
  core::Config config = team300();
  for (const std::string& change : changes) config.set(change);
  const sim::Scenario out = sim::Scenario::from(config);
  config.requireAllRead();
  return out;
}

inline std::vector<core::Step> drain(core::Source& source)
{
  std::vector<core::Step> steps;
  while (auto step = source.next()) steps.push_back(std::move(*step));
  return steps;
}

/// Equal to the last bit.
inline void expectSame(const core::Step& a, const core::Step& b)
{
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.dropped, b.dropped);
  EXPECT_EQ(a.odometry->mean, b.odometry->mean);
  EXPECT_EQ(a.odometry->cov, b.odometry->cov);
  ASSERT_EQ(a.landmarks.has_value(), b.landmarks.has_value());
  if (!a.landmarks) return;
  ASSERT_EQ(a.landmarks->sightings.size(), b.landmarks->sightings.size());
  for (std::size_t i = 0; i < a.landmarks->sightings.size(); ++i)
  {
    const core::Sighting &s = a.landmarks->sightings[i], &t = b.landmarks->sightings[i];
    EXPECT_TRUE(s.range == t.range && s.bearing == t.bearing && s.id == t.id);
  }
  ASSERT_EQ(a.blobs->blobs.size(), b.blobs->blobs.size());
  for (std::size_t i = 0; i < a.blobs->blobs.size(); ++i)
  {
    const core::Blob &s = a.blobs->blobs[i], &t = b.blobs->blobs[i];
    EXPECT_TRUE(s.range == t.range && s.bearing == t.bearing && s.id == t.id && s.label == t.label);
  }
}
}  // namespace slamot::test
