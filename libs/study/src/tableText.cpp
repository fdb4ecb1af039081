#include "tableText.h"

#include <charconv>

namespace slamot::study
{
std::string shortest(double value)
{
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value == 0 ? 0.0 : value).ptr;
  return {text, end};
}

std::string scientific(double value)
{
  char text[40];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, 2).ptr;
  return {text, end};
}

std::string csvField(const std::string& text)
{
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

std::string csvLine(const std::vector<std::string>& fields)
{
  std::string out;
  for (std::size_t i = 0; i < fields.size(); ++i) out += (i > 0 ? "," : "") + csvField(fields[i]);
  return out + '\n';
}

std::string markdownLine(const std::vector<std::string>& fields)
{
  std::string out = "|";
  for (const std::string& field : fields)
  {
    out += ' ';
    for (const char c : field) out += c == '|' ? "\\|" : std::string(1, c);
    out += " |";
  }
  return out + '\n';
}

std::string markdownHead(const std::vector<std::string>& fields)
{
  return markdownLine(fields) + markdownLine(std::vector<std::string>(fields.size(), "---"));
}
}  // namespace slamot::study
