#include "scanMapAlong.h"

#include <slamot/core/Error.h>
#include <slamot/eval/ScansAlong.h>
#include <slamot/mrpt/RawlogSource.h>

#include <cstdio>
#include <filesystem>

namespace slamot::apps
{
namespace
{
namespace fs = std::filesystem;
using core::Error;
using core::ExitStatus;

// As the run read it; of a mere path, noise changes nothing about where scans are, so that a log
// needs not tell any.
mrpt::RawlogSource::Options optionsFor(const std::string& result)
{
  const fs::path config = fs::path(result) / "config.ini";
  mrpt::RawlogSource::Options out;
  out.odometry.fromLog = false;
  out.sensor = {1, 1};
  if (!fs::exists(config)) return out;
  core::Config ini = core::Config::load(config.string());
  return mrpt::RawlogSource::Options::from(ini);
}
}  // namespace

eval::ScanMapQuality scanMapAlong(const eval::Record& path, const std::string& rawlog,
                                  const std::string& result)
{
  mrpt::RawlogSource log(rawlog, optionsFor(result));
  const eval::ScansAlong scans = eval::scansAlong(path, log);
  const auto quality = eval::scanMapQuality(scans.record);
  if (!quality)
    throw Error(ExitStatus::kNonsense, rawlog,
                scans.leftOut > 0 ? "at no scan's time the path has a pose" : "has no laser scan",
                "give the log that the path is of");
  if (scans.leftOut > 0)
    std::fprintf(stderr,
                 "slamot: warning: %s: %zu laser scans left out, where the path has no pose\n",
                 rawlog.c_str(), scans.leftOut);
  return *quality;
}
}  // namespace slamot::apps
