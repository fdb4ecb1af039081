#pragma once

#include <slamot/eval/Record.h>

#include <string>

namespace slamot::apps
{
/// Says on stderr why a log ended early, and how much of it was used.
void tellSalvaged(const std::string& truncation, const eval::Record& record);
}  // namespace slamot::apps
