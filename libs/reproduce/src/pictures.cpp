#include "pictures.h"

#include <slamot/results/Gnuplot.h>
#include <slamot/results/TextFile.h>
#include <slamot/study/Trial.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "runFigures.h"

namespace slamot::reproduce
{
namespace
{
namespace fs = std::filesystem;

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
  for (const TitledFigure& t : runFigures(picture.kind, trial, done))
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
