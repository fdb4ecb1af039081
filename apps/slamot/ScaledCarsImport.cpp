#include "ScaledCarsImport.h"

#include "importOptions.h"

namespace slamot::apps
{
namespace
{
using Options = importers::ScaledCarsOptions;

void addCar(CLI::App& command, Options& o)
{
  const std::vector<CLI::Option*> lengths = {
      command.add_option("--wheel-radius", o.wheelRadius, "Front wheels, effective [m]"),
      command.add_option("--wheelbase", o.wheelbase, "Between the axles [m]"),
      command.add_option("--track", o.track, "Between the front wheels, effective [m]")};
  for (CLI::Option* option : lengths)
    option->type_name("M")->check(CLI::Range(1e-3, 10.0))->capture_default_str();
  command.add_option("--ahead", o.ahead, "The true pose's place ahead of the rear axle [m]")
      ->type_name("M")
      ->check(CLI::Range(-10.0, 10.0))
      ->capture_default_str();
}
}  // namespace

void ScaledCarsImport::addTo(CLI::App& command)
{
  Options& o = options;
  command
      .add_option_function<std::string>(
          "--heading",
          [&o](const std::string& by)
          { o.heading = by == "imu" ? Options::Heading::kImu : Options::Heading::kWheels; },
          "What tells how the car turns: its gyro, or the front wheels' difference")
      ->check(CLI::IsMember({"imu", "wheels"}))
      ->default_str("imu");
  command
      .add_option_function<double>(
          "--gyro-bias", [&o](double degrees) { o.gyroBias = math::degToRad(degrees); },
          "Taken off the gyro's rate [deg/s] (default its mean over the rest at the start)")
      ->check(CLI::Range(-100.0, 100.0))
      ->type_name("DEG");
  command
      .add_option_function<std::string>(
          "--true-heading",
          [&o](const std::string& what)
          {
            using True = Options::TrueHeading;
            o.trueHeading = what == "aligned"  ? True::kAligned
                            : what == "logged" ? True::kLogged
                                               : True::kNone;
          },
          "Of the cars' truth: aligned with how they drive, as logged, or none")
      ->check(CLI::IsMember({"aligned", "logged", "none"}))
      ->default_str("aligned");
  command.add_flag("--target-starts", o.targetStarts,
                   "Tell filters also where the targets truly start");
  addCar(command, o);
}
}  // namespace slamot::apps
