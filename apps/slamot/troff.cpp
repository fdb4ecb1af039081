#include "troff.h"

namespace slamot::apps::troff
{
std::string escaped(const std::string& text)
{
  std::string out = !text.empty() && text[0] == '.' ? "\\&" : "";
  for (const char c : text)
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if (c == '\'')
      out += "\\(aq";
    else if (c == '`')
      out += "\\(ga";
    else if (c == '^')
      out += "\\(ha";
    else if (c == '~')
      out += "\\(ti";
    else
      out += c;
  return out;
}

std::string bold(const std::string& text)
{
  return "\\fB" + escaped(text) + "\\fR";
}
std::string italic(const std::string& text)
{
  return "\\fI" + escaped(text) + "\\fR";
}

std::string entry(const std::string& head, const std::string& text)
{
  return ".TP\n" + head + "\n" + escaped(text) + "\n";
}
}  // namespace slamot::apps::troff
