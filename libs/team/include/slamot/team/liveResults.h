#pragma once

#include <slamot/fusion/Member.h>

#include <map>
#include <string>

namespace slamot::team
{
/// messages.json: what one robot sent, and what became of what it heard.
/// \param sessions starts of each other robot that were heard.
[[nodiscard]] std::string messagesJson(const fusion::Member& member,
                                       const std::map<int, int>& sessions);
}  // namespace slamot::team
