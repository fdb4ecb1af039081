#pragma once

#include <map>
#include <string>
#include <vector>

namespace slamot::core
{
/// An ini file in MRPT's dialect, read strictly: `//` starts a comment, so do `;` and `#` at the
/// start of a line; a section or key that comes twice, a key outside a section and a line that is
/// neither are errors (MRPT keeps the last of two equal keys and merges [A] and [a]).
class Config
{
 public:
  Config() = default;

  /// \throws Error (kConfig): the file can't be read, or as parse().
  static Config load(const std::string& path);
  /// Reads a text; `name` stands for it in messages.
  /// \throws Error (kConfig) on a malformed line.
  static Config parse(const std::string& text, const std::string& name);

  /// Sets `Section.key=value`, as --set does.  \throws Error (kConfig) on another form.
  void set(const std::string& assignment);
  /// The same, value untouched. \throws Error (kConfig) if the value holds a line break or `//`,
  /// which no ini file could hold.
  void set(const std::string& section, const std::string& key, const std::string& value);

  /// The file's name without its folders: stands before every complaint.
  [[nodiscard]] const std::string& name() const { return name_; }

  /// Whether the section, or the section and the key in it, was read or set.
  [[nodiscard]] bool has(const std::string& section) const { return sections_.count(section) > 0; }
  /// The same of a key.
  [[nodiscard]] bool has(const std::string& section, const std::string& key) const;
  /// In alphabetical order.
  [[nodiscard]] std::vector<std::string> sections() const;
  /// Takes over the other's sections that this one has not.
  void addMissingSections(const Config& other);
  /// Removes a section with all its keys, read or not.
  void erase(const std::string& section) { sections_.erase(section); }

  /// \throws Error (kConfig): a section or key that nobody read, with the nearest that was asked
  /// for. Sections in `ignored` are not looked at.
  void requireAllRead(const std::vector<std::string>& ignored = {}) const;

  /// What was read, defaults included, as an ini text that repeats the run.
  [[nodiscard]] std::string effectiveText() const;

 private:
  friend class Params;
  struct Entry
  {
    std::string value;
    bool read = false;
  };
  struct Section
  {
    std::map<std::string, Entry> entries;
    std::vector<std::string> asked;  // keys that readers know, also absent ones
    std::vector<std::string> effectiveOrder;
    std::map<std::string, std::string> effective;  // as read, or the default
  };
  void checkKeys(const std::string& sectionName, const Section& section) const;

  std::string name_ = "config";
  std::map<std::string, Section> sections_;
  std::vector<std::string> order_;  // sections in order of reading
};
}  // namespace slamot::core
