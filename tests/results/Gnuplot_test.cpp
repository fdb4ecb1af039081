#include "../../libs/results/src/layout.h"
#include "TemporaryFolder.h"
#include "sampleRun.h"
#include "xml.h"

#include <gmock/gmock.h>
#include <slamot/core/Error.h>
#include <slamot/results/Gnuplot.h>

#include <filesystem>
#include <fstream>

namespace slamot::results
{
namespace
{
using test::TemporaryFolder;

/// A PATH for as long as it lives.
class PathVariable
{
 public:
  explicit PathVariable(const std::string& path)
  {
    if (const char* p = std::getenv("PATH")) before_ = p;
    ::setenv("PATH", path.c_str(), 1);
  }
  ~PathVariable() { ::setenv("PATH", before_.c_str(), 1); }
  PathVariable(const PathVariable&) = delete;
  PathVariable& operator=(const PathVariable&) = delete;

 private:
  std::string before_;
};

Figure lineFigure(const std::string& title)
{
  Plot plot;
  plot.title = title, plot.xLabel = "x [m]", plot.yLabel = "y [m]";
  plot.series = {{Series::Kind::kLine, title, Ink::kBlue, {0, 1, 2}, {0, 1, 0}, {}, {}}};
  return Figure{{plot}};
}

std::string messageOfDrawing()
{
  try
  {
    (void)drawFigure(lineFigure("a"), PictureFormat::kSvg);
  }
  catch (const core::Error& e)
  {
    return e.what();
  }
  return "";
}

TEST(Gnuplot, SameFigureGivesTheSameBytes)
{
  const SampleRun run = sampleRun();
  for (const PictureFormat format : {PictureFormat::kSvg, PictureFormat::kPng})
    EXPECT_EQ(drawFigure(mapFigure(run.view()), format), drawFigure(mapFigure(run.view()), format));
}

TEST(Gnuplot, DrawsWellFormedSvgOfEveryKindOfSeries)
{
  Plot plot = lineFigure("all").panels[0];
  const std::vector<double> x{1, 2, 3}, y{1, 3, 2}, low{0.5, 1, 1}, high{2, 4, 3};
  for (int kind = 0; kind <= static_cast<int>(Series::Kind::kTicks); ++kind)
    plot.series.push_back({static_cast<Series::Kind>(kind), "kind " + std::to_string(kind),
                           inkOf(static_cast<std::size_t>(kind)), x, y, low, high});
  Plot logarithmic = plot;
  logarithmic.logY = true;
  const std::string svg = drawFigure(Figure{{plot, logarithmic}}, PictureFormat::kSvg);
  const auto texts = test::xmlTexts(svg);
  for (int kind = 0; kind <= static_cast<int>(Series::Kind::kTicks); ++kind)
    EXPECT_EQ(std::count(texts.begin(), texts.end(), "kind " + std::to_string(kind)), 2) << kind;
  EXPECT_EQ(std::count(texts.begin(), texts.end(), "x [m]"), 1);
  EXPECT_EQ(std::count(texts.begin(), texts.end(), "y [m]"), 2);
}

TEST(Gnuplot, ShowsTextAsItIs)
{
  const std::string odd = "a_1 ^2 {/Bold b} \"c\" <i> & 100% 'q' \\n `date` $(date) σ";
  const auto texts = test::xmlTexts(drawFigure(lineFigure(odd), PictureFormat::kSvg));
  std::string shown = odd;
  for (char& c : shown)
    if (c == '`') c = ' ';
  EXPECT_EQ(std::count(texts.begin(), texts.end(), shown), 2) << ::testing::PrintToString(texts);
}

TEST(Gnuplot, DrawsEmptySeriesAndSinglePoints)
{
  Figure figure = lineFigure("empty");
  figure.panels[0].series = {{Series::Kind::kLine, "none", Ink::kBlue, {}, {}, {}, {}}};
  EXPECT_NO_THROW((void)test::xmlTexts(drawFigure(figure, PictureFormat::kSvg)));
  figure.panels[0].series = {{Series::Kind::kDots, "one", Ink::kBlue, {3}, {1e6}, {}, {}}};
  figure.panels[0].equalAxes = true;
  EXPECT_NO_THROW((void)test::xmlTexts(drawFigure(figure, PictureFormat::kSvg)));
}

TEST(Gnuplot, SavesByEndingAndLeavesNothingElse)
{
  const TemporaryFolder folder;
  saveFigure(folder.file("a.svg"), lineFigure("a"));
  saveFigure(folder.file("a.png"), lineFigure("a"));
  std::ifstream svg(folder.file("a.svg")), png(folder.file("a.png"));
  std::string start(5, ' '), signature(4, ' ');
  svg.read(start.data(), 5), png.read(signature.data(), 4);
  EXPECT_EQ(start, "<?xml");
  EXPECT_EQ(signature, "\x89PNG");
  using Files = std::filesystem::directory_iterator;
  EXPECT_EQ(std::distance(Files(folder.file("")), Files{}), 2);
}

TEST(Gnuplot, SaysWhenItIsAbsent)
{
  const TemporaryFolder empty;
  const PathVariable path(empty.file(""));
  EXPECT_THAT(messageOfDrawing(), ::testing::HasSubstr("install gnuplot-nox"));
}

TEST(Gnuplot, PassesOnWhatItSaysWhenItFails)
{
  const TemporaryFolder folder;
  const std::string fake =
      folder.write("gnuplot", "#!/bin/sh\necho first; echo 'no fonts' >&2; exit 3\n");
  std::filesystem::permissions(fake, std::filesystem::perms::owner_all);
  const PathVariable path(folder.file("") + ":/bin:/usr/bin");
  EXPECT_THAT(messageOfDrawing(), ::testing::HasSubstr("exit status 3: no fonts"));
}

/// How far down a text is written [px].
double depthOf(const std::string& svg, const std::string& text)
{
  const auto at = svg.find("<text>" + text + "<");
  EXPECT_NE(at, std::string::npos) << text;
  const auto place = svg.rfind("translate(", at);
  return std::stod(svg.substr(svg.find(',', place) + 1));
}

// The longest row of gnuplot's own legend decides how many columns it makes.
TEST(Gnuplot, LegendsOfAnyLengthEndAboveTheDrawing)
{
  for (const std::size_t letters : {4u, 12u, 22u, 40u})
    for (const int entries : {1, 3, 4, 7, 11})
    {
      Plot plot;
      plot.equalAxes = true;
      for (int i = 0; i < entries; ++i)
      {
        Series s{Series::Kind::kLine, "", Ink::kBlue, {0, 9}, {0, 1.0 * i}, {}, {}};
        s.title = "s" + std::to_string(i);
        s.title.resize(letters, '.');
        plot.series.push_back(s);
      }
      for (const int width : {420, 860})
      {
        Figure figure{{plot}};
        figure.width = width;
        const std::string svg = drawFigure(figure, PictureFormat::kSvg);
        const int top = layOut(figure).panels[0].top;
        for (const Series& s : plot.series)
          EXPECT_LT(depthOf(svg, s.title) + 4, top) << letters << " x " << entries << ", " << width;
      }
    }
}
}  // namespace
}  // namespace slamot::results
