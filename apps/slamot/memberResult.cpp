#include "memberResult.h"

#include <slamot/results/Report.h>
#include <slamot/results/ResultFolder.h>
#include <slamot/results/TextFile.h>
#include <slamot/team/teamResults.h>

#include <filesystem>

#include "laserMaps.h"
#include "sceneOf.h"

namespace slamot::apps
{
void writeMemberResult(const std::string& place, const results::RunInfo& info,
                       const results::RunView& view, const core::Filter& filter,
                       const results::Timing& timing,
                       const std::vector<fusion::FusionEvent>& events, const std::string& messages)
{
  const auto addMore = [&](const std::string& folder)
  {
    const std::filesystem::path path(folder);
    mrpt::saveScene((path / "scene.3Dscene").string(),
                    sceneOf(results::titleOf(info), view, filter.particles()));
    saveLaserMaps(folder, view.record);
    results::writeReport((path / "report.html").string(), info, view);
    team::writeFusions((path / "fusions.csv").string(), events);
    if (!messages.empty()) results::writeWhole((path / "messages.json").string(), messages);
  };
  results::writeResult(place, info, view.record, view.evaluation, timing, addMore);
}
}  // namespace slamot::apps
