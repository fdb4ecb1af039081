#pragma once

#include <slamot/study/Plan.h>

#include <string>
#include <vector>

namespace slamot::study
{
/// The shortest text that reads back the same number.
[[nodiscard]] std::string shortest(double value);

/// With three digits, as 1.23e+08.
[[nodiscard]] std::string scientific(double value);

/// A field of a CSV file, in quotes where it needs them.
[[nodiscard]] std::string csvField(const std::string& text);
[[nodiscard]] std::string csvLine(const std::vector<std::string>& fields);

[[nodiscard]] std::string markdownLine(const std::vector<std::string>& fields);
/// The head of a table and the line under it.
[[nodiscard]] std::string markdownHead(const std::vector<std::string>& fields);
}  // namespace slamot::study
