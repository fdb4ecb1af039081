#include <slamot/mrpt/RawlogInfo.h>

#include <cstdio>

#include "Command.h"

namespace slamot::apps
{
namespace
{
struct InfoOptions
{
  CommonOptions common;  // of which only plugins make sense here
  std::string path;
};

std::string number(const char* format, std::optional<double> value)
{
  if (!value) return "-";
  char text[64];
  std::snprintf(text, sizeof text, format, *value);
  return text;
}

void printObject(const std::string& name, const core::ObjectStart& start)
{
  const auto pose = start.pose();
  using F = core::ObjectStart;
  std::printf("start     %s at x %s m, y %s m, theta %s rad", name.c_str(),
              number("%.3f", start.value[F::kX]).c_str(),
              number("%.3f", start.value[F::kY]).c_str(),
              number("%.3f", start.value[F::kTheta]).c_str());
  const auto std = [&](F::Field f)
  { return number("%.3f", start.value[f] ? std::optional(start.getStd(f)) : std::nullopt); };
  if (pose.cov.trace() > 0)
    std::printf(", known to %s m, %s m, %s rad", std(F::kX).c_str(), std(F::kY).c_str(),
                std(F::kTheta).c_str());
  std::printf("\n");
}

void printStarts(const core::Starts& starts)
{
  if (starts.robot) printObject("robot", *starts.robot);
  for (const auto& [id, start] : starts.targets) printObject("target " + std::to_string(id), start);
  if (!starts.robot && starts.targets.empty())
    std::printf("start     not given: the robot starts at the origin\n");
}

std::string part(std::size_t n, std::size_t all)
{
  return n == all ? "all" : n == 0 ? "none" : std::to_string(n);
}

void printSightings(const char* heading, const char* what, const mrpt::SightingInfo& seen)
{
  if (seen.scans == 0) return;
  std::printf("%-9s %zu %s in %zu scans, of which %zu saw nothing", heading, seen.count, what,
              seen.scans, seen.empty);
  if (seen.count > 0) std::printf("; %s with identity", part(seen.identified, seen.count).c_str());
  if (seen.ranged < seen.count)
    std::printf(", %s with range", part(seen.ranged, seen.count).c_str());
  const char* separator = "; labelled ";
  for (const std::string& label : seen.labels)
  {
    std::printf("%s%s", separator, label.c_str());
    separator = ", ";
  }
  std::printf("\n");
}

void printSensors(const std::vector<mrpt::SensorInfo>& sensors)
{
  std::printf("%-40s %-12s %9s %9s\n", "class", "label", "count", "rate/Hz");
  for (const auto& s : sensors)
    std::printf("%-40s %-12s %9zu %9s\n", s.className.c_str(),
                s.label.empty() ? "-" : s.label.c_str(), s.count, number("%.2f", s.rate()).c_str());
}

void print(const std::string& path, const mrpt::RawlogInfo& info)
{
  if (info.error) std::printf("INCOMPLETE: what lies before the fault\n");
  std::printf("file      %s, %.1f kB, %s\n", path.c_str(), static_cast<double>(info.bytes) / 1e3,
              info.packed ? "gz" : "plain");
  std::printf("format    %s\n",
              info.hasFrames ? "pairs of actions and sensory frames" : "observations only");
  std::printf("entries   %zu, which make %zu steps\n", info.entries, info.steps);
  std::optional<double> duration;
  if (info.firstTime) duration = *info.lastTime - *info.firstTime;
  std::printf("duration  %s s, from %s s to %s s\n", number("%.3f", duration).c_str(),
              number("%.3f", info.firstTime).c_str(), number("%.3f", info.lastTime).c_str());
  printStarts(info.starts);
  printSightings("landmarks", "sightings", info.landmarks);
  printSightings("targets", "blobs", info.blobs);
  printSensors(info.sensors);
  for (const std::string& note : info.notes) std::printf("problem   %s\n", note.c_str());
  if (info.notes.empty() && !info.error) std::printf("problems  none found\n");
}

int showInfo(const InfoOptions& o)
{
  o.common.loadPlugins();
  const mrpt::RawlogInfo info = mrpt::inspectRawlog(o.path);
  if (!info.error || info.entries > 0) print(o.path, info);
  std::fflush(stdout);
  if (info.error) throw *info.error;
  return static_cast<int>(core::ExitStatus::kDone);
}
}  // namespace

void addInfo(CLI::App& app, int& status)
{
  auto options = std::make_shared<InfoOptions>();
  CLI::App* command =
      app.add_subcommand("info",
                         "Tell what is in a rawlog: sensors, rates, duration, start, problems.\n"
                         "Damaged input has its exit status.\n"
                         "Example: slamot info share/datasets/experiment1.rawlog");
  command->add_option("rawlog", options->path, "The rawlog")->required()->type_name("X.rawlog");
  command
      ->add_option("-p,--plugin", options->common.plugins,
                   "Load classes from a library; repeatable")
      ->type_name("LIB.so")
      ->allow_extra_args(false);
  command->callback([options, &status] { status = showInfo(*options); });
}
}  // namespace slamot::apps
