#include <slamot/results/HtmlPage.h>

#include <slamot/core/Error.h>
#include <slamot/results/Gnuplot.h>

namespace slamot::results
{
std::string escapedHtml(const std::string& text)
{
  std::string out;
  for (const char c : text)
  {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

namespace
{
std::string element(const char* tag, const std::string& text, const std::string& id = {})
{
  const std::string named = id.empty() ? "" : " id=\"" + escapedHtml(id) + "\"";
  return std::string("<") + tag + named + ">" + escapedHtml(text) + "</" + tag + ">";
}

/// A path as a relative reference: what is not plain is a percent sign and its byte, and a colon is
/// no scheme's.
std::string reference(const std::string& path)
{
  constexpr char kHex[] = "0123456789ABCDEF";
  std::string out;
  for (const char c : path)
  {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '/' || c == '.' || c == '-' || c == '_' || c == '~';
    if (plain)
      out += c;
    else
      out += {'%', kHex[byte >> 4], kHex[byte & 15]};
  }
  return out;
}

const char* const kStyle = R"(
*{box-sizing:border-box}
body{margin:0 auto;max-width:62rem;padding:1.5rem 1rem 3rem;background:var(--paper);color:var(--ink-text);
font:1rem/1.5 system-ui,-apple-system,"Segoe UI","DejaVu Sans",sans-serif}
h1{font-size:1.6rem;line-height:1.25;margin:0 0 .2rem;overflow-wrap:anywhere}
h3{font-size:1.02rem;margin:1.8rem 0 .5rem}
h2{font-size:1.15rem;margin:2.2rem 0 .6rem;padding-bottom:.25rem;border-bottom:1px solid var(--ink-grid)}
.sub,figcaption,.note{color:var(--faint)}
.sub{margin:0}
.banner{margin:1rem 0;padding:.7rem 1rem;border-radius:.4rem;background:#b42318;color:#fff;font-weight:600}
.wide{overflow-x:auto}
.wide+.wide{margin-top:1.2rem}
table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:.93rem}
th,td{padding:.3rem .6rem;text-align:right;border-bottom:1px solid var(--ink-grid);white-space:nowrap}
th{font-weight:600;vertical-align:bottom;white-space:normal}
th:first-child,td:first-child{text-align:left;padding-left:0;white-space:normal}
a{color:var(--ink-blue)}
figure{margin:1.2rem 0 1.8rem}
figcaption{font-size:.93rem;margin-bottom:.4rem}
.row{display:grid;grid-template-columns:repeat(auto-fit,minmax(17rem,1fr));gap:0 1.2rem;align-items:end}
svg{display:block;width:100%;height:auto}
svg text{font-family:system-ui,-apple-system,"Segoe UI","DejaVu Sans",sans-serif}
pre{margin:0;padding:.8rem 1rem;border-radius:.4rem;background:var(--shade);overflow-x:auto;font-size:.85rem;line-height:1.45}
@media print{body{max-width:none;padding:0;font-size:10pt}figure,table,pre{break-inside:avoid}
pre{white-space:pre-wrap}.banner{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
)";

std::string baseStyle()
{
  return ":root{color-scheme:light dark;--paper:#fff;--shade:#f6f8fa;--faint:#57606a;" +
         inkVariables(false) + "}\n@media screen and (prefers-color-scheme:dark){:root{" +
         "--paper:#0d1117;--shade:#161b22;--faint:#9198a1;" + inkVariables(true) + "}}" + kStyle;
}
}  // namespace

HtmlPage::HtmlPage(const std::string& title, const std::string& subtitle)
    : title_(title), subtitle_(subtitle)
{
}

void HtmlPage::banner(const std::string& text)
{
  body_ += "<p class=\"banner\" role=\"alert\">" + escapedHtml(text) + "</p>\n";
}

void HtmlPage::heading(const std::string& text, const std::string& id)
{
  body_ += element("h2", text, id) + "\n";
}
void HtmlPage::subheading(const std::string& text, const std::string& id)
{
  body_ += element("h3", text, id) + "\n";
}
void HtmlPage::paragraph(const std::string& text)
{
  body_ += element("p", text) + "\n";
}
void HtmlPage::links(const std::vector<std::pair<std::string, std::string>>& textsAndPaths)
{
  body_ += "<ul>\n";
  for (const auto& [text, path] : textsAndPaths)
    body_ += "<li><a href=\"" + reference(path) + "\">" + escapedHtml(text) + "</a></li>\n";
  body_ += "</ul>\n";
}

void HtmlPage::preformatted(const std::string& text)
{
  body_ += element("pre", text) + "\n";
}

void HtmlPage::table(const Table& table)
{
  const auto row = [&](const char* tag, const std::vector<std::string>& cells)
  {
    std::string line;
    for (const std::string& cell : cells) line += element(tag, cell);
    return "<tr>" + line + "</tr>\n";
  };
  body_ += "<div class=\"wide\"><table>\n";
  if (!table.header.empty()) body_ += "<thead>" + row("th", table.header) + "</thead>\n";
  body_ += "<tbody>\n";
  for (const auto& cells : table.rows) body_ += row("td", cells);
  body_ += "</tbody></table></div>\n";
}

void HtmlPage::figure(const std::string& caption, const Figure& figure)
{
  try
  {
    svg(caption, drawFigure(figure, PictureFormat::kSvg));
  }
  catch (const core::Error& e)
  {
    missingPlots_ = e.what();
    body_ += "<figure>" + element("figcaption", caption) +
             "\n<p class=\"note\">This plot is missing: " + escapedHtml(e.what()) +
             "</p>\n</figure>\n";
  }
}

void HtmlPage::svg(const std::string& caption, const std::string& picture)
{
  const std::string prefix = "f" + std::to_string(++figures_) + "-";
  std::string drawn = inlineSvg(picture, prefix);
  drawn.insert(drawn.find("<svg") + 4, " role=\"img\" aria-label=\"" + escapedHtml(caption) + "\"");
  body_ += "<figure>" + element("figcaption", caption) + "\n" + drawn + "</figure>\n";
}

void HtmlPage::figuresInRow(const std::vector<std::pair<std::string, Figure>>& captionsAndFigures)
{
  body_ += "<div class=\"row\">\n";
  for (const auto& [caption, plot] : captionsAndFigures) figure(caption, plot);
  body_ += "</div>\n";
}

std::string HtmlPage::html() const
{
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n" +
         std::string("<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n") +
         element("title", title_) + "\n<style>\n" + baseStyle() + style_ +
         "</style>\n</head>\n<body>\n<header>" + element("h1", title_) + "\n<p class=\"sub\">" +
         escapedHtml(subtitle_) + "</p></header>\n" + body_ + "</body>\n</html>\n";
}
}  // namespace slamot::results
