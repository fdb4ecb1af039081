#include "Command.h"

#include <slamot/core/Error.h>
#include <slamot/core/version.h>
#include <slamot/filters/registerAll.h>
#include <slamot/scans/registerAll.h>

#include <charconv>
#include <csignal>
#include <cstdio>

namespace slamot::apps
{
std::atomic<bool> interrupted{false};

namespace
{
/// CLI takes too large a number for the largest, and names a wrong one's limits with 300 digits.
std::string checkSeed(const std::string& text)
{
  std::uint64_t seed = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, seed);
  if (error == std::errc{} && end == last) return {};
  return "'" + text + "' is not a whole number from 0 to 18446744073709551615";
}
}  // namespace

void CommonOptions::addTo(CLI::App& command)
{
  command.add_option("-o,--output", output, "Where results go")->type_name("DIR");
  command
      .add_option_function<std::uint64_t>(
          "--seed", [this](std::uint64_t s) { seed = s, seedGiven = true; },
          "Seed of all randomness (default 1)")
      ->check(CLI::Validator(checkSeed, ""))
      ->type_name("N");
  command.add_option("--threads", threads, "Threads; results do not depend on them")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  command.add_option("--set", set, "Override a config value; repeatable")
      ->type_name("Section.key=value")
      ->allow_extra_args(false);
  command.add_option("-p,--plugin", plugins, "Load filters or classes from a library; repeatable")
      ->type_name("LIB.so")
      ->allow_extra_args(false);
  command.add_flag("-q,--quiet", quiet, "Errors only");
  command.add_flag("-v,--verbose", verbose, "More detail");
}
}  // namespace slamot::apps

namespace
{
using namespace slamot;

int fail(core::ExitStatus status, const std::string& what)
{
  std::string line = what;
  for (char& c : line)
    if (c == '\n' || c == '\r') c = ' ';
  std::fprintf(stderr, "slamot: error: %s\n", line.c_str());
  return static_cast<int>(status);
}

int runCommand(int argc, char** argv)
{
  CLI::App app{
      "Simultaneous localization, mapping and object tracking for mobile robots.\n"
      "Example: slamot run config-ini/rbpf-slamot.experiment1.ini "
      "share/datasets/experiment1.rawlog",
      "slamot"};
  app.set_version_flag("--version", kVersion);
  app.require_subcommand(1);
  int status = 0;
  slamot::apps::addRun(app, status);
  slamot::apps::addEvaluate(app, status);
  slamot::apps::addInfo(app, status);
  slamot::apps::addRender(app, status);
  slamot::apps::addSimulate(app, status);
  slamot::apps::addStudy(app, status);
  slamot::apps::addReproduce(app, status);
  slamot::apps::addTeam(app, status);
  slamot::apps::addRobot(app, status);
  slamot::apps::addImport(app, status);
  slamot::apps::addDetect(app, status);
  slamot::apps::addCalibrateColor(app, status);
  slamot::apps::addComplete(app, status);
  slamot::apps::addManPages(app, status);
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::Success& e)
  {
    return app.exit(e);
  }
  catch (const CLI::ParseError& e)
  {
    // CLI would say that a command is missing.
    const std::string first = argc > 1 ? argv[1] : "-";
    const auto isFirst = [&](const CLI::App* command) { return command->check_name(first); };
    const bool unknown = first[0] != '-' && app.get_subcommands(isFirst).empty();
    const std::string what = unknown ? "'" + first + "' is no command" : e.what();
    return fail(core::ExitStatus::kConfig, "command line: " + what + "; see slamot --help");
  }
  return status;
}
}  // namespace

int main(int argc, char** argv)
{
  // The first Ctrl-C asks, the second ends at once.
  std::signal(SIGINT,
              [](int)
              {
                slamot::apps::interrupted = true;
                std::signal(SIGINT, SIG_DFL);
              });
  try
  {
    slamot::filters::registerAll();
    slamot::scans::registerAll();
    return runCommand(argc, argv);
  }
  catch (const slamot::core::Error& e)
  {
    return fail(e.status(), e.what());
  }
  catch (const std::bad_alloc&)
  {
    return fail(slamot::core::ExitStatus::kLimit,
                "memory: exhausted; use a smaller input or fewer particles");
  }
  catch (const std::exception& e)
  {
    return fail(slamot::core::ExitStatus::kInternal,
                std::string("internal: ") + e.what() + "; please report it");
  }
}
