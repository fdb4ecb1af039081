#include <slamot/core/Error.h>
#include <slamot/importers/CsvFolder.h>
#include <slamot/mrpt/RawlogWriter.h>
#include <slamot/results/TruthFiles.h>

#include <cstdio>
#include <filesystem>

#include "Command.h"
#include "MrclamImport.h"
#include "TeamLogs.h"
#include "VictoriaParkImport.h"
#include "importOptions.h"
#include "rawlogOutput.h"

namespace slamot::apps
{
namespace
{
namespace fs = std::filesystem;
using core::Error;
using core::ExitStatus;

struct ImportOptions
{
  std::string kind, source, output;
  bool quiet = false;
  double startTime = 0;
  MrclamImport mrclam;
  VictoriaParkImport park;
  SensorImport sensor;
};

std::unique_ptr<importers::Import> open(const ImportOptions& o)
{
  if (o.kind == "csv") return importers::openCsvFolder(o.source, o.startTime);
  if (o.kind == "victoria-park") return importers::openVictoriaPark(o.source, o.park.options);
  return importers::openMrclam(o.source, o.mrclam.of(o.mrclam.options.robot));
}

bool holdsNothing(const eval::Truth& truth)
{
  return truth.robot.empty() && truth.targets.empty() && truth.landmarks.empty() &&
         truth.associations.empty();
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
  for (const int robot : importers::mrclamTeam(*o.mrclam.options.target))
  {
    auto source = importers::openMrclam(o.source, o.mrclam.of(robot));
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
  return static_cast<int>(o.mrclam.team ? importTeam(o) : importOne(o));
}

/// Options of another kind say nothing here: naming them is a mistake.
void refuseOptions(const CLI::App& group, const std::string& kind)
{
  for (const CLI::Option* option : group.get_options())
    if (option->count() > 0)
      throw Error(ExitStatus::kConfig, "command line",
                  option->get_name() + " is an option of " + kind, "remove it");
}

/// The groups of options that only some kinds have.
struct Groups
{
  CLI::App *csv, *mrclam, *park, *sensor;
};

Groups addGroups(CLI::App& command, ImportOptions& o)
{
  Groups out{command.add_option_group("csv", "Options of csv"),
             command.add_option_group("mrclam", "Options of mrclam"),
             command.add_option_group("victoria-park", "Options of victoria-park"),
             command.add_option_group("sensor", "Options of mrclam and victoria-park")};
  out.csv
      ->add_option("--start-time", o.startTime,
                   "When the first step starts [s], for times that count from an epoch")
      ->check(CLI::Range(0.0, 1e10))
      ->capture_default_str()
      ->type_name("T");
  o.mrclam.addTo(*out.mrclam);
  o.park.addTo(*out.park);
  o.sensor.addTo(*out.sensor);
  return out;
}

void checkKind(const Groups& groups, const ImportOptions& o)
{
  if (o.kind != "csv") refuseOptions(*groups.csv, "csv");
  if (o.kind != "mrclam") refuseOptions(*groups.mrclam, "mrclam");
  if (o.kind != "victoria-park") refuseOptions(*groups.park, "victoria-park");
  if (o.kind == "csv") refuseOptions(*groups.sensor, "mrclam and victoria-park");
  if (o.kind == "mrclam") o.mrclam.check(*groups.mrclam);
}

/// What was asked of the sensor, to the kind that it is for.
void shareSensor(ImportOptions& o)
{
  importers::MrclamOptions& mrclam = o.mrclam.options;
  importers::VictoriaParkOptions& park = o.park.options;
  mrclam.rangeScaleStd = o.sensor.rangeScaleStd.value_or(mrclam.rangeScaleStd);
  mrclam.bearingStd = o.sensor.bearingStd.value_or(mrclam.bearingStd);
  park.rangeScaleStd = o.sensor.rangeScaleStd.value_or(park.rangeScaleStd);
  park.bearingStd = o.sensor.bearingStd.value_or(park.bearingStd);
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
                         "         slamot import victoria-park park/ -o park.rawlog");
  command
      ->add_option("kind", options->kind,
                   "csv: a folder of CSV files; mrclam, victoria-park: the dataset's folder")
      ->required()
      ->check(CLI::IsMember({"csv", "mrclam", "victoria-park"}))
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
        shareSensor(*options);
        status = import(*options);
      });
}
}  // namespace slamot::apps
