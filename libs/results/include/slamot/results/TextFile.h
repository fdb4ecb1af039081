#pragma once

#include <slamot/core/Error.h>

#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace slamot::results
{
/// Reads a text file of numbers line by line, strictly; its errors name the file and the line.
class LineReader
{
 public:
  /// \throws core::Error (kUnreadable) if the file can't be opened.
  explicit LineReader(const std::string& path);
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  /// Goes to the next line; false at the end.  A trailing carriage return is taken off.
  /// \throws core::Error (kUnreadable; kLimit on a line of over 4000 characters).
  bool next();
  /// The line as it is, valid until next().
  [[nodiscard]] std::string_view text() const { return text_; }

  /// The line's parts between commas.
  [[nodiscard]] std::vector<std::string_view> commaSeparated() const;
  /// The line's parts between runs of blanks and tabs.
  [[nodiscard]] std::vector<std::string_view> blankSeparated() const;

  /// A part as a finite number, whatever the locale; `name` stands for it in the message.
  /// \throws core::Error, as fail().
  [[nodiscard]] double number(std::string_view part, const char* name) const;
  /// As number(), without a fraction.
  [[nodiscard]] int wholeNumber(std::string_view part, const char* name) const;

  /// \throws core::Error: kNonsense, or kTruncated if the file ends within this line.
  [[noreturn]] void fail(const std::string& what, const std::string& mend) const;

 private:
  std::string path_;
  std::ifstream file_;
  std::string_view text_;
  std::size_t number_ = 0;
  bool ended_ = true;  ///< the line has its end mark
  char buffer_[4002] = {};
};

/// Appends a number with so many decimals, `.` before them whatever the locale; no "-0.000".
void appendFixed(std::string& text, double value, int decimals);

/// Writes a file whole or not at all: to a temporary beside it, then renamed.
/// \throws core::Error (kUnreadable) if that fails.
void writeWhole(const std::string& path, const std::string& text);
}  // namespace slamot::results
