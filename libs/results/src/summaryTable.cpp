#include <slamot/results/Summary.h>
#include <slamot/results/TextFile.h>

#include <cmath>

namespace slamot::results
{
namespace
{
std::string fixed(double v, int decimals)
{
  std::string text;
  appendFixed(text, v, decimals);
  return text;
}

std::string padded(std::string text, std::size_t width = 18)
{
  text.resize(std::max(width, text.size() + 1), ' ');
  return text;
}

std::string errorLine(const std::string& name, const eval::ErrorSummary& e)
{
  std::string line = "  " + padded(name);
  if (!e.positionMean) return line + "no truth at its times\n";
  line +=
      "position " + fixed(*e.positionMean, 3) + " m mean, " + fixed(*e.positionRmse, 3) + " m rmse";
  if (e.headingRmse) line += "; heading " + fixed(*e.headingRmse, 4) + " rad rmse";
  if (e.neesMean) line += "; NEES " + fixed(*e.neesMean, 2) + " (3 expected)";
  if (e.coverage95) line += "; " + fixed(100 * *e.coverage95, 1) + "% inside the 95% ellipse";
  line += "; " + std::to_string(e.count) + " steps";
  if (e.neesSkipped > 0)
    line += ", " + std::to_string(e.neesSkipped) + " of them without a covariance to judge by";
  return line + "\n";
}

std::string targetLines(const eval::TargetEvaluation& t, bool detailed)
{
  const std::string name = "target " + std::to_string(t.id);
  if (!t.truthId) return "  " + padded(name) + "stands for no target of the truth\n";
  if (!t.all.positionMean) return "  " + padded(name) + "never tracked\n";
  std::string text = errorLine(name, t.all);
  if (t.trackedFraction)
    text += "  " + padded("") + "tracked in " + fixed(100 * *t.trackedFraction, 1) + "% of steps\n";
  if (!detailed) return text;
  if (t.atScans.count > 0) text += errorLine("  at scans", t.atScans);
  if (t.atSightings.count > 0) text += errorLine("  at sightings", t.atSightings);
  if (t.relativeAtSightings.count > 0)
    text += errorLine("  seen from robot", t.relativeAtSightings);
  for (const eval::SinceSeen& bin : t.sinceSeen)
    if (bin.errors.count > 0)
      text += errorLine("  unseen " + fixed(bin.from, 0) +
                            (bin.to < 1e8 ? " to " + fixed(bin.to, 0) + " s" : " s and more"),
                        bin.errors);
  return text;
}

std::string landmarkLine(const eval::LandmarkEvaluation& l)
{
  if (!l.mapped) return {};
  std::string line = "  " + padded("landmarks") + std::to_string(*l.mapped) + " mapped";
  if (l.trueOnes)
    line += ", " + std::to_string(*l.trueOnes) + " true, " +
            std::to_string(*l.mapped - *l.trueOnes) + " false";
  if (l.rmse) line += "; position " + fixed(*l.rmse, 3) + " m rmse";
  if (l.gospa) line += "; GOSPA " + fixed(l.gospa->total, 3) + " m";
  return line + "\n";
}

std::string associationLine(const std::optional<eval::AssociationCounts>& a)
{
  if (!a) return {};
  std::string line = "  " + padded("sightings");
  if (a->correct) line += std::to_string(*a->correct) + " paired right, ";
  if (a->wrong) line += std::to_string(*a->wrong) + " wrong, ";
  return line + std::to_string(a->created) + " new, " + std::to_string(a->rejected) + " rejected\n";
}
}  // namespace

std::string summaryTable(const eval::Record& record, const eval::Evaluation& e, bool detailed)
{
  std::string text;
  if (e.robot.all.count > 0) text += errorLine("robot", e.robot.all);
  if (detailed && e.robot.atScans.count > 0) text += errorLine("  at scans", e.robot.atScans);
  for (const eval::TargetEvaluation& t : e.targets)
    if (!e.trueTargets.empty()) text += targetLines(t, detailed);
  text += landmarkLine(e.landmarks);
  text += associationLine(e.association);
  int dropped = 0;
  for (const eval::StepRow& s : record.steps) dropped += s.dropped;
  if (dropped > 0)
    text += "  " + padded("dropped") + std::to_string(dropped) +
            " sightings at or below range 0 or out of the field of view\n";
  return text;
}
}  // namespace slamot::results
