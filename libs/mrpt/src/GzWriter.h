#pragma once

#include <cstddef>
#include <string>

struct gzFile_s;

namespace slamot::mrpt
{
/// A gz file that appears at its path only when it is whole.
class GzWriter
{
 public:
  /// Writes to a temporary beside `path`.  \throws core::Error (kUnreadable) if that can't be made.
  explicit GzWriter(const std::string& path);
  /// Removes the temporary, if close() was not reached.
  ~GzWriter();
  GzWriter(const GzWriter&) = delete;
  GzWriter& operator=(const GzWriter&) = delete;

  /// \throws core::Error (kUnreadable) if the disk is full.
  void write(const void* data, std::size_t size);
  void close();

 private:
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_, temporary_;
  gzFile_s* file_ = nullptr;
};
}  // namespace slamot::mrpt
