#pragma once

#include <slamot/core/Error.h>

#include <exception>

namespace slamot::mrpt
{
/// What to tell the user when drawing failed.
[[nodiscard]] inline core::Error openGlError(const std::exception& e)
{
  return {core::ExitStatus::kInternal, "OpenGL", e.what(), "install libegl1 and libgl1-mesa-dri"};
}
}  // namespace slamot::mrpt
