#pragma once

#include <string>

// The markup of manual pages.
namespace slamot::apps::troff
{
/// Text as it is to be read: troff takes some characters for commands, others for typographic ones.
[[nodiscard]] std::string escaped(const std::string& text);
[[nodiscard]] std::string bold(const std::string& text);
[[nodiscard]] std::string italic(const std::string& text);
/// An entry of a list.  \param head marked up already.
[[nodiscard]] std::string entry(const std::string& head, const std::string& text);
}  // namespace slamot::apps::troff
