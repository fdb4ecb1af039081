#pragma once

#include <slamot/core/FilterRegistry.h>
#include <slamot/laws/checkFilter.h>

#include <memory>

namespace slamot::laws
{
/// The filter under test: made anew for every run.
struct Subject
{
  std::string name;
  core::Config config;
  LawOptions options;

  [[nodiscard]] std::unique_ptr<core::Filter> make(const core::Starts& starts, std::uint64_t seed,
                                                   int threads = 1) const
  {
    core::Config copy = config;
    return core::FilterRegistry::instance().make(name, copy, {starts, seed, threads});
  }
};

/// Each tells how the law is broken, or nothing.
using Broken = std::optional<std::string>;
Broken timeNeverGoesBack(const Subject& subject);
Broken valuesAreFinite(const Subject& subject);
Broken covariancesAreSound(const Subject& subject);
Broken emptyStepsOnlyAddUncertainty(const Subject& subject);
Broken equalSeedsGiveEqualBytes(const Subject& subject);
Broken rotatesWithTheWorld(const Subject& subject);
Broken robotIsConsistent(const Subject& subject);
Broken targetsAreConsistent(const Subject& subject);

[[nodiscard]] inline std::string atStep(std::uint64_t seed, std::size_t step)
{
  return "seed " + std::to_string(seed) + ", step " + std::to_string(step + 1) + ": ";
}
}  // namespace slamot::laws
