#include <slamot/results/Figures.h>
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

constexpr std::size_t kNameWidth = 26;

std::string left(std::string text)
{
  text.resize(std::max(kNameWidth, text.size() + 1), ' ');
  return text;
}

std::string right(const std::string& text, std::size_t width)
{
  return std::string(width > text.size() ? width - text.size() : 1, ' ') + text;
}

std::string cell(const std::optional<double>& v, int decimals, std::size_t width)
{
  return right(v ? fixed(*v, decimals) : "-", width);
}

std::string header()
{
  return left("") + "  steps         position error [m]  heading [rad]     NEES  in 95%\n" +
         left("") + "            mean    median      rmse           rmse     of 3 ellipse\n";
}

std::string errorLine(const std::string& name, const eval::ErrorSummary& e)
{
  std::optional<double> percent;
  if (e.coverage95) percent = 100 * *e.coverage95;
  return left(name) + right(std::to_string(e.count), 7) + cell(e.positionMean, 3, 9) +
         cell(e.positionMedian, 3, 10) + cell(e.positionRmse, 3, 10) + cell(e.headingRmse, 4, 15) +
         cell(e.neesMean, 2, 9) + (percent ? cell(percent, 1, 7) + "%" : right("-", 8)) + "\n";
}

std::string detailLines(const eval::TargetEvaluation& t)
{
  std::string text;
  const auto add = [&](const std::string& part, const eval::ErrorSummary& e)
  {
    if (e.count > 0) text += errorLine("  " + part, e);
  };
  add("at scans", t.atScans);
  add("at sightings", t.atSightings);
  add("as seen from the robot", t.relativeAtSightings);
  if (t.speedRmse) text += left("  speed") + fixed(*t.speedRmse, 3) + " m/s rmse\n";
  for (const eval::SinceSeen& bin : t.sinceSeen)
    add("unseen " + fixed(bin.from, 0) + (bin.to < 1e8 ? " to " + fixed(bin.to, 0) : "+") + " s",
        bin.errors);
  return text;
}

// Where the sensor gave identities, the one track has the target's name.
std::string targetLines(const eval::Record& record, const TargetGroup& group, bool detailed)
{
  if (!group.evaluation)
    return left("targets") + group.name + ": " + trackNames(record, group) + "\n";
  const eval::TargetEvaluation& t = *group.evaluation;
  if (t.all.count == 0) return left(group.name) + "never tracked\n";
  std::string text = errorLine(group.name, t.all);
  if (detailed) text += detailLines(t);
  if (!t.trackedFraction) return text;
  text += left("  tracked") + fixed(100 * *t.trackedFraction, 1) + "% of its steps";
  if (t.trackedSinceMoved && *t.trackedSinceMoved != *t.trackedFraction)
    text += ", " + fixed(100 * *t.trackedSinceMoved, 1) + "% since it first moved";
  if (!record.targets[group.tracks.front()].identified) text += ", " + trackNames(record, group);
  return text + "\n";
}

std::string landmarkLine(const std::string& name, const eval::LandmarkEvaluation& l)
{
  if (!l.mapped) return {};
  std::string line = left(name) + std::to_string(*l.mapped) + " mapped";
  if (l.trueOnes)
    line += ", " + std::to_string(*l.trueOnes) + " true, " +
            std::to_string(*l.mapped - *l.trueOnes) + " false";
  if (l.rmse) line += "; position " + fixed(*l.rmse, 3) + " m rmse";
  if (l.gospa)
    line += "; GOSPA " + fixed(l.gospa->total, 3) + " m, OSPA " + fixed(l.gospa->ospa, 3) + " m";
  return line + "\n";
}

std::string gospaParts(double localisation, double missed, double falseOnes)
{
  return left("  GOSPA's parts") + "localisation " + fixed(localisation, 3) + ", missed " +
         fixed(missed, 3) + ", false " + fixed(falseOnes, 3) + " m2\n";
}

std::string landmarkDetail(const eval::LandmarkEvaluation& l)
{
  std::string text;
  if (l.seen) text += left("  seen") + std::to_string(*l.seen) + " true ones\n";
  if (l.gospa) text += gospaParts(l.gospa->localisation, l.gospa->missed, l.gospa->falseOnes);
  return text;
}

std::string targetSetLines(const std::optional<eval::TargetSetErrors>& t)
{
  if (!t) return {};
  return left("targets as a set") + fixed(t->estimated, 2) + " tracked, " + fixed(t->truly, 2) +
         " there, mean over the scans; GOSPA " + fixed(t->gospa, 3) + " m, OSPA " +
         fixed(t->ospa, 3) + " m\n" + gospaParts(t->localisation, t->missed, t->falseOnes);
}

std::string rigidLines(const std::optional<eval::RigidEvaluation>& r)
{
  if (!r || r->robot.count == 0) return {};
  std::string text = left("after rigid alignment");
  if (r->robot.positionRmse) text += "robot " + fixed(*r->robot.positionRmse, 3) + " m rmse\n";
  return text + landmarkLine("  landmarks", r->landmarks) + landmarkDetail(r->landmarks);
}

std::string relationsLines(const eval::Evaluation& e)
{
  const auto errors = [](const eval::RelationErrors& r)
  {
    return r.translationMean ? "; mean errors " + fixed(*r.translationMean, 3) + " m, " +
                                   fixed(*r.rotationMean, 4) + " rad"
                             : "";
  };
  if (!e.relations) return {};
  const std::string count = std::to_string(e.relations->count);
  std::string text = left("relations") + count + " between its poses" + errors(*e.relations) + "\n";
  if (e.pathRelations)
    text += left("  of its final path") + std::to_string(e.pathRelations->count) +
            errors(*e.pathRelations) + "\n";
  return text;
}

std::string scanMapLine(const std::optional<eval::ScanMapQuality>& s)
{
  if (!s || !s->entropy) return {};
  std::string line = left("scan map") + "mean entropy " + fixed(*s->entropy, 3);
  if (s->pathEntropy) line += "; of its final path " + fixed(*s->pathEntropy, 3);
  if (s->odometryEntropy) line += "; of odometry alone " + fixed(*s->odometryEntropy, 3);
  return line + " (less is sharper)\n";
}

std::string percentOf(const char* what, const std::optional<double>& share)
{
  return share ? std::string("; ") + what + " " + fixed(100 * *share, 1) + "%" : "";
}

std::string associationDetail(const std::optional<eval::AssociationCounts>& a)
{
  if (!a || !a->correct) return {};
  const std::string text = percentOf("right of those paired", a->rightOfPaired()) +
                           percentOf("of those of landmarks", a->rightOfSightings()) +
                           percentOf("false alarms paired", a->pairedOfClutter());
  return text.empty() ? text : left("  shares") + text.substr(2) + "\n";
}

std::string associationLine(const std::optional<eval::AssociationCounts>& a)
{
  if (!a) return {};
  std::string line = left("sightings");
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
  if (!e.trueTargets.empty())
    for (const TargetGroup& group : targetGroups(record, e))
      text += targetLines(record, group, detailed);
  if (!text.empty()) text = header() + text;
  if (e.robot.all.coverage95 && e.robot.all.neesSkipped > 0)
    text += left("") + "NEES leaves out " + std::to_string(e.robot.all.neesSkipped) +
            " of the robot's steps, where its covariance is singular, as at an exact start\n";
  text += relationsLines(e) + scanMapLine(e.scanMap);
  if (detailed) text += targetSetLines(e.targetSet);
  text += landmarkLine("landmarks", e.landmarks);
  if (detailed) text += landmarkDetail(e.landmarks);
  text += associationLine(e.association);
  if (detailed) text += associationDetail(e.association) + rigidLines(e.rigid);
  if (record.close > 0)
    text += left("close") + std::to_string(record.close) +
            " sightings, too near for polar coordinates, taken along their ray\n";
  int dropped = 0;
  for (const eval::StepRow& s : record.steps) dropped += s.dropped;
  if (dropped > 0)
    text += left("dropped") + std::to_string(dropped) +
            " sightings, at or below range 0 or out of the field of view\n";
  return text;
}
}  // namespace slamot::results
