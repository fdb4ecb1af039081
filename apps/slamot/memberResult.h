#pragma once

#include <slamot/core/Filter.h>
#include <slamot/fusion/Member.h>
#include <slamot/results/Figures.h>
#include <slamot/results/Summary.h>

#include <string>
#include <vector>

namespace slamot::apps
{
/// Writes the result folder of one robot of a team: that of a run, and what it fused.
/// \param messages text of messages.json; empty: no such file.
void writeMemberResult(const std::string& place, const results::RunInfo& info,
                       const results::RunView& view, const core::Filter& filter,
                       const results::Timing& timing,
                       const std::vector<fusion::FusionEvent>& events,
                       const std::string& messages = {});
}  // namespace slamot::apps
