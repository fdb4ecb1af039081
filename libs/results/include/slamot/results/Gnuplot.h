#pragma once

#include <slamot/results/Plot.h>

namespace slamot::results
{
/// What gnuplot draws to.
enum class PictureFormat
{
  kSvg,  ///< text; see inlineSvg()
  kPng   ///< at twice the figure's size
};

/// The gnuplot commands, data included, that draw a figure.  Data is thinned to what the picture's
/// resolution can show.
[[nodiscard]] std::string gnuplotScript(const Figure& figure, PictureFormat format);

/// The picture's bytes, drawn by the program `gnuplot`: the same figure gives the same bytes.
/// \throws core::Error (kInternal) if gnuplot is absent or fails, with what it said.
[[nodiscard]] std::string drawFigure(const Figure& figure, PictureFormat format);

/// Draws to a file, SVG or PNG by its ending; whole or not at all.
/// \throws core::Error as drawFigure(); kUnreadable if the file can't be written.
void saveFigure(const std::string& path, const Figure& figure);

/// A gnuplot SVG, made fit for an HTML page that holds many: no header, transparent, ids prefixed,
/// colours as the page's variables (see inkVariables()), nothing empty.
[[nodiscard]] std::string inlineSvg(const std::string& svg, const std::string& prefix);

/// CSS declarations `--ink-text:#24292f;...` of the colours that inlineSvg() names.
[[nodiscard]] std::string inkVariables(bool dark);
}  // namespace slamot::results
