#include <slamot/results/Gnuplot.h>

#include "layout.h"
#include "palette.h"
#include "thin.h"

#include <charconv>
#include <cmath>
#include <set>

namespace slamot::results
{
namespace
{
/// A number as gnuplot reads it in any locale.
std::string num(double v)
{
  if (!std::isfinite(v)) return "NaN";
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, v, std::chars_format::general, 10).ptr;
  return {text, end};
}

/// Text within gnuplot's double quotes, without escapes or commands.
std::string quoted(const std::string& text)
{
  std::string out = "\"";
  for (const char c : text)
  {
    if (c == '"' || c == '\\') out += '\\';
    out += c == '\n' || c == '\r' || c == '`' ? ' ' : c;
  }
  return out + '"';
}

std::string rgb(const Colour& c, const char* alpha = "")
{
  return "rgb \"#" + (alpha + std::string(c.light)) + '"';
}

const std::string kTextColour = " textcolor " + rgb(kPalette[0]);

/// How a kind of series is drawn: `using` and what follows it, up to the title.
std::string styleOf(const Series& s)
{
  const std::string colour = " lc " + rgb(colourOf(s.ink));
  switch (s.kind)
  {
    case Series::Kind::kLine:
      return "using 1:2 with lines lw 2" + colour;
    case Series::Kind::kThin:
      return "using 1:2 with lines lw 1.1" + colour;
    case Series::Kind::kDashes:
      return "using 1:2 with lines lw 1.3 dt (5,3)" + colour;
    case Series::Kind::kDots:
      return "using 1:2 with points pt 7 ps 0.45" + colour;
    case Series::Kind::kPoints:
      return "using 1:2 with points pt 7 ps 0.12" + colour;
    case Series::Kind::kCrosses:
      return "using 1:2 with points pt 1 ps 0.8 lw 1.5" + colour;
    case Series::Kind::kErrorBars:
      return "using 1:2:3:4 with yerrorlines pt 7 ps 0.6 lw 1.6" + colour;
    case Series::Kind::kBand:
      return "using 1:2:3 with filledcurves fs transparent solid 0.25 noborder" + colour;
    case Series::Kind::kShape:
      return "using 1:2 with filledcurves closed fs transparent solid 0.25 border" + colour +
             " fillcolor " + rgb(colourOf(s.ink));
    case Series::Kind::kSolid:
      return "using 1:2 with filledcurves closed fs solid 1.0 noborder" + colour;
    case Series::Kind::kTicks:
      return "using 1:2 with lines lw 1" + colour;
  }
  return {};
}

/// The rows of a series' data block.
std::string rowsOf(const Series& s, const PanelLayout& panel, bool logY)
{
  std::string rows;
  const auto row = [&](std::initializer_list<double> values)
  {
    for (const double v : values) rows += num(v) + ' ';
    rows += '\n';
  };
  const double foot = logY ? panel.y.min * std::pow(panel.y.max / panel.y.min, 0.06)
                           : panel.y.min + 0.06 * (panel.y.max - panel.y.min);
  const bool outlines = s.kind == Series::Kind::kShape || s.kind == Series::Kind::kSolid;
  for (std::size_t i = 0; i < s.x.size(); ++i)
  {
    if (s.kind == Series::Kind::kBand)
      row({s.x[i], s.low[i], s.high[i]});
    else if (s.kind == Series::Kind::kErrorBars)
      row({s.x[i], s.y[i], s.low[i], s.high[i]});
    else if (s.kind == Series::Kind::kTicks)
      row({s.x[i], panel.y.min}), row({s.x[i], foot}), rows += '\n';
    else if (outlines && !std::isfinite(s.x[i]))
      rows += '\n';
    else
      row({s.x[i], s.y[i]});
  }
  return rows;
}

std::string head(const Layout& layout, PictureFormat format)
{
  const std::string size = std::to_string(layout.width) + "," + std::to_string(layout.height);
  const bool png = format == PictureFormat::kPng;
  const std::string terminal =
      png ? "pngcairo size " + std::to_string(2 * layout.width) + "," +
                std::to_string(2 * layout.height) +
                " fontscale 1.5 linewidth 2 pointscale 2 dashlength 2 background \"#ffffff\""
          : "svg size " + size + " dynamic dashlength 1 background \"#ffffff\"";
  return "set encoding utf8\nset terminal " + terminal + " font \"sans-serif,13\" noenhanced\n" +
         "set multiplot\nset border 3 lw 1 lc " + rgb(kAxis) + "\nset tics nomirror out scale 0.5" +
         kTextColour + "\nset grid back lt 1 lw 1 dt solid lc " + rgb(kGrid) + "\n";
}

/// Pixels from the left and the top as gnuplot's screen coordinates.
struct Screen
{
  const Layout& layout;

  [[nodiscard]] std::string x(int px) const
  {
    return "screen " + num(static_cast<double>(px) / layout.width);
  }
  [[nodiscard]] std::string y(int px) const
  {
    return "screen " + num(static_cast<double>(layout.height - px) / layout.height);
  }
  [[nodiscard]] std::string label(const std::string& text, int px, int py, const char* how) const
  {
    if (text.empty()) return {};
    return "set label " + quoted(text) + " at " + x(px) + "," + y(py) + ' ' + how + kTextColour +
           "\n";
  }
};

/// On a logarithmic axis with few places, such as a study's grid, those are what to mark.
std::string ticsAtData(const Plot& plot)
{
  std::set<double> places;
  for (const Series& s : plot.series) places.insert(s.x.begin(), s.x.end());
  if (places.empty() || places.size() > 10) return "autofreq";
  std::string tics;
  for (const double x : places) tics += (tics.empty() ? "(" : ", ") + num(x);
  return tics + ")";
}

/// Where everything goes.  Axis labels are placed by hand: gnuplot leaves out those that it thinks
/// do not fit.
std::string axes(const Plot& plot, const PanelLayout& p, const Layout& layout)
{
  const Screen screen{layout};
  std::string s = "set lmargin at " + screen.x(p.left) + "\nset rmargin at " + screen.x(p.right) +
                  "\nset tmargin at " + screen.y(p.top) + "\nset bmargin at " + screen.y(p.bottom);
  s += "\nset xrange [" + num(p.x.min) + ":" + num(p.x.max) + "]\nset yrange [" + num(p.y.min) +
       ":" + num(p.y.max) + "]\nunset label\n";
  s += plot.logX ? "set logscale x\nset xtics " + ticsAtData(plot) + "\n"
                 : "unset logscale x\nset xtics autofreq\n";
  s += plot.logY ? "set logscale y\n" : "unset logscale y\n";
  s += p.showXAxis ? "set format x \"%h\"\n" : "set format x \"\"\n";
  s += "set format y \"%h\"\n";
  if (p.showXAxis) s += screen.label(plot.xLabel, (p.left + p.right) / 2, p.bottom + 40, "center");
  s += screen.label(plot.yLabel, 16, (p.top + p.bottom) / 2, "center rotate by 90");
  s += screen.label(plot.title, p.left, p.legendTop - 12, "left font \"sans-serif,15\"");
  return s + "set key at " + screen.x(p.left) + "," + screen.y(p.legendTop) +
         " left top horizontal Left reverse samplen 2 spacing 1.2 width 1 maxcols " +
         std::to_string(p.legendColumns) + kTextColour + "\n";
}

PixelScale scaleOf(const Plot& plot, const PanelLayout& p)
{
  PixelScale s;
  s.logX = plot.logX, s.logY = plot.logY;
  const auto mapped = [](double v, bool logarithmic) { return logarithmic ? std::log10(v) : v; };
  s.x0 = mapped(p.x.min, plot.logX), s.y0 = mapped(p.y.min, plot.logY);
  s.perX = (p.right - p.left) / (mapped(p.x.max, plot.logX) - s.x0);
  s.perY = (p.bottom - p.top) / (mapped(p.y.max, plot.logY) - s.y0);
  return s;
}

std::string panelScript(const Plot& plot, const PanelLayout& panel, const Layout& layout)
{
  const PixelScale scale = scaleOf(plot, panel);
  std::string blocks, commands;
  int n = 0;
  for (const Series& s : plot.series)
  {
    if (s.x.empty()) continue;
    const std::string name = "$d" + std::to_string(n++);
    blocks += name + " << EOD\n" + rowsOf(thinned(s, scale), panel, plot.logY) + "EOD\n";
    commands += (commands.empty() ? "plot " : ", \\\n     ") + name + ' ' + styleOf(s) +
                (s.title.empty() ? " notitle" : " title " + quoted(s.title));
  }
  if (commands.empty()) commands = "plot NaN notitle";
  return blocks + axes(plot, panel, layout) + commands + "\n";
}
}  // namespace

std::string gnuplotScript(const Figure& figure, PictureFormat format)
{
  const Layout layout = layOut(figure);
  std::string script = head(layout, format);
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    script += panelScript(figure.panels[i], layout.panels[i], layout);
  return script + "unset multiplot\n";
}
}  // namespace slamot::results
