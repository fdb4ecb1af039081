#pragma once

#include <slamot/core/Config.h>
#include <slamot/core/Start.h>
#include <slamot/eval/Evaluation.h>

#include <cstdint>
#include <string>

namespace slamot::results
{
/// What a config asks for on one log.
struct RunPlan
{
  std::string method;                      ///< name of the filter
  std::uint64_t seed = 1;                  ///< that it draws by
  core::Starts starts;                     ///< where robot and targets start
  eval::Align align = eval::Align::kNone;  ///< how the result is laid over the truth
  Point2D leverArm{0, 0};                  ///< see eval::EvaluationOptions
};

/// Keys `seed` and `align` of [run].
struct SeedAndAlign
{
  std::uint64_t seed = 1;                  ///< that the filter draws by
  eval::Align align = eval::Align::kNone;  ///< how the result is laid over the truth
};

/// Unless [run] says otherwise, results are not aligned where starts were given, else by the first
/// pose.  \throws core::Error (kConfig).
[[nodiscard]] SeedAndAlign readSeedAndAlign(core::Config& config, bool startsAreKnown);

/// Key `lever_arm_m` of [run], as `X, Y`; 0, 0 without it.  \throws core::Error (kConfig).
[[nodiscard]] Point2D readLeverArm(core::Config& config);

/// Reads [run] (method, seed, align, lever_arm_m) and [start].  A config without [start] takes over
/// the log's, so that the effective config repeats the run.  Unless [run] says otherwise, results
/// are not aligned where the robot's start was given, else by the first pose. \throws core::Error
/// (kConfig).
[[nodiscard]] RunPlan planRun(core::Config& config, const core::Starts& ofLog);
}  // namespace slamot::results
