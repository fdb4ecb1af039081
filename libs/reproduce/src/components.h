#pragma once

#include <slamot/reproduce/judge.h>
#include <slamot/study/tables.h>

#include <string>

/// Parts of the page as HTML, their texts escaped.
namespace slamot::reproduce
{
/// A verdict as a coloured mark with a sign and words: told apart without colour, too.
[[nodiscard]] std::string badge(const Judgement& judgement);

/// A claim with its verdict and the numbers that decided; `id` is where links lead.
[[nodiscard]] std::string claimBox(const std::string& id, const Claim& claim,
                                   const Judgement& judgement);

/// A row of the summary.
struct SummaryRow
{
  std::string paper, says, where, id;
  Judgement judgement;
};
/// How many claims hold, and so on, and each claim with its verdict and a link to its box.
/// \param withPaper whether there are several papers
[[nodiscard]] std::string summary(const std::vector<SummaryRow>& rows, bool withPaper);

/// A study's table, published figures set apart.
[[nodiscard]] std::string tableHtml(const study::TableText& table);

/// What is shown when its headline is clicked.
[[nodiscard]] std::string folded(const std::string& headline, const std::string& html);

[[nodiscard]] std::string paragraph(const std::string& text, const std::string& kind = {});
[[nodiscard]] std::string code(const std::string& text);

/// The style sheet of all these.
[[nodiscard]] std::string styleSheet();
}  // namespace slamot::reproduce
