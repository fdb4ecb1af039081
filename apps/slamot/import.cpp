#include <slamot/core/Error.h>
#include <slamot/importers/CsvFolder.h>
#include <slamot/mrpt/RawlogWriter.h>
#include <slamot/results/TruthFiles.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <map>

#include "Command.h"
#include "SharedImport.h"
#include "TeamLogs.h"
#include "rawlogOutput.h"

namespace slamot::apps
{
namespace
{
namespace fs = std::filesystem;
using core::Error;
using core::ExitStatus;

constexpr std::array kKinds = {"csv", "mrclam", "victoria-park", "carmen", "scaled-cars"};

struct ImportOptions
{
  std::string kind, source, output;
  bool quiet = false;
  double startTime = 0;
  KindImports kinds;
  SharedImport shared;
};

std::unique_ptr<importers::Import> open(const ImportOptions& o)
{
  if (o.kind == "csv") return importers::openCsvFolder(o.source, o.startTime);
  if (o.kind == "victoria-park") return importers::openVictoriaPark(o.source, o.kinds.park.options);
  if (o.kind == "carmen") return importers::openCarmen(o.source, o.kinds.carmen.options);
  if (o.kind == "scaled-cars") return importers::openScaledCars(o.source, o.kinds.cars.options);
  const MrclamImport& mrclam = o.kinds.mrclam;
  return importers::openMrclam(o.source, mrclam.of(mrclam.options.robot));
}

bool holdsNothing(const eval::Truth& truth)
{
  return truth.robot.empty() && truth.targets.empty() && truth.landmarks.empty() &&
         truth.associations.empty() && truth.relations.empty();
}

void report(const std::string& path, const importers::Import& source, const std::string& truth)
{
  for (const std::string& warning : source.warnings())
    std::fprintf(stderr, "slamot: warning: %s\n", warning.c_str());
  const importers::Counts& c = source.counts();
  std::string dropped =
      std::to_string(c.outOfView + c.outOfTime + c.unknown + c.hidden) + " dropped";
  const auto reason = [&](std::size_t n, const char* why)
  { return n ? ", " + std::to_string(n) + " " + why : std::string(); };
  const std::string reasons = reason(c.outOfView, "at range <= 0 or out of the field of view") +
                              reason(c.outOfTime, "outside odometry's time") +
                              reason(c.unknown, "with an unknown or the robot's own barcode") +
                              reason(c.hidden, "hidden landmarks");
  if (!reasons.empty()) dropped += " (" + reasons.substr(2) + ")";
  std::printf("%s: %s, %s in %s, %s in %s, %s, %s, %.3f s; truth: %s\n", path.c_str(),
              count(c.steps, "step").c_str(), count(c.sightings, "sighting").c_str(),
              count(c.landmarkScans, "scan").c_str(), count(c.blobs, "blob").c_str(),
              count(c.blobScans, "scan").c_str(), count(c.lasers, "laser scan").c_str(),
              dropped.c_str(), c.end - c.start, truth.empty() ? "none" : truth.c_str());
}

/// All steps of a source; false if interrupted.
bool writeSteps(importers::Import& source, mrpt::RawlogWriter& writer)
{
  while (const auto step = source.next())
  {
    if (interrupted) return false;
    writer.write(*step);
  }
  return true;
}

mrpt::RawlogWriter openLog(const std::string& path, const importers::Import& source)
{
  return {path, mrpt::RawlogWriter::Format::kActionFrames, source.starts()};
}

ExitStatus importOne(const ImportOptions& o)
{
  const std::string path = rawlogOutput(o.output);
  const auto source = open(o);
  mrpt::RawlogWriter writer = openLog(path, *source);
  if (!writeSteps(*source, writer)) return ExitStatus::kInterrupted;
  std::string truth = results::truthFolder(path);
  // An older import's truth must not stand beside this one's log.
  const bool none = holdsNothing(source->truth());
  if (!none || fs::exists(truth)) results::saveTruth(truth, source->truth());
  writer.close();
  if (none) truth.clear();
  if (!o.quiet) report(path, *source, truth);
  return ExitStatus::kDone;
}

ExitStatus importTeam(const ImportOptions& o)
{
  TeamLogs logs(o.output);
  std::vector<std::pair<int, std::unique_ptr<importers::Import>>> sources;
  for (const int robot : importers::mrclamTeam(*o.kinds.mrclam.options.target))
  {
    auto source = importers::openMrclam(o.source, o.kinds.mrclam.of(robot));
    mrpt::RawlogWriter writer = openLog(logs.partOf(robot), *source);
    if (!writeSteps(*source, writer)) return ExitStatus::kInterrupted;
    writer.close();
    logs.add(robot, source->truth());
    sources.emplace_back(robot, std::move(source));
  }
  logs.place();
  for (const auto& [robot, source] : sources)
    if (!o.quiet) report(logs.pathOf(robot), *source, results::truthFolder(logs.pathOf(robot)));
  return ExitStatus::kDone;
}

int import(const ImportOptions& o)
{
  return static_cast<int>(o.kinds.mrclam.team ? importTeam(o) : importOne(o));
}

/// Options of another kind say nothing here: naming them is a mistake.
void refuseOptions(const CLI::App& group, const std::string& kind)
{
  for (const CLI::Option* option : group.get_options())
    if (option->count() > 0)
      throw Error(ExitStatus::kConfig, "command line",
                  option->get_name() + " is an option of " + kind, "remove it");
}

/// The groups of options that only one kind has, by its name.
using Groups = std::map<std::string, CLI::App*>;

Groups addGroups(CLI::App& command, ImportOptions& o)
{
  Groups out;
  for (const char* kind : kKinds)
    out[kind] = command.add_option_group(kind, std::string("Options of ") + kind);
  out["csv"]
      ->add_option("--start-time", o.startTime,
                   "When the first step starts [s], for times that count from an epoch")
      ->check(CLI::Range(0.0, 1e10))
      ->capture_default_str()
      ->type_name("T");
  o.kinds.mrclam.addTo(*out["mrclam"]);
  o.kinds.park.addTo(*out["victoria-park"]);
  o.kinds.carmen.addTo(*out["carmen"]);
  o.kinds.cars.addTo(*out["scaled-cars"]);
  o.shared.addTo(*command.add_option_group("shared", "Options of several kinds"), o.kinds);
  return out;
}

void checkKind(const Groups& groups, const ImportOptions& o)
{
  for (const auto& [kind, group] : groups)
    if (kind != o.kind) refuseOptions(*group, kind);
  o.shared.check(o.kind);
  if (o.kind == "mrclam") o.kinds.mrclam.check(*groups.at("mrclam"));
}
}  // namespace

void addImport(CLI::App& app, int& status)
{
  auto options = std::make_shared<ImportOptions>();
  CLI::App* command =
      app.add_subcommand("import",
                         "Write a rawlog and its ground truth from data of another format.\n"
                         "Example: slamot import csv my-drive/ -o my-drive.rawlog\n"
                         "         slamot import mrclam dataset6/ --robot 1 -o robot1.rawlog\n"
                         "         slamot import mrclam dataset6/ --team --target 5 -o all.rawlog\n"
                         "         slamot import victoria-park park/ -o park.rawlog\n"
                         "         slamot import carmen intel.log.gz -o intel.rawlog\n"
                         "         slamot import scaled-cars overtakes/ -o overtakes.rawlog");
  command
      ->add_option("kind", options->kind,
                   "csv: a folder of CSV files; mrclam, victoria-park, scaled-cars: the dataset's "
                   "folder; carmen: a log")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(kKinds.begin(), kKinds.end())))
      ->type_name("KIND");
  command->add_option("source", options->source, "Where the data is")
      ->required()
      ->type_name("SOURCE");
  command
      ->add_option("-o,--output", options->output,
                   "The rawlog; truth goes to X.truth/; a team's: X.robot<k>.rawlog, ...")
      ->required()
      ->type_name("X.rawlog");
  command->add_flag("-q,--quiet", options->quiet, "Errors only");
  const Groups groups = addGroups(*command, *options);
  command->callback(
      [options, groups, &status]
      {
        checkKind(groups, *options);
        status = import(*options);
      });
}
}  // namespace slamot::apps
