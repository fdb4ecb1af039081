#pragma once

#include <string>

namespace slamot::study
{
/// 64-bit FNV-1a of a text, as 16 hexadecimal digits: tells other specs apart, no protection
/// against malice.
[[nodiscard]] std::string hashOf(const std::string& text);

/// The same of a file's bytes and of all files in a folder, which may be absent.
/// \throws core::Error (kUnreadable).
[[nodiscard]] std::string hashOfFiles(const std::string& file, const std::string& folder);
}  // namespace slamot::study
