#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace slamot::laws
{
/// Laws that did not hold; what() tells each on a line of its own.  A test framework reports it as
/// it reports any exception that leaves a test.
class LawBroken : public std::runtime_error
{
 public:
  /// `subject` is what broke them, a filter's or a model's name.
  LawBroken(const std::string& subject, const std::vector<std::string>& lines)
      : std::runtime_error(text(subject, lines))
  {
  }

 private:
  static std::string text(const std::string& subject, const std::vector<std::string>& lines)
  {
    std::string all = subject + " breaks a law:";
    for (const std::string& line : lines) all += "\n  " + line;
    return all;
  }
};
}  // namespace slamot::laws
