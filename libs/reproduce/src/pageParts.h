#pragma once

#include <slamot/reproduce/Reproduction.h>
#include <slamot/results/HtmlPage.h>

namespace slamot::reproduce
{
/// Where a claim's box is on the page.
[[nodiscard]] std::string claimId(const PaperSpec& paper, const Claim& claim);

/// One section: text, claims, pictures, plots, tables, and how to repeat it.
void addSection(results::HtmlPage& page, const Reproduction& all, std::size_t paper,
                std::size_t section);

/// The files that a paper's studies are made from, each once.
void addSettings(results::HtmlPage& page, const Reproduction& all, std::size_t paper);

/// What the runs took, from their records.
void addCost(results::HtmlPage& page, const Reproduction& all);
}  // namespace slamot::reproduce
