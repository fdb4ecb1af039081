#include <slamot/core/Error.h>
#include <slamot/importers/CsvFolder.h>
#include <slamot/importers/Mrclam.h>
#include <slamot/mrpt/RawlogWriter.h>
#include <slamot/results/TruthFiles.h>

#include <cstdio>
#include <filesystem>

#include "Command.h"
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
  std::string start = "truth";
  double startTime = 0;
  importers::MrclamOptions mrclam;
};

std::unique_ptr<importers::Import> open(const ImportOptions& o)
{
  if (o.kind == "csv") return importers::openCsvFolder(o.source, o.startTime);
  importers::MrclamOptions options = o.mrclam;
  options.startFromTruth = o.start == "truth";
  return importers::openMrclam(o.source, options);
}

bool holdsNothing(const eval::Truth& truth)
{
  return truth.robot.empty() && truth.targets.empty() && truth.landmarks.empty() &&
         truth.associations.empty();
}

void report(const std::string& path, const importers::Counts& c, const std::string& truth)
{
  std::string dropped = std::to_string(c.outOfView + c.outOfTime + c.unknown) + " dropped";
  const auto reason = [&](std::size_t n, const char* why)
  { return n ? ", " + std::to_string(n) + " " + why : std::string(); };
  const std::string reasons = reason(c.outOfView, "at range <= 0 or out of the field of view") +
                              reason(c.outOfTime, "outside odometry's time") +
                              reason(c.unknown, "with an unknown or the robot's own barcode");
  if (!reasons.empty()) dropped += " (" + reasons.substr(2) + ")";
  std::printf("%s: %s, %s in %s, %s in %s, %s, %s, %.3f s; truth: %s\n", path.c_str(),
              count(c.steps, "step").c_str(), count(c.sightings, "sighting").c_str(),
              count(c.landmarkScans, "scan").c_str(), count(c.blobs, "blob").c_str(),
              count(c.blobScans, "scan").c_str(), count(c.lasers, "laser scan").c_str(),
              dropped.c_str(), c.end - c.start, truth.empty() ? "none" : truth.c_str());
}

int import(const ImportOptions& o)
{
  const std::string path = rawlogOutput(o.output);
  const auto source = open(o);
  mrpt::RawlogWriter writer(path, mrpt::RawlogWriter::Format::kActionFrames, source->starts());
  while (const auto step = source->next())
  {
    if (interrupted) return static_cast<int>(ExitStatus::kInterrupted);
    writer.write(*step);
  }
  std::string truth = results::truthFolder(path);
  // An older import's truth must not stand beside this one's log.
  const bool none = holdsNothing(source->truth());
  if (!none || fs::exists(truth)) results::saveTruth(truth, source->truth());
  writer.close();
  if (none) truth.clear();
  if (o.quiet) return static_cast<int>(ExitStatus::kDone);
  for (const std::string& warning : source->warnings())
    std::fprintf(stderr, "slamot: warning: %s\n", warning.c_str());
  report(path, source->counts(), truth);
  return static_cast<int>(ExitStatus::kDone);
}

/// An option in degrees for a value kept in radians.
CLI::Option* addDegrees(CLI::App& command, const std::string& name, double& radians,
                        const std::string& what)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", math::radToDeg(radians));
  return command
      .add_option_function<double>(
          name, [&radians](double degrees) { radians = math::degToRad(degrees); }, what)
      ->default_str(text);
}

void addSensorOptions(CLI::App& command, ImportOptions& o)
{
  importers::MrclamOptions& m = o.mrclam;
  importers::WheelNoise& wheels = m.wheels;
  const std::vector<CLI::Option*> options = {
      command.add_option("--std-distance", wheels.distance, "Odometry's distance [m/sqrt(s)]"),
      command.add_option("--std-distance-turning", wheels.distanceTurning,
                         "The same while turning [m/sqrt(rad turned)]"),
      addDegrees(command, "--std-heading", wheels.heading, "Odometry's heading [deg/sqrt(s)]"),
      command.add_option("--std-heading-turning", wheels.headingTurning,
                         "The same while turning [rad/sqrt(rad turned)]"),
      command.add_option("--std-range", m.rangeStd, "Ranges [m]"),
      command.add_option("--std-range-scale", m.rangeScaleStd,
                         "Ranges, part of the range, added in squares"),
      addDegrees(command, "--std-bearing", m.bearingStd, "Bearings [deg]")};
  for (CLI::Option* option : options)
    option->type_name("STD")->check(CLI::Range(0.0, 1e3))->capture_default_str();
}

void addMrclamOptions(CLI::App& command, ImportOptions& o)
{
  importers::MrclamOptions& m = o.mrclam;
  command.add_option("--robot", m.robot, "Whose data, 1 to 5 (required)")
      ->check(CLI::Range(1, 5))
      ->type_name("N");
  command.add_flag("--landmark-ids,!--no-landmark-ids", m.landmarkIds,
                   "Sightings tell which landmark they are of (default), or not");
  command.add_flag("--target-ids,!--no-target-ids", m.targetIds,
                   "Blobs tell which robot they are of (default), or not");
  command.add_option("--start", o.start, "Where the robot starts: at its true pose or the origin")
      ->check(CLI::IsMember({"truth", "origin"}))
      ->capture_default_str();
  command.add_option("--max-step", m.maxStep, "Longest step between camera images [s]")
      ->check(CLI::Range(1e-3, 1e3))
      ->capture_default_str()
      ->type_name("S");
  command
      .add_option("--odometry-delay", m.odometryDelay, "Motion follows logged velocities by [s]")
      ->check(CLI::Range(-10.0, 10.0))
      ->capture_default_str()
      ->type_name("S");
  addSensorOptions(command, o);
}

/// Options of another kind say nothing here: naming them is a mistake.
void refuseOptions(const CLI::App& group, const std::string& kind)
{
  for (const CLI::Option* option : group.get_options())
    if (option->count() > 0)
      throw Error(ExitStatus::kConfig, "command line",
                  option->get_name() + " is an option of " + kind, "remove it");
}

void checkKind(const CLI::App& csv, const CLI::App& mrclam, const ImportOptions& o)
{
  if (o.kind != "csv") refuseOptions(csv, "csv");
  if (o.kind != "mrclam") refuseOptions(mrclam, "mrclam");
  if (o.kind == "mrclam" && mrclam.count("--robot") == 0)
    throw Error(ExitStatus::kConfig, "command line", "mrclam needs a robot",
                "add --robot N, 1 to 5");
}
}  // namespace

void addImport(CLI::App& app, int& status)
{
  auto options = std::make_shared<ImportOptions>();
  CLI::App* command =
      app.add_subcommand("import",
                         "Write a rawlog and its ground truth from data of another format.\n"
                         "Example: slamot import csv my-drive/ -o my-drive.rawlog\n"
                         "         slamot import mrclam dataset6/ --robot 1 -o robot1.rawlog");
  command
      ->add_option("kind", options->kind, "csv: a folder of CSV files; mrclam: a dataset's folder")
      ->required()
      ->check(CLI::IsMember({"csv", "mrclam"}))
      ->type_name("KIND");
  command->add_option("source", options->source, "Where the data is")
      ->required()
      ->type_name("SOURCE");
  command->add_option("-o,--output", options->output, "The rawlog; truth goes to X.truth/")
      ->required()
      ->type_name("X.rawlog");
  command->add_flag("-q,--quiet", options->quiet, "Errors only");
  CLI::App* csv = command->add_option_group("csv", "Options of csv");
  csv->add_option("--start-time", options->startTime,
                  "When the first step starts [s], for times that count from an epoch")
      ->check(CLI::Range(0.0, 1e10))
      ->capture_default_str()
      ->type_name("T");
  CLI::App* mrclam = command->add_option_group("mrclam", "Options of mrclam");
  addMrclamOptions(*mrclam, *options);
  command->callback(
      [options, csv, mrclam, &status]
      {
        checkKind(*csv, *mrclam, *options);
        status = import(*options);
      });
}
}  // namespace slamot::apps
