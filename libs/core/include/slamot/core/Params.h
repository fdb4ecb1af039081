#pragma once

#include <slamot/core/Config.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace slamot::core
{
/// One section of a Config, read strictly.  Each reader checks type and range and notes what was
/// read, so that Config::requireAllRead() finds what nobody knows.  The unit is in the key's name;
/// a key with `_deg` is in degrees in the file and comes back in radians.
/// All readers \throw Error (kConfig): missing without default, wrong type, out of range.
class Params
{
 public:
  /// Makes the section if the config has none, so that defaults hold.
  Params(Config& config, std::string section);

  /// Any finite number.
  double number(const std::string& key, std::optional<double> otherwise = {});
  /// Above 0.
  double positive(const std::string& key, std::optional<double> otherwise = {});
  /// 0 or above.
  double nonNegative(const std::string& key, std::optional<double> otherwise = {});
  /// In (0, 1).
  double probability(const std::string& key, std::optional<double> otherwise = {});
  /// In [lo, hi]; bounds in the file's unit.
  double inRange(const std::string& key, double lo, double hi,
                 std::optional<double> otherwise = {});
  /// A whole number in [lo, hi].
  int integer(const std::string& key, int lo, int hi, std::optional<int> otherwise = {});
  /// `true` or `false`.
  bool flag(const std::string& key, std::optional<bool> otherwise = {});
  /// Any text, blanks at its ends left out.
  std::string text(const std::string& key, std::optional<std::string> otherwise = {});
  /// One of `choices`.
  std::string choice(const std::string& key, const std::vector<std::string>& choices,
                     std::optional<std::string> otherwise = {});
  /// Comma-separated; at least one.
  std::vector<double> numbers(const std::string& key, std::optional<std::string> otherwise = {});
  /// Comma-separated texts; an empty one between commas is an error.
  std::vector<std::string> list(const std::string& key, std::optional<std::string> otherwise = {});
  /// Absent if the key is; at least `lo`, in the file's unit.
  std::optional<double> optionalNumber(const std::string& key,
                                       double lo = -std::numeric_limits<double>::infinity());

  /// Keys that only another choice than the one made would read: known, and left alone, so that
  /// --set can change a choice whose keys the file holds.
  void allowUnused(const std::vector<std::string>& keys);

  /// The section's keys in the file or set, whether read or not.
  [[nodiscard]] std::vector<std::string> keys() const;
  /// Whether the file or --set has the key; asking does not count as reading.
  [[nodiscard]] bool has(const std::string& key) const { return config_->has(section_, key); }
  /// Its name.
  [[nodiscard]] const std::string& section() const { return section_; }
  /// For a check that spans several keys.
  [[noreturn]] void fail(const std::string& key, const std::string& what,
                         const std::string& mend = {}) const;

 private:
  std::string read(const std::string& key, const std::optional<std::string>& otherwise,
                   const std::string& allowed);
  double readNumber(const std::string& key, double lo, double hi, bool open,
                    std::optional<double> otherwise);

  Config* config_;
  std::string section_;
};
}  // namespace slamot::core
