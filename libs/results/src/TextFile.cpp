#include <slamot/results/TextFile.h>

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace slamot::results
{
namespace
{
using core::Error;
using core::ExitStatus;

template <class T>
bool parseWhole(std::string_view part, T& value)
{
  if (!part.empty() && part[0] == '+') part.remove_prefix(1);
  const char* last = part.data() + part.size();
  const auto [end, error] = std::from_chars(part.data(), last, value);
  return error == std::errc{} && end == last && !part.empty();
}

// What a message may show of a part that may be binary, or long.
std::string printable(std::string_view part)
{
  std::string shown(part.substr(0, 24));
  for (char& c : shown)
    if (c < ' ' || c > '~') c = '?';
  return part.size() > shown.size() ? shown + "..." : shown;
}

std::string_view trim(std::string_view s)
{
  const auto first = s.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t") - first + 1);
}
}  // namespace

LineReader::LineReader(const std::string& path) : path_(path), file_(path, std::ios::binary)
{
  if (!file_) throw Error(ExitStatus::kUnreadable, path, "can't be read", "check the path");
}

bool LineReader::next()
{
  file_.getline(buffer_, sizeof buffer_);
  ended_ = !file_.eof();
  const auto count = static_cast<std::size_t>(file_.gcount());
  if (file_.bad() || (file_.fail() && !file_.eof() && count == 0))
    throw Error(ExitStatus::kUnreadable, path_, "can't be read", "check the path");
  if (!ended_ && count == 0) return false;
  ++number_;
  if (file_.fail())
    throw Error(ExitStatus::kLimit, path_ + " line " + std::to_string(number_),
                "is over 4000 characters long", "give a text file of numbers");
  text_ = std::string_view(buffer_, count - (ended_ ? 1 : 0));
  if (!text_.empty() && text_.back() == '\r') text_.remove_suffix(1);
  return true;
}

std::vector<std::string_view> LineReader::commaSeparated() const
{
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at <= text_.size();)
  {
    const std::size_t end = std::min(text_.find(',', at), text_.size());
    parts.push_back(trim(text_.substr(at, end - at)));
    at = end + 1;
  }
  return parts;
}

std::vector<std::string_view> LineReader::blankSeparated() const
{
  std::vector<std::string_view> parts;
  for (std::size_t at = text_.find_first_not_of(" \t"); at != std::string_view::npos;)
  {
    const std::size_t end = std::min(text_.find_first_of(" \t", at), text_.size());
    parts.push_back(text_.substr(at, end - at));
    at = text_.find_first_not_of(" \t", end);
  }
  return parts;
}

double LineReader::number(std::string_view part, const char* name) const
{
  double value = 0;
  if (!parseWhole(part, value) || !std::isfinite(value))
    fail(std::string(name) + " '" + printable(part) + "' is no finite number", "mend the line");
  return value;
}

int LineReader::wholeNumber(std::string_view part, const char* name) const
{
  int value = 0;
  if (!parseWhole(part, value))
    fail(std::string(name) + " '" + printable(part) + "' is no whole number", "mend the line");
  return value;
}

void LineReader::fail(const std::string& what, const std::string& mend) const
{
  const std::string where = path_ + " line " + std::to_string(std::max<std::size_t>(number_, 1));
  if (!ended_)
    throw Error(ExitStatus::kTruncated, where, "the file ends within this line", "get it whole");
  throw Error(ExitStatus::kNonsense, where, what, mend);
}

void appendFixed(std::string& text, double value, int decimals)
{
  char digits[400];  // the largest double has 309 digits before the point
  const auto end =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, decimals).ptr;
  std::string_view shown(digits, static_cast<std::size_t>(end - digits));
  if (shown.front() == '-' && shown.find_first_not_of("-0.") == std::string_view::npos)
    shown.remove_prefix(1);
  text += shown;
}

void writeWhole(const std::string& path, const std::string& text)
{
  // Its own for each writer, also of other machines: no two can be within one file.
  static std::atomic<unsigned> writes{0};
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  const std::string temporary = path + "." + host + "." + std::to_string(getpid()) + "." +
                                std::to_string(writes++) + ".partial";
  std::ofstream file(temporary, std::ios::binary);
  file << text;
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(temporary, path, error);
  if (file && !error) return;
  std::filesystem::remove(temporary, error);
  throw Error(ExitStatus::kUnreadable, path, "can't be written", "check the folder and its space");
}
}  // namespace slamot::results
