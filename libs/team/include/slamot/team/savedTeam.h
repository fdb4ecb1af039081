#pragma once

#include <string>
#include <vector>

namespace slamot::team
{
/// The names of the robots whose results a team's folder holds, each in a folder of its name, in
/// order; none if the folder is not a team's.
/// \throws core::Error (kNonsense) if its team.json is none of ours.
[[nodiscard]] std::vector<std::string> robotsIn(const std::string& folder);

/// What a team's pictures are headed with.  \throws core::Error as above, or if there is no team.
[[nodiscard]] std::string titleIn(const std::string& folder);

/// JSON of one evaluation a robot, each as results::evaluationJson() made it, by its name.
[[nodiscard]] std::string evaluationsJson(const std::vector<std::string>& names,
                                          const std::vector<std::string>& evaluations);
}  // namespace slamot::team
