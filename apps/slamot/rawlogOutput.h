#pragma once

#include <string>

namespace slamot::apps
{
/// The path a command may write a rawlog to; its folder is made.
/// \throws core::Error: kConfig (not named as a rawlog), kUnreadable (no such folder can be made).
std::string rawlogOutput(const std::string& path);

/// "1 step", "2 steps".
std::string count(std::size_t n, const std::string& what);
}  // namespace slamot::apps
