#include "pictures.h"

#include <slamot/results/Figures.h>
#include <slamot/results/Gnuplot.h>
#include <slamot/results/TextFile.h>
#include <slamot/study/Trial.h>
#include <slamot/team/teamReport.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace slamot::reproduce
{
namespace
{
namespace fs = std::filesystem;
using results::Figure;

constexpr int kMapWidth = 680;  // [px]: as high as wide, a map would else fill a page

struct Titled
{
  std::string title;
  Figure figure;
};

/// Where the scans lie by the estimate, and by odometry.
std::vector<Titled> scanFigures(const results::RunView& run)
{
  std::vector<Titled> out;
  if (auto f = results::scanFigure(run, eval::PosesOf::kFilter))
    out.push_back({"by the estimated path", *f});
  if (auto f = results::scanFigure(run, eval::PosesOf::kOdometry))
    out.push_back({"by odometry alone", *f});
  return out;
}

std::optional<Figure> figureOf(Picture::Kind kind, const results::RunView& run)
{
  switch (kind)
  {
    case Picture::Kind::kMap:
      return results::mapFigure(run);
    case Picture::Kind::kRobotErrors:
      return results::robotErrorFigure(run);
    case Picture::Kind::kNees:
      return results::neesFigure(run);
    case Picture::Kind::kTargetErrors:
    case Picture::Kind::kScans:
      break;
  }
  const auto groups = results::targetGroups(run.record, run.evaluation);
  if (groups.empty()) return std::nullopt;
  return results::targetErrorFigure(run, groups.front(), results::inkOf(0));
}

std::optional<Figure> figureOf(Picture::Kind kind, const team::TeamView& team)
{
  switch (kind)
  {
    case Picture::Kind::kMap:
      return team::teamMapFigure(team);
    case Picture::Kind::kRobotErrors:
      return team::robotErrorsFigure(team);
    case Picture::Kind::kTargetErrors:
      return team::targetErrorsFigure(team);
    case Picture::Kind::kNees:
      return team::teamNeesFigure(team);
    case Picture::Kind::kScans:
      break;
  }
  return std::nullopt;
}

std::vector<Titled> figuresOf(Picture::Kind kind, const study::Trial& trial,
                              const study::FinishedTrial& done)
{
  std::vector<team::RobotResult> robots;
  for (std::size_t r = 0; r < done.records.size(); ++r)
    robots.push_back(
        {"robot " + std::to_string(r), {done.records[r], *done.truths[r], done.evaluations[r]}});
  if (!trial.team && kind == Picture::Kind::kScans) return scanFigures(robots[0].view);
  const auto figure = trial.team ? figureOf(kind, team::viewOf(*trial.team, robots))
                                 : figureOf(kind, robots[0].view);
  if (!figure) return {};
  Titled out{"", *figure};
  if (kind == Picture::Kind::kMap) out.figure.width = kMapWidth;
  return {out};
}

/// The place of the first cell with the picture's values; none if a quick study left them out.
std::optional<std::size_t> cellOf(const Picture& picture, const study::Plan& plan)
{
  const auto& axes = plan.spec.axes;
  for (std::size_t c = 0; c < plan.cells.size(); ++c)
  {
    bool isIt = true;
    for (std::size_t a = 0; a < axes.size(); ++a)
    {
      const auto it = picture.cell.find(axes[a].name);
      isIt = isIt &&
             (it == picture.cell.end() || it->second == axes[a].values[plan.cells[c].values[a]]);
    }
    if (isIt) return c;
  }
  return std::nullopt;
}

std::optional<std::size_t> methodOf(const Picture& picture, const study::Plan& plan)
{
  for (std::size_t m = 0; m < plan.spec.methods.size(); ++m)
    if (plan.spec.methods[m].name == picture.method) return m;
  return std::nullopt;
}

std::string readText(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Images of one picture: <stem>.<title>.svg, beside an index that is written last.
void keep(const fs::path& stem, const Drawn& drawn)
{
  fs::create_directories(stem.parent_path());
  std::string index;
  for (std::size_t i = 0; i < drawn.titlesAndImages.size(); ++i)
  {
    results::writeWhole(stem.string() + "." + std::to_string(i + 1) + ".svg",
                        drawn.titlesAndImages[i].second);
    index += drawn.titlesAndImages[i].first + "\n";
  }
  results::writeWhole(stem.string() + ".txt", index);
}

std::optional<Drawn> kept(const fs::path& stem)
{
  std::ifstream index(stem.string() + ".txt");
  if (!index) return std::nullopt;
  Drawn out;
  for (std::string title; std::getline(index, title);)
  {
    const std::string number = std::to_string(out.titlesAndImages.size() + 1);
    std::string image = readText(stem.string() + "." + number + ".svg");
    if (image.find("</svg>") == std::string::npos) return std::nullopt;
    out.titlesAndImages.emplace_back(title, std::move(image));
  }
  return out;
}

Drawn made(const Picture& picture, const study::Plan& plan, std::size_t cell, std::size_t method)
{
  study::Trial trial =
      study::openTrial(plan.spec, plan.cells[cell], plan.spec.methods[method], picture.seed);
  const auto done = study::finish(trial, picture.kind == Picture::Kind::kScans);
  Drawn out;
  for (const Titled& t : figuresOf(picture.kind, trial, done))
    out.titlesAndImages.emplace_back(t.title,
                                     results::drawFigure(t.figure, results::PictureFormat::kSvg));
  if (out.titlesAndImages.empty()) out.missing = "its run has nothing of the kind";
  return out;
}
}  // namespace

Drawn drawn(const Picture& picture, const study::Plan& plan, const std::string& studyFolder)
{
  const auto cell = cellOf(picture, plan), method = methodOf(picture, plan);
  if (!cell || !method) return {{}, "left out of the quick reproduction"};
  const std::string hash = plan.groups[plan.groupOf[*cell][*method]].hash;
  const fs::path stem = fs::path(studyFolder) / "pictures" /
                        (picture.name + "-" + std::to_string(static_cast<int>(picture.kind)) +
                         "-seed" + std::to_string(picture.seed) + "-" + hash);
  if (auto known = kept(stem)) return *known;
  try
  {
    Drawn out = made(picture, plan, *cell, *method);
    if (out.missing.empty()) keep(stem, out);
    return out;
  }
  catch (const std::exception& e)
  {
    return {{}, e.what()};
  }
}
}  // namespace slamot::reproduce
