#pragma once

#include <slamot/core/Params.h>
#include <slamot/reproduce/PaperSpec.h>

namespace slamot::reproduce
{
/// A section's study as its file has it, and as it is run: a quick one may leave out methods and
/// values.  What claims name has to be in one of them.
struct Studies
{
  const study::StudySpec& asFiled;
  const study::StudySpec& asRun;
};

/// The claims of these names.  \param studies null: the section has none, and nothing is testable
/// \throws core::Error (kConfig).
std::vector<Claim> readClaims(core::Config& paper, core::Params& section,
                              const std::vector<std::string>& names, const Studies* studies);

/// The pictures of these names.  \throws core::Error (kConfig).
std::vector<Picture> readPictures(core::Config& paper, core::Params& section,
                                  const std::vector<std::string>& names, const Studies& studies);
}  // namespace slamot::reproduce
