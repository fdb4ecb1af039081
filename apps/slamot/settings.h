#pragma once

#include <map>
#include <string>
#include <vector>

namespace slamot::apps
{
/// What --set can set: a configuration's keys with their values, and those that its method knows
/// besides, with their defaults.
class Settings
{
 public:
  /// \param config the path of an ini file; where it can't be read, all methods' keys are known.
  explicit Settings(const std::string& config);

  /// Values in effect by `Section.key`.
  [[nodiscard]] const std::map<std::string, std::string>& values() const { return values_; }
  /// What a key may be set to, if that is one of a few; none, if it is not.
  [[nodiscard]] std::vector<std::string> choices(const std::string& sectionAndKey) const;

 private:
  std::string text_;  // of the configuration
  std::map<std::string, std::string> values_;
};
}  // namespace slamot::apps
