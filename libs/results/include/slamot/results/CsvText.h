#pragma once

#include <slamot/core/Error.h>
#include <slamot/math/gaussian.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

namespace slamot::results
{
/// Text of comma-separated rows.  Numbers are the shortest that read back the same.
class CsvText
{
 public:
  /// Begins with a line of the columns' names.
  explicit CsvText(const std::string& header) : text_(header + "\n") {}

  /// A number. \throws core::Error (kInternal) if it is not finite.
  CsvText& add(double v)
  {
    if (!std::isfinite(v))
      throw core::Error(core::ExitStatus::kInternal, "result", "a value is not finite",
                        "please report it");
    char digits[40];
    return raw({digits, std::to_chars(digits, digits + sizeof digits, v + 0.0).ptr});  // no "-0"
  }
  /// A whole number.
  CsvText& add(int v) { return raw(std::to_string(v)); }
  /// Nine fields: x, y, phi, then the covariance's upper triangle by rows.
  CsvText& add(const Gaussian<Pose2D>& g)
  {
    add(g.mean.x).add(g.mean.y).add(g.mean.phi);
    return add(g.cov(0, 0))
        .add(g.cov(0, 1))
        .add(g.cov(0, 2))
        .add(g.cov(1, 1))
        .add(g.cov(1, 2))
        .add(g.cov(2, 2));
  }
  /// A text, bare: what would end the field or the line becomes `_`.
  CsvText& add(std::string v)
  {
    std::replace_if(
        v.begin(), v.end(), [](unsigned char c) { return c < ' ' || c == ',' || c == '"'; }, '_');
    return raw(v);
  }
  /// An empty field: not known.
  CsvText& nothing() { return raw(""); }
  /// Ends the row; the next add() begins another one.
  void endRow() { text_.back() = '\n'; }
  /// All so far.
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  CsvText& raw(const std::string& part)
  {
    text_ += part;
    text_ += ',';
    return *this;
  }
  std::string text_;
};
}  // namespace slamot::results
