#pragma once

#include "Entry.h"

#include <memory>
#include <optional>

namespace slamot::mrpt
{
/// Streams a rawlog's entries.
class EntryReader
{
 public:
  explicit EntryReader(const std::string& path);
  ~EntryReader();

  /// None at the end.  \throws core::Error on a damaged file; kTruncated if it ends inside an
  /// entry.
  std::optional<Entry> next();
  /// Share of the file read, 0 to 1.
  [[nodiscard]] double progress() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
}  // namespace slamot::mrpt
