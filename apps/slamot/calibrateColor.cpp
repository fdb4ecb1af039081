#include <slamot/core/Error.h>
#include <slamot/perception/calibrateColor.h>

#include <cstdio>
#include <opencv2/imgcodecs.hpp>

#include "Command.h"

namespace slamot::apps
{
namespace
{
struct CalibrateColorOptions
{
  std::string image, label = "target";
  std::vector<int> box;
};

void calibrateColor(const CalibrateColorOptions& o)
{
  using core::Error;
  using core::ExitStatus;
  const cv::Mat image = cv::imread(o.image, cv::IMREAD_COLOR);
  if (image.empty())
    throw Error(ExitStatus::kUnreadable, o.image, "is not an image that can be read",
                "give a PNG, a JPEG or the like");
  perception::ColorProposal proposal;
  try
  {
    proposal = perception::proposeColor(image, {o.box[0], o.box[1], o.box[2], o.box[3]});
  }
  catch (const std::invalid_argument& e)
  {
    throw Error(ExitStatus::kConfig, "command line --box", e.what(),
                "give left, top, width and height in pixels");
  }
  std::printf(
      "// finds %.0f%% of what the box holds; %.1f%% of what it finds lies outside the box\n",
      100 * proposal.found, 100 * proposal.stray);
  std::printf("[color.%s]\n%s", o.label.c_str(), proposal.range.toIni().c_str());
}
}  // namespace

void addCalibrateColor(CLI::App& app, int&)
{
  auto o = std::make_shared<CalibrateColorOptions>();
  CLI::App* command = app.add_subcommand(
      "calibrate-color",
      "Propose the range of an object's colour, as a section for slamot detect.\n"
      "Example: slamot calibrate-color photo.jpg --box 84,44,139,136 --label target");
  command->add_option("image", o->image, "A picture of the object and what is around it")
      ->required()
      ->type_name("IMAGE");
  command->add_option("--box", o->box, "Where the object is: left,top,width,height [pixel]")
      ->required()
      ->delimiter(',')
      ->expected(4)
      ->type_name("U,V,W,H");
  command->add_option("--label", o->label, "What the colour stands for")->capture_default_str();
  command->callback([o] { calibrateColor(*o); });
}
}  // namespace slamot::apps
