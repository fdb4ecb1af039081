#pragma once

#include "temporary.h"

#include <slamot/mrpt/RawlogSource.h>
#include <slamot/mrpt/RawlogWriter.h>

#include <string>
#include <vector>

namespace slamot::tests
{
inline core::Starts exampleStarts()
{
  core::Starts starts;
  starts.time = 0.0;
  auto& robot = starts.robot.emplace();
  robot.value[core::ObjectStart::kX] = 1.0 / 3;
  robot.std[core::ObjectStart::kX] = 0.01;
  starts.targets[3].value[core::ObjectStart::kVx] = -2;
  return starts;
}

/// Odometry at every step, at some of them scans: full ones, and ones that saw nothing.
inline std::vector<core::Step> exampleSteps()
{
  std::vector<core::Step> steps(4);
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    steps[i].time = 0.025 * static_cast<double>(i + 1);
    const double k = static_cast<double>(i);
    steps[i].odometry = math::turnThenMove(1 + 0.1 * k, 0.3 - k, 0.025, 0.1 + 0.01 * k, 0.05);
  }
  steps[1].landmarks.emplace().fov = {0.1, 5, -math::kPi, math::kPi};
  steps[1].landmarks->sightings = {{3.1, -3.0, 0.1, 0.008, 7}, {1.7, 2.5, 0.1, 0.008, -1}};
  steps[1].blobs.emplace().fov = {0, 6, -0.6, 0.9};
  steps[1].blobs->blobs = {{"target", 2.5, 0.4, 0.1, 0.01, 4}, {"robot", {}, -0.3, 0, 0.02, -1}};
  steps[2].landmarks.emplace().fov = {0, 5, -0.4, 1.2};
  steps[2].blobs.emplace().fov = {0, 6, -0.6, 0.9};
  steps[3].landmarks.emplace().fov = {0, 5, -0.4, 1.2};
  steps[3].landmarks->sightings = {{4.2, 0.7, 0.1, 0.008, 7}, {4.3, 0.9, 0.2, 0.016, 7}};
  return steps;
}

inline std::string writeLog(const TemporaryFolder& folder, mrpt::RawlogWriter::Format format,
                            const std::vector<core::Step>& steps, const core::Starts& starts)
{
  const std::string path = folder.file("log.rawlog");
  mrpt::RawlogWriter writer(path, format, starts);
  for (const core::Step& step : steps) writer.write(step);
  writer.close();
  return path;
}

inline mrpt::RawlogSource::Options model()
{
  mrpt::RawlogSource::Options options;
  options.odometry.fromLog = false;
  options.odometry.vStd = 0.2;
  options.odometry.omegaStd = 0.1;
  return options;
}

inline std::vector<core::Step> readAll(mrpt::RawlogSource& source)
{
  std::vector<core::Step> steps;
  while (auto step = source.next()) steps.push_back(*step);
  return steps;
}
}  // namespace slamot::tests
