#pragma once

#include <slamot/core/Config.h>
#include <slamot/laws/Drive.h>
#include <slamot/laws/LawBroken.h>

namespace slamot::laws
{
/// Where the mean NEES per degree of freedom must lie (1 is ideal), for a filter that is known not
/// to be consistent, and why it is not.
struct NeesBand
{
  double low;          ///< least that is accepted
  double high;         ///< most that is accepted
  std::string reason;  ///< must not be empty
};

/// What a filter is tried on, and what is known of it.
struct LawOptions
{
  World world;     ///< must suit the filter's parameters: its noise is what the filter assumes
  int runs = 100;  ///< drives for the laws that are statistical; seeds 1 to runs
  std::optional<NeesBand> robotNees;   ///< absent: the chi-square band, kept by chance in 99.9%
  std::optional<NeesBand> targetNees;  ///< of the places of targets; absent: as above
  /// Why a rotated start gives the rotated estimate only on average over runs, as with samples
  /// drawn along map axes.  Empty: it does so to rounding, with the same seed.
  std::string rotatesOnlyOnAverage;
};

/// The laws that the registered filter `name` breaks, one line each; empty if it is sound.
/// - time going backwards throws and leaves the filter as it was
/// - values that are not finite throw and leave the filter as it was
/// - covariances are finite, symmetric and positive semidefinite; ids rise
/// - equal seeds give equal bytes, whatever the number of threads
/// - rotating the world rotates the estimate
/// - steps in which nothing was reported only add uncertainty
/// - the normalised error is in its chi-square band
/// \param config has the filter's section, if it needs parameters.
/// \throws core::Error (kConfig): no such filter, or its parameters are wrong.
[[nodiscard]] std::vector<std::string> brokenLaws(const std::string& name,
                                                  const core::Config& config = {},
                                                  const LawOptions& options = {});

/// For a test: TEST(MyFilter, ObeysTheFilterLaws) { checkFilter("my-filter", config); }
/// \throws LawBroken if brokenLaws() are any; else as brokenLaws().
void checkFilter(const std::string& name, const core::Config& config = {},
                 const LawOptions& options = {});
}  // namespace slamot::laws
