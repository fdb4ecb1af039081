#pragma once

#include <slamot/reproduce/PaperSpec.h>
#include <slamot/results/Figures.h>
#include <slamot/study/Trial.h>

namespace slamot::reproduce
{
struct TitledFigure
{
  std::string title;  ///< empty: it is the only one
  results::Figure figure;
};

/// What a kind of picture shows of a run; none if the run has nothing of it.
[[nodiscard]] std::vector<TitledFigure> runFigures(Picture::Kind kind, const study::Trial& trial,
                                                   const study::FinishedTrial& done);
}  // namespace slamot::reproduce
