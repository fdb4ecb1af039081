#include <slamot/results/Gnuplot.h>

#include "palette.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <locale>
#include <sstream>

namespace slamot::results
{
namespace
{
void replaceAll(std::string& text, const std::string& from, const std::string& to)
{
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

void eraseBetween(std::string& text, const std::string& first, const std::string& last)
{
  const auto begin = text.find(first);
  if (begin == std::string::npos) return;
  const auto end = text.find(last, begin + first.size());
  if (end != std::string::npos) text.erase(begin, end + last.size() - begin);
}

/// The palette's variable for a colour as gnuplot writes it: "r, g, b", with or without blanks.
std::string variableOf(const std::string& rgb)
{
  int parts[3] = {-1, -1, -1}, n = 0;
  std::istringstream in(rgb);
  in.imbue(std::locale::classic());
  for (char comma; n < 3 && in >> parts[n]; ++n) in >> comma;
  char hex[8];
  std::snprintf(hex, sizeof hex, "%02x%02x%02x", parts[0] & 255, parts[1] & 255, parts[2] & 255);
  const auto named = [&](const Colour& c)
  { return std::strcmp(c.light, hex) == 0 ? std::string("var(--ink-") + c.name + ")" : ""; };
  std::string name = named(kGrid) + named(kAxis);
  for (const Colour& c : kPalette) name += named(c);
  return name;
}

void nameColours(std::string& svg)
{
  std::string out;
  std::size_t done = 0;
  for (std::size_t at; (at = svg.find("rgb(", done)) != std::string::npos;)
  {
    const auto end = svg.find(')', at);
    if (end == std::string::npos) break;
    const std::string name = variableOf(svg.substr(at + 4, end - at - 4));
    out.append(svg, done, at - done);
    out += name.empty() ? svg.substr(at, end + 1 - at) : name;
    done = end + 1;
  }
  svg = out.append(svg, done, std::string::npos);
}

/// Groups that hold nothing, which gnuplot writes by the dozen.
void dropEmptyGroups(std::string& svg)
{
  const std::string close = "</g>\n";
  std::string out;
  for (std::size_t begin = 0; begin < svg.size();)
  {
    const auto end = std::min(svg.find('\n', begin), svg.size() - 1) + 1;
    const std::string line = svg.substr(begin, end - begin);
    const auto last = out.empty() ? 0 : out.rfind('\n', out.size() - 2) + 1;
    if (line == close && out.compare(last, 3, "<g ") == 0)
      out.erase(last);
    else
      out += line;
    begin = end;
  }
  svg = out;
}
}  // namespace

std::string inlineSvg(const std::string& picture, const std::string& prefix)
{
  std::string svg = picture;
  eraseBetween(svg, "<?xml", "?>\n");
  eraseBetween(svg, "\n xmlns=\"", "\"");
  eraseBetween(svg, "\n xmlns:xlink=\"", "\"");
  eraseBetween(svg, "<title>", "</title>\n");
  eraseBetween(svg, "<desc>", "</desc>\n");
  eraseBetween(svg, "<filter id='textbox'", "</filter>\n");
  eraseBetween(svg, "<filter id='greybox'", "</filter>\n");
  eraseBetween(svg, "<rect x=\"0\" y=\"0\"", "/>\n");
  replaceAll(svg, "xlink:href='#", "href='#" + prefix);
  replaceAll(svg, " id='", " id='" + prefix);
  replaceAll(svg, " id=\"", " id=\"" + prefix);
  nameColours(svg);
  dropEmptyGroups(svg);
  return svg;
}

std::string inkVariables(bool dark)
{
  std::string css;
  const auto add = [&](const Colour& c)
  { css += std::string("--ink-") + c.name + ":#" + (dark ? c.dark : c.light) + ";"; };
  for (const Colour& c : kPalette) add(c);
  add(kGrid);
  add(kAxis);
  return css;
}
}  // namespace slamot::results
