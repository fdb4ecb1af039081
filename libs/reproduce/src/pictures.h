#pragma once

#include <slamot/reproduce/Reproduction.h>

namespace slamot::reproduce
{
/// A picture of one run of a study: as kept in the study's folder, in pictures/, or made anew and
/// kept there.  Its file's name tells all that it depends on.
[[nodiscard]] Drawn drawn(const Picture& picture, const study::Plan& plan,
                          const std::string& studyFolder);
}  // namespace slamot::reproduce
