#include "components.h"

#include <slamot/results/HtmlPage.h>

#include <algorithm>

namespace slamot::reproduce
{
namespace
{
using results::escapedHtml;

std::string tag(const std::string& name, const std::string& kind, const std::string& html)
{
  const std::string opened = kind.empty() ? name : name + " class=\"" + kind + "\"";
  return "<" + opened + ">" + html + "</" + name + ">";
}

/// The end of the classes that a verdict has its colour from, and its sign.
struct Look
{
  const char* kind;
  const char* sign;
};
Look lookOf(Verdict verdict)
{
  switch (verdict)
  {
    case Verdict::kHolds:
      return {"holds", "✓"};
    case Verdict::kInPart:
      return {"part", "◐"};
    case Verdict::kDoesNotHold:
      return {"not", "✗"};
    case Verdict::kNotTestable:
      return {"untestable", "–"};
    case Verdict::kNotRun:
      break;
  }
  return {"unrun", "…"};
}

std::string statusText(Status status)
{
  switch (status)
  {
    case Status::kMet:
      return "✓ met";
    case Status::kOpen:
      return "◐ open";
    case Status::kFailed:
      return "✗ failed";
    case Status::kLeftOut:
      return "left out";
    case Status::kNotRun:
      break;
  }
  return "no number";
}

std::string kindOf(Status status)
{
  if (status == Status::kMet) return "s-holds";
  if (status == Status::kOpen) return "s-part";
  return status == Status::kFailed ? "s-not" : "s-none";
}

std::string checkRow(const Check& c)
{
  std::string claimed = escapedHtml(c.claimed);
  if (!c.remark.empty()) claimed += "<br>" + tag("span", "faint", escapedHtml(c.remark));
  return "<tr>" + tag("td", "", escapedHtml(c.what)) + tag("td", "num", escapedHtml(c.measured)) +
         tag("td", "words", claimed) + tag("td", kindOf(c.status), statusText(c.status)) +
         "</tr>\n";
}

std::string checkTable(const std::vector<Check>& checks)
{
  std::string rows;
  for (const Check& c : checks) rows += checkRow(c);
  return "<div class=\"wide\"><table class=\"checks\">\n<thead><tr><th>measured</th>"
         "<th>here</th><th class=\"words\">claimed</th><th></th></tr></thead>\n<tbody>\n" +
         rows + "</tbody></table></div>\n";
}

std::string undecidedOf(const std::vector<SummaryRow>& rows)
{
  const auto n = std::count_if(rows.begin(), rows.end(),
                               [](const SummaryRow& r) { return r.judgement.isUndecided; });
  return n == 0 ? "" : " " + tag("span", "faint", std::to_string(n) + " of them undecided");
}

std::string counts(const std::vector<SummaryRow>& rows)
{
  std::string out;
  for (const Verdict v : {Verdict::kHolds, Verdict::kInPart, Verdict::kDoesNotHold,
                          Verdict::kNotTestable, Verdict::kNotRun})
  {
    const auto n = std::count_if(rows.begin(), rows.end(),
                                 [v](const SummaryRow& r) { return r.judgement.verdict == v; });
    if (n == 0 && v == Verdict::kNotRun) continue;
    Judgement only;
    only.verdict = v;
    out += "<li>" + tag("span", "count", std::to_string(n)) + " " + badge(only) +
           (v == Verdict::kInPart ? undecidedOf(rows) : "") + "</li>\n";
  }
  return "<ul class=\"counts\">\n" + out + "</ul>\n";
}
}  // namespace

std::string badge(const Judgement& judgement)
{
  const Look look = lookOf(judgement.verdict);
  const std::string mark = tag("span", std::string("badge b-") + look.kind,
                               "<span aria-hidden=\"true\">" + std::string(look.sign) + "</span> " +
                                   verdictText(judgement.verdict));
  return judgement.isUndecided ? mark + " " + tag("span", "faint", "undecided") : mark;
}

std::string claimBox(const std::string& id, const Claim& claim, const Judgement& judgement)
{
  std::string head = badge(judgement) + " " + tag("span", "says", escapedHtml(claim.says));
  if (!claim.where.empty()) head += " " + tag("span", "faint", escapedHtml(claim.where));
  std::string out = tag("p", "", head) + "\n";
  if (!claim.untestable.empty()) out += paragraph(claim.untestable);
  if (!judgement.checks.empty()) out += checkTable(judgement.checks);
  if (!claim.note.empty()) out += paragraph(claim.note, "faint");
  return "<section class=\"claim c-" + std::string(lookOf(judgement.verdict).kind) + "\" id=\"" +
         escapedHtml(id) + "\">\n" + out + "</section>\n";
}

std::string summary(const std::vector<SummaryRow>& rows, bool withPaper)
{
  std::string out = counts(rows) + "<ol class=\"verdicts\">\n";
  std::string paper;
  for (const SummaryRow& r : rows)
  {
    if (withPaper && r.paper != paper)
      out += "<li class=\"paper\">" + escapedHtml(paper = r.paper) + "</li>\n";
    out += "<li><span>" + badge(r.judgement) + "</span><a href=\"#" + escapedHtml(r.id) + "\">" +
           escapedHtml(r.says) + "</a><span class=\"faint\">" + escapedHtml(r.where) +
           "</span></li>\n";
  }
  return out + "</ol>\n";
}

namespace
{
/// A number with its interval, and under it the deviation in brackets.
std::string numberCell(const std::string& text)
{
  const auto bracket = text.find(" (");
  if (bracket == std::string::npos || bracket == 0) return tag("td", "", escapedHtml(text));
  return tag("td", "",
             escapedHtml(text.substr(0, bracket)) + "<br>" +
                 tag("span", "faint", escapedHtml(text.substr(bracket + 1))));
}

/// A row; what it has in common with the one above stays behind.
std::string tableRow(const study::TableText& table, std::size_t place)
{
  const auto& row = table.rows[place];
  std::string cells;
  bool isSame = place > 0;
  for (std::size_t i = 0; i < row.fields.size(); ++i)
  {
    isSame =
        isSame && i + 1 < table.leadColumns && row.fields[i] == table.rows[place - 1].fields[i];
    cells += i < table.leadColumns ? tag("td", isSame ? "same" : "", escapedHtml(row.fields[i]))
                                   : numberCell(row.fields[i]);
  }
  return tag("tr", row.isPublished ? "published" : "", cells) + "\n";
}
}  // namespace

std::string tableHtml(const study::TableText& table)
{
  std::string head, body;
  for (const std::string& h : table.head) head += tag("th", "", escapedHtml(h));
  for (std::size_t i = 0; i < table.rows.size(); ++i) body += tableRow(table, i);
  const std::string lead = std::to_string(table.leadColumns);
  return "<div class=\"wide\"><table class=\"study lead" + lead + "\">\n<thead><tr>" + head +
         "</tr></thead>\n<tbody>\n" + body + "</tbody></table></div>\n";
}

std::string folded(const std::string& headline, const std::string& html)
{
  return "<details><summary>" + escapedHtml(headline) + "</summary>\n" + html + "</details>\n";
}

std::string paragraph(const std::string& text, const std::string& kind)
{
  return text.empty() ? std::string() : tag("p", kind, escapedHtml(text)) + "\n";
}

std::string code(const std::string& text)
{
  return "<pre>" + escapedHtml(text) + "</pre>\n";
}
}  // namespace slamot::reproduce
