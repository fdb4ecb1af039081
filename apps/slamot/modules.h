#pragma once

#include <string>

namespace slamot::apps
{
/// A function of one of the program's own modules, which is loaded now: its libraries take long to
/// load, and few commands need it.  \param module such as "slamot-video".
/// \throws core::Error (kInternal) if it can't be loaded.
[[nodiscard]] void* moduleFunction(const std::string& module, const std::string& function);

template <class Function>
[[nodiscard]] Function* moduleFunction(const std::string& module, const std::string& function)
{
  return reinterpret_cast<Function*>(moduleFunction(module, function));
}
}  // namespace slamot::apps
