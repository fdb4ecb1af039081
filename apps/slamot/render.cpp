#include <slamot/core/Error.h>
#include <slamot/mrpt/Scene.h>

#include <filesystem>

#include "Command.h"

namespace slamot::apps
{
namespace
{
struct RenderCommand
{
  std::string result, output;
  mrpt::RenderOptions options;
};

/// The scene of a result folder, or the scene itself.
std::string sceneIn(const std::string& result)
{
  const std::filesystem::path path(result);
  return std::filesystem::is_directory(path) ? (path / "scene.3Dscene").string() : result;
}

void render(const RenderCommand& o)
{
  if (std::filesystem::path(o.output).extension() != ".png")
    throw core::Error(core::ExitStatus::kConfig, "command line --output " + o.output,
                      "not a picture's name", "end it in .png");
  mrpt::renderScene(sceneIn(o.result), o.output, o.options);
}
}  // namespace

void addRender(CLI::App& app, int&)
{
  auto o = std::make_shared<RenderCommand>();
  CLI::App* command = app.add_subcommand(
      "render",
      "Draw a result's scene to a picture; needs no display.\n"
      "Example: slamot render slamot-out/rbpf-slamot-experiment1 -o experiment1.png");
  command->add_option("result", o->result, "A result folder, or a .3Dscene file")
      ->required()
      ->type_name("RESULT");
  command->add_option("-o,--output", o->output, "The picture")->required()->type_name("FILE.png");
  command->add_flag("--from-above", o->options.fromAbove, "As a map, without perspective");
  command->add_option("--width", o->options.width, "Width [px]")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  command->add_option("--height", o->options.height, "Height [px]")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  command->callback([o] { render(*o); });
}
}  // namespace slamot::apps
