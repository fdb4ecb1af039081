#pragma once

#include <slamot/core/Error.h>
#include <slamot/importers/LineReader.h>

#include <initializer_list>

namespace slamot::importers
{
/// The rows of a table of numbers and words in a text file.  Every reader throws core::Error with
/// file, line and column: kUnreadable for what is no number or a row of the wrong length,
/// kNonsense for a value that makes no sense (not finite, too large, negative where it can't be).
/// Numbers have `.` decimals, whatever the locale.
class TextTable
{
 public:
  using Names = std::vector<std::string>;   ///< of columns
  static constexpr double kLargest = 1e10;  ///< of any number

  /// Comma separated, with one header line, read here.  Blanks around a field don't count.
  static TextTable csv(const std::string& path);
  /// Separated by blanks or tabs; lines that start with `#` are comments.
  static TextTable blanks(const std::string& path, Names names);
  /// The same with rows of any length, whose fields have numbers in place of names; blank lines may
  /// come anywhere.
  static TextTable words(const std::string& path);

  /// Which of the headers the file has.  \throws core::Error (kUnreadable) if it has none of them.
  std::size_t matchHeader(const std::vector<Names>& headers) const;
  /// Names of the columns, as the file or the caller gave them.
  [[nodiscard]] const Names& header() const { return names_; }

  /// Goes to the next row; false at the end.  A blank line may only come at the end.
  bool next();

  /// Fields of this row.
  [[nodiscard]] std::size_t columns() const { return fields_.size(); }
  /// A field of this row, blanks around it left out; valid until next().
  [[nodiscard]] std::string_view text(std::size_t column) const { return fields_[column]; }
  /// Whether there is nothing in the field.
  [[nodiscard]] bool empty(std::size_t column) const { return fields_[column].empty(); }
  /// Whether all columns from this one on are empty.
  [[nodiscard]] bool emptyFrom(std::size_t column) const;

  /// Finite, and kLargest at the most in size.
  [[nodiscard]] double number(std::size_t column) const;
  /// As number(), 0 or above.
  [[nodiscard]] double nonNegative(std::size_t column) const;
  /// As number(), above 0.
  [[nodiscard]] double positive(std::size_t column) const;
  /// A whole number, `lowest` or above.
  [[nodiscard]] int integer(std::size_t column, int lowest) const;
  /// None if the field is empty.
  [[nodiscard]] std::optional<double> optionalNumber(std::size_t column) const;

  /// Throws about this row.
  [[noreturn]] void fail(core::ExitStatus status, const std::string& what,
                         const std::string& mend) const;
  /// Throws about one field of this row.
  [[noreturn]] void failAt(std::size_t column, core::ExitStatus status, const std::string& what,
                           const std::string& mend) const;
  /// Share of the file already read, 0 to 1.
  [[nodiscard]] double progress() const { return lines_.progress(); }

 private:
  TextTable(const std::string& path, char separator) : lines_(path), separator_(separator) {}
  void split(std::string_view line);
  bool skipBlankEnd();
  [[nodiscard]] bool skips(std::string_view line) const;

  LineReader lines_;
  char separator_;
  bool anyLength_ = false;
  Names names_;
  std::vector<std::string_view> fields_;
};

/// The text as one line of printable characters, cut to a length that fits into a message.
[[nodiscard]] std::string quoted(std::string_view text);
}  // namespace slamot::importers
