#include <slamot/importers/TextTable.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>

namespace slamot::importers
{
namespace
{
using core::ExitStatus;

std::string_view trim(std::string_view s)
{
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t')) s.remove_suffix(1);
  return s;
}

std::string join(const TextTable::Names& names)
{
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ",") + name;
  return all;
}
}  // namespace

std::string quoted(std::string_view text)
{
  constexpr std::size_t kLongest = 60;
  std::string out = "'";
  for (const char c : text.substr(0, kLongest))
  {
    char hex[8];
    std::snprintf(hex, sizeof hex, "\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
    if (c >= ' ' && c <= '~')
      out += c;
    else
      out += hex;
  }
  return out + (text.size() > kLongest ? "...'" : "'");
}

TextTable TextTable::csv(const std::string& path)
{
  TextTable table(path, ',');
  const auto line = table.lines_.next();
  if (!line)
    throw core::Error(ExitStatus::kUnreadable, path, "is empty", "write a header line and rows");
  table.split(*line);
  for (const std::string_view name : table.fields_) table.names_.emplace_back(name);
  return table;
}

TextTable TextTable::blanks(const std::string& path, Names names)
{
  TextTable table(path, ' ');
  table.names_ = std::move(names);
  return table;
}

TextTable TextTable::words(const std::string& path)
{
  TextTable table(path, ' ');
  table.anyLength_ = true;
  return table;
}

std::size_t TextTable::matchHeader(const std::vector<Names>& headers) const
{
  for (std::size_t i = 0; i < headers.size(); ++i)
    if (headers[i] == names_) return i;
  std::string wanted;
  for (const Names& header : headers) wanted += (wanted.empty() ? "" : " or ") + join(header);
  fail(ExitStatus::kUnreadable, "the header is " + importers::quoted(join(names_)),
       "it must be " + wanted);
}

void TextTable::split(std::string_view line)
{
  fields_.clear();
  if (separator_ == ',')
    for (std::size_t comma = 0; comma != std::string_view::npos;)
    {
      comma = line.find(',');
      fields_.push_back(trim(line.substr(0, comma)));
      if (comma != std::string_view::npos) line.remove_prefix(comma + 1);
    }
  else
    for (line = trim(line); !line.empty(); line = trim(line))
    {
      const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
      fields_.push_back(line.substr(0, end));
      line.remove_prefix(end);
    }
}

bool TextTable::skipBlankEnd()
{
  const std::string where = lines_.path() + " line " + std::to_string(lines_.number());
  while (const auto line = lines_.next())
    if (!trim(*line).empty())
      throw core::Error(ExitStatus::kUnreadable, where, "a blank line among the rows", "remove it");
  return false;
}

bool TextTable::skips(std::string_view line) const
{
  const bool comment = separator_ == ' ' && !line.empty() && line.front() == '#';
  return comment || (anyLength_ && trim(line).empty());
}

bool TextTable::next()
{
  std::optional<std::string_view> line;
  do line = lines_.next();
  while (line && skips(*line));
  if (!line) return false;
  if (trim(*line).empty()) return skipBlankEnd();
  split(*line);
  if (!anyLength_ && fields_.size() != names_.size())
    fail(ExitStatus::kUnreadable,
         "the row has " + std::to_string(fields_.size()) + " columns instead of " +
             std::to_string(names_.size()),
         separator_ == ',' ? "write commas between fields and '.' as decimal point"
                           : "the columns are " + join(names_));
  return true;
}

bool TextTable::emptyFrom(std::size_t column) const
{
  for (std::size_t i = column; i < fields_.size(); ++i)
    if (!fields_[i].empty()) return false;
  return true;
}

double TextTable::number(std::size_t column) const
{
  std::string_view s = fields_[column];
  if (s.size() > 1 && s[0] == '+' && s[1] != '-') s.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), value);
  if (s.empty() || end != s.data() + s.size() || error == std::errc::invalid_argument)
    failAt(column, ExitStatus::kUnreadable, s.empty() ? "is empty" : quoted(s) + " is not a number",
           "write a number with '.' as decimal point");
  if (error != std::errc{} || !std::isfinite(value) || std::abs(value) > kLargest)
    failAt(column, ExitStatus::kNonsense, quoted(s) + " makes no sense",
           "values must be finite and below 1e10");
  return value;
}

double TextTable::nonNegative(std::size_t column) const
{
  const double value = number(column);
  if (value < 0)
    failAt(column, ExitStatus::kNonsense, quoted(fields_[column]) + " is negative",
           "it must be 0 or more");
  return value;
}

double TextTable::positive(std::size_t column) const
{
  const double value = number(column);
  if (value <= 0)
    failAt(column, ExitStatus::kNonsense, quoted(fields_[column]) + " is not positive",
           "it must be above 0");
  return value;
}

int TextTable::integer(std::size_t column, int lowest) const
{
  // Programs that know only floating-point columns write 3 as 3.0.
  const double value = number(column);
  if (value != std::round(value) || value < lowest || value > std::numeric_limits<int>::max())
    failAt(column, ExitStatus::kNonsense, quoted(fields_[column]) + " makes no sense",
           "write a whole number from " + std::to_string(lowest) + " on");
  return static_cast<int>(value);
}

std::optional<double> TextTable::optionalNumber(std::size_t column) const
{
  if (empty(column)) return std::nullopt;
  return number(column);
}

void TextTable::fail(ExitStatus status, const std::string& what, const std::string& mend) const
{
  throw core::Error(status, lines_.path() + " line " + std::to_string(lines_.number()), what, mend);
}

void TextTable::failAt(std::size_t column, ExitStatus status, const std::string& what,
                       const std::string& mend) const
{
  const std::string name =
      anyLength_ ? "field " + std::to_string(column + 1) : "column " + names_[column];
  fail(status, name + ": " + what, mend);
}
}  // namespace slamot::importers
