#pragma once

#include <slamot/eval/Alignment.h>

#include <optional>
#include <string>
#include <vector>

namespace slamot::study
{
/// Mean errors of a run over equal parts of its time.
struct ErrorCurves
{
  /// One kind of error over the run.
  struct Curve
  {
    std::string name;                           ///< as isCurveName() knows them
    std::vector<std::optional<double>> values;  ///< by part; absent where there was no error
  };
  double durationS = 0;       ///< of all parts together
  std::vector<Curve> curves;  ///< those that the run has truth for

  /// The curve of that name; null if there is none.
  [[nodiscard]] const Curve* named(const std::string& name) const;
};

/// Sizes of the errors of position and heading: of the robot (of a team's robots the mean) and of
/// the target (the mean over true targets and robots), and of each robot of a team.
/// \param evaluations of the runs of a team's robots, or of the one run
[[nodiscard]] ErrorCurves errorCurves(const std::vector<eval::RunWithTruth>& runs,
                                      const std::vector<eval::Evaluation>& evaluations, int parts);

/// Whether some run can have a curve of that name.
[[nodiscard]] bool isCurveName(const std::string& name);
/// What it is of, with its unit.
[[nodiscard]] std::string curveLabel(const std::string& name);
}  // namespace slamot::study
