#pragma once

#include <slamot/results/HtmlPage.h>
#include <slamot/team/teamFigures.h>
#include <slamot/team/teamResults.h>

namespace slamot::team
{
/// What a team's page and scene are headed with.
[[nodiscard]] std::string titleOf(const Team& team);

/// A team's run for figures; must not outlive either.
[[nodiscard]] TeamView viewOf(const Team& team, const std::vector<RobotResult>& robots);

/// Messages of each robot by what became of them, with their sum; outcomes that none had are left
/// out.  No rows where nothing is exchanged.
[[nodiscard]] results::Table messageTable(const Team& team, const std::vector<RobotResult>& robots);

/// Writes the team's report.html: key numbers, messages, plots, settings, and links to each robot's
/// own in the folder of its name.  The same run gives the same bytes.
/// \param config the effective configuration.
/// \return a warning for the user where plots are missing for want of gnuplot; else empty.
/// \throws core::Error (kUnreadable) if the file can't be written.
std::string writeTeamReport(const std::string& path, const Team& team,
                            const std::vector<RobotResult>& robots, std::uint64_t seed,
                            const std::string& config);
}  // namespace slamot::team
