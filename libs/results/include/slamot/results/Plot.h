#pragma once

#include <slamot/math/gaussian.h>

#include <optional>
#include <string>
#include <vector>

namespace slamot::results
{
/// The palette: told apart by the colour-blind (Okabe and Ito 2008), and readable on light and
/// dark.
enum class Ink
{
  kText,        ///< truth and other references
  kMuted,       ///< what stays in the background
  kBlue,        ///< the robot
  kGreen,       ///< landmarks
  kVermillion,  ///< the first target
  kPurple,      ///< the second target
  kOrange,      ///< the third
  kSky          ///< the fourth
};

/// Colours for the n-th target, curve, ...; they repeat after the last.
[[nodiscard]] Ink inkOf(std::size_t n);

/// One curve, band or set of marks.  A NaN in x or y interrupts a line.
struct Series
{
  /// How the numbers are drawn.
  enum class Kind
  {
    kLine,       ///< through the points, in their order
    kThin,       ///< a line that stays behind the others
    kDashes,     ///< a broken line
    kDots,       ///< small filled circles
    kPoints,     ///< the smallest marks, of clouds
    kCrosses,    ///< upright crosses
    kErrorBars,  ///< line, points and bars from low to high
    kBand,       ///< the area between low and high
    kShape,      ///< closed outlines, lightly filled; NaN between them
    kSolid,      ///< closed outlines, filled
    kTicks       ///< short strokes at the foot of the panel, at x
  };
  Kind kind = Kind::kLine;   ///< which of these
  std::string title;         ///< for the legend; empty: not in it
  Ink ink = Ink::kBlue;      ///< its colour
  std::vector<double> x;     ///< in the axis's unit
  std::vector<double> y;     ///< as many as x
  std::vector<double> low;   ///< of bands and error bars only: their lower ends
  std::vector<double> high;  ///< of bands and error bars only: their upper ends
};

/// From where to where an axis goes.
struct Range
{
  double min = 0;  ///< in the axis's unit
  double max = 1;  ///< in the axis's unit
};

/// Axes with what is drawn in them, in the order given.
struct Plot
{
  std::string title;            ///< above the axes; empty: none
  std::string xLabel;           ///< with its unit
  std::string yLabel;           ///< with its unit
  bool equalAxes = false;       ///< a map: one metre is as long upwards as sideways
  bool logX = false;            ///< logarithmic axis
  bool logY = false;            ///< logarithmic axis
  std::optional<Range> xRange;  ///< absent: what is drawn, and a little room
  std::optional<Range> yRange;  ///< absent: what is drawn, and a little room
  std::vector<Series> series;   ///< what comes later lies above
};

/// Panels from top to bottom with one x axis: all take the first one's range of x.
struct Figure
{
  std::vector<Plot> panels;  ///< from the top
  int width = 860;           ///< [px]
  int panelHeight = 260;     ///< [px], of the drawing area; maps follow their contents
};

/// Appends the outline of the ellipse that holds this share of a Gaussian's mass.
void appendEllipse(Series& shapes, const Gaussian<Point2D>& g, double probability = 0.95);

/// Appends an arrow head at a pose, of this length [m].
void appendArrow(Series& shapes, const Pose2D& pose, double length);
}  // namespace slamot::results
