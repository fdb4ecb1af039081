#include <slamot/core/Error.h>

#include <cstdio>

#include "Command.h"
#include "ImagesBeside.h"
#include "LogDetection.h"
#include "Progress.h"
#include "rawlogOutput.h"

namespace slamot::apps
{
namespace
{
struct DetectOptions
{
  CommonOptions common;
  std::string config, dataset;
};

void report(const std::string& path, const LogDetection& detection)
{
  const auto& c = detection.counts();
  std::printf(
      "%s: %s in %s (%zu cut by the edge, %zu ranged, %zu out of the laser's reach, %zu "
      "ambiguous); "
      "%s in %s (%zu clusters left out as moving)\n",
      path.c_str(), count(c.blobs, "blob").c_str(), count(c.images, "image").c_str(), c.cut,
      c.ranged, c.unreached, c.ambiguous, count(c.landmarks, "landmark sighting").c_str(),
      count(c.scans, "scan").c_str(), c.moving);
  for (const std::string& warning : detection.warnings())
    std::fprintf(stderr, "slamot: warning: %s: %s\n", path.c_str(), warning.c_str());
}

int detect(const DetectOptions& o)
{
  o.common.loadPlugins();
  if (o.common.output.empty())
    throw core::Error(core::ExitStatus::kConfig, "command line --output", "is missing",
                      "name the new rawlog");
  core::Config config = core::Config::load(o.config);
  for (const std::string& assignment : o.common.set) config.set(assignment);
  perception::Pipeline pipeline(config);
  config.requireAllRead();

  const std::string path = rawlogOutput(o.common.output);
  requirePlaceForLink(path);
  mrpt::RawlogEditor editor(o.dataset, path);
  LogDetection detection(pipeline, editor, o.dataset);
  Progress progress("entries", o.common.quiet);
  while (detection.advance())
  {
    if (interrupted) return static_cast<int>(core::ExitStatus::kInterrupted);
    progress.update(detection.entries(), editor.progress());
  }
  editor.close();
  linkImages(o.dataset, path);
  progress.finish();
  if (!o.common.quiet) report(path, detection);
  return 0;
}
}  // namespace

void addDetect(CLI::App& app, int& status)
{
  auto options = std::make_shared<DetectOptions>();
  CLI::App* command = app.add_subcommand(
      "detect",
      "Add to a rawlog what its images and scans show: colour blobs, ranged by laser, and "
      "landmarks.\n"
      "Example: slamot detect config-ini/detect.ini drive.rawlog -o seen.rawlog");
  options->common.addTo(*command);
  command->get_option("--output")
      ->description("The rawlog with what was found added, and all the rest kept")
      ->type_name("OUT.rawlog");
  command->add_option("config", options->config, "What to look for, as config-ini/detect.ini")
      ->required()
      ->type_name("CONFIG.ini");
  command->add_option("dataset", options->dataset, "The rawlog")
      ->required()
      ->type_name("IN.rawlog");
  command->callback([options, &status] { status = detect(*options); });
}
}  // namespace slamot::apps
