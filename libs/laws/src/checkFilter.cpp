#include "laws.h"

#include <slamot/core/Error.h>

#include <array>

namespace slamot::laws
{
namespace
{
struct Law
{
  const char* sentence;
  Broken (*broken)(const Subject&);
};

constexpr std::array kLaws = {
    Law{"time going backwards throws and leaves the filter as it was", timeNeverGoesBack},
    Law{"values that are not finite throw and leave the filter as it was", valuesAreFinite},
    Law{"covariances are symmetric and positive, ids rise", covariancesAreSound},
    Law{"steps in which nothing was reported only add uncertainty", emptyStepsOnlyAddUncertainty},
    Law{"equal seeds give equal bytes, whatever the threads", equalSeedsGiveEqualBytes},
    Law{"rotating the world rotates the estimate", rotatesWithTheWorld},
    Law{"the robot's normalised error is in its band", robotIsConsistent},
    Law{"the targets' normalised error is in its band", targetsAreConsistent},
};

void requireReason(const std::optional<NeesBand>& band)
{
  if (band && band->reason.empty())
    throw core::Error(core::ExitStatus::kConfig, "LawOptions", "a NEES band without a reason",
                      "say why the filter is not consistent");
}

/// \throws core::Error: the filter is not there, or its parameters are wrong.
void requireUsable(const std::string& name, core::Config config, const LawOptions& options)
{
  requireReason(options.robotNees);
  requireReason(options.targetNees);
  core::FilterContext context;
  context.starts = drive(options.world, 1).starts;
  (void)core::FilterRegistry::instance().make(name, config, context);
  config.requireAllRead();
}
}  // namespace

std::vector<std::string> brokenLaws(const std::string& name, const core::Config& config,
                                    const LawOptions& options)
{
  requireUsable(name, config, options);
  const Subject subject{name, config, options};
  std::vector<std::string> lines;
  for (const Law& law : kLaws)
  {
    Broken how;
    try
    {
      how = law.broken(subject);
    }
    catch (const std::exception& e)
    {
      how = std::string("the filter threw: ") + e.what();
    }
    if (how) lines.push_back(std::string(law.sentence) + ": " + *how);
  }
  return lines;
}

void checkFilter(const std::string& name, const core::Config& config, const LawOptions& options)
{
  const auto broken = brokenLaws(name, config, options);
  if (!broken.empty()) throw LawBroken("filter " + name, broken);
}
}  // namespace slamot::laws
