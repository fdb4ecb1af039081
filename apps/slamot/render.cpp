#include <slamot/core/Error.h>
#include <slamot/mrpt/Scene.h>
#include <slamot/team/savedTeam.h>

#include <cstdio>
#include <filesystem>

#include "Command.h"
#include "TeamStory.h"
#include "film.h"

namespace slamot::apps
{
namespace
{
namespace fs = std::filesystem;
using core::Error;
using core::ExitStatus;

struct RenderCommand
{
  std::string result, output, truth;
  std::optional<double> time;
  mrpt::RenderOptions look;
  FilmOptions film;
  bool filmOptionsGiven = false;
};

[[noreturn]] void refuse(const std::string& option, const std::string& what,
                         const std::string& mend)
{
  throw Error(ExitStatus::kConfig, "command line " + option, what, mend);
}

/// A result read back, of a robot or a team, and its story.
class Tale
{
 public:
  explicit Tale(const RenderCommand& o)
  {
    if (!fs::is_directory(o.result) || team::robotsIn(o.result).empty())
    {
      run_ = loadSavedRun(o.result, o.truth);
      story_ = std::make_unique<RobotStory>(run_);
      return;
    }
    if (!o.truth.empty()) refuse("--truth", "is of one robot, and this is a team", "leave it out");
    if (o.look.view == mrpt::View::kFollow)
      refuse("--view follow", "is of one robot, and this is a team",
             "give a robot's folder, or leave it out");
    team_ = loadSavedTeam(o.result);
    story_ = std::make_unique<TeamStory>(team_);
  }
  Tale(const Tale&) = delete;
  Tale& operator=(const Tale&) = delete;

  [[nodiscard]] const Story& story() const { return *story_; }

 private:
  SavedRun run_;
  SavedTeam team_;
  std::unique_ptr<Story> story_;
};

void renderMoment(const RenderCommand& o)
{
  const Tale tale(o);
  const Story& story = tale.story();
  const double time = o.time.value_or(story.duration());
  if (time > story.duration())
  {
    char end[64];
    std::snprintf(end, sizeof end, "is after the run's end, %.3f s", story.duration());
    refuse("--time", end, "choose an earlier moment");
  }
  mrpt::Renderer renderer(story.whole(), o.look);
  mrpt::savePng(o.output, renderer.draw(story.at(story.rowAt(time))));
}

/// The result's scene as it was saved, or that file itself; else its end, from what is there.
void renderPicture(const RenderCommand& o)
{
  if (o.filmOptionsGiven) refuse("--fps", "and --speed are of videos", "end --output in .mp4");
  const bool isFolder = fs::is_directory(o.result);
  const fs::path saved = isFolder ? fs::path(o.result) / "scene.3Dscene" : fs::path(o.result);
  const bool hasScene = !isFolder || fs::exists(saved);
  if (o.time || o.look.view == mrpt::View::kFollow || !hasScene)
    renderMoment(o);
  else
    mrpt::renderScene(saved.string(), o.output, o.look);
}

int render(const RenderCommand& o)
{
  const std::string kind = fs::path(o.output).extension().string();
  if (kind != ".png" && kind != ".mp4")
    refuse("--output " + o.output, "is the name of neither a picture nor a video",
           "end it in .png or .mp4");
  if (o.look.fromAbove && o.look.view == mrpt::View::kFollow)
    refuse("--from-above", "is of --view plan", "leave one of them out");
  if (kind == ".png") return renderPicture(o), 0;
  if (o.time) refuse("--time", "is of pictures", "end --output in .png");
  const Tale tale(o);
  const bool whole = writeFilm(o.output, tale.story(), o.look, o.film);
  return static_cast<int>(whole ? ExitStatus::kDone : ExitStatus::kInterrupted);
}

void addLook(CLI::App& command, RenderCommand& o)
{
  static const std::map<std::string, mrpt::View> kViews = {{"plan", mrpt::View::kPlan},
                                                           {"follow", mrpt::View::kFollow}};
  command
      .add_option_function<std::string>(
          "--view", [&o](const std::string& name) { o.look.view = kViews.at(name); },
          "The whole map, or from behind the robot (default plan)")
      ->check(CLI::IsMember({"plan", "follow"}))
      ->type_name("plan|follow");
  command.add_flag("--from-above", o.look.fromAbove, "A plan as a map, without perspective");
  command.add_option("--width", o.look.width, "Width [px]")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  command.add_option("--height", o.look.height, "Height [px]")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
}

void addMoments(CLI::App& command, RenderCommand& o)
{
  command
      .add_option("--time", o.time, "Picture: of this moment [s from the start], not of the end")
      ->check(CLI::NonNegativeNumber)
      ->type_name("T");
  command
      .add_option_function<double>(
          "--fps", [&o](double v) { o.film.fps = v, o.filmOptionsGiven = true; },
          "Video: frames a second (default 25)")
      ->check(CLI::Range(1.0, 120.0))
      ->type_name("N");
  command
      .add_option_function<double>(
          "--speed", [&o](double v) { o.film.speed = v, o.filmOptionsGiven = true; },
          "Video: seconds of the run in one of the video (default 1, or more to make it 30 s)")
      ->check(CLI::PositiveNumber)
      ->type_name("X");
  command
      .add_option("--truth", o.truth,
                  "X.truth or X.rawlog, for errors and true paths (default: of the log that the "
                  "result is of)")
      ->type_name("PREFIX");
}
}  // namespace

void addRender(CLI::App& app, int& status)
{
  auto o = std::make_shared<RenderCommand>();
  CLI::App* command = app.add_subcommand(
      "render",
      "Draw a result, of a robot or a team, to a picture, or its run to a video; needs no "
      "display.\n"
      "Landmarks appear when first seen, where they are at the end; particles at the end only.\n"
      "Example: slamot render slamot-out/rbpf-slamot-experiment1 -o experiment1.mp4 --view follow");
  command
      ->add_option("result", o->result,
                   "A result folder, also a team's; for a picture also a .3Dscene file")
      ->required()
      ->type_name("RESULT");
  command->add_option("-o,--output", o->output, "The picture or video")
      ->required()
      ->type_name("FILE.png|FILE.mp4");
  addLook(*command, *o);
  addMoments(*command, *o);
  command->callback([o, &status] { status = render(*o); });
}
}  // namespace slamot::apps
