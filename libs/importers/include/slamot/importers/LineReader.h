#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

struct gzFile_s;

namespace slamot::importers
{
/// The lines of a text file, plain or gz, in bounded memory.
/// Line ends may be LF or CRLF, a UTF-8 byte order mark is skipped, the last line needs no end.
class LineReader
{
 public:
  static constexpr std::size_t kLongestLine = std::size_t{1} << 20;    ///< [bytes]
  static constexpr std::uint64_t kMostBytes = std::uint64_t{4} << 30;  ///< of text, unpacked

  /// \throws core::Error (kUnreadable) if the file can't be opened.
  explicit LineReader(std::string path);

  /// The next line without its end, valid until the next call; none at the end of the file.
  /// \throws core::Error: kUnreadable; kTruncated (a gz file that ends early); kLimit (a line or a
  /// file that is too long).
  std::optional<std::string_view> next();

  [[nodiscard]] std::size_t number() const { return number_; }  ///< of the last line, from 1
  /// As it was given.
  [[nodiscard]] const std::string& path() const { return path_; }
  /// Share of the file already read, 0 to 1.
  [[nodiscard]] double progress() const;

 private:
  bool fill();

  std::string path_;
  std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> file_;
  std::uint64_t size_ = 0;   // of the file as stored
  std::uint64_t bytes_ = 0;  // unpacked so far
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // what is unread in the buffer
  std::size_t number_ = 0;
};

/// `path`, or `path`.gz if only that exists; empty if neither does.
[[nodiscard]] std::string plainOrGz(const std::string& path);
}  // namespace slamot::importers
