#pragma once

#include <slamot/results/Plot.h>

#include <string>
#include <utility>
#include <vector>

namespace slamot::results
{
/// A table's cells as text; the first column names the rows.
struct Table
{
  std::vector<std::string> header;             ///< names of the columns
  std::vector<std::vector<std::string>> rows;  ///< each as long as the header
};

/// A text as HTML shows it literally.
[[nodiscard]] std::string escapedHtml(const std::string& text);

/// A page that needs nothing but itself: pictures and style inline, nothing fetched; for light and
/// dark screens and for paper.  All text is taken literally, but for that of markup().
class HtmlPage
{
 public:
  /// The subtitle stands below the title, in smaller print.
  HtmlPage(const std::string& title, const std::string& subtitle);

  void banner(const std::string& text);  ///< what no reader may overlook
  /// Of a chapter; `id` is what links to it say after `#`, empty: nothing links.
  void heading(const std::string& text, const std::string& id = {});
  /// Of a part of a chapter; `id` as for heading().
  void subheading(const std::string& text, const std::string& id = {});
  /// Text that runs on.
  void paragraph(const std::string& text);
  /// Numbers to the right; the table scrolls by itself where the page is narrow.
  void table(const Table& table);
  /// A list of links to files beside the page, by their paths from there.
  void links(const std::vector<std::pair<std::string, std::string>>& textsAndPaths);
  /// Text in a box, in fixed width, its line breaks kept.
  void preformatted(const std::string& text);
  /// A plot with a caption.  Where gnuplot fails the page says so in its place, and goes on.
  void figure(const std::string& caption, const Figure& figure);
  /// The same of a picture as drawFigure() has drawn it.
  void svg(const std::string& caption, const std::string& picture);
  /// Plots with their captions, side by side as far as the page is wide enough.
  void figuresInRow(const std::vector<std::pair<std::string, Figure>>& captionsAndFigures);

  /// What there is no word for here: HTML that has its text escaped, and style sheets for it.
  void markup(const std::string& html) { body_ += html; }
  /// Adds CSS rules to the page's own.
  void style(const std::string& css) { style_ += css; }

  /// The whole page.
  [[nodiscard]] std::string html() const;
  /// Why plots are missing; empty if none is.
  [[nodiscard]] const std::string& missingPlots() const { return missingPlots_; }

 private:
  std::string title_, subtitle_, style_, body_, missingPlots_;
  int figures_ = 0;
};
}  // namespace slamot::results
