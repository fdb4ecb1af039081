#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

struct gzFile_s;

namespace slamot::mrpt
{
/// A file, gz or plain, read once from front to back within limits, so that a damaged or malicious
/// one of up to 50 MB costs seconds and not minutes.
class BoundedInput
{
 public:
  // Rawlogs shrink by 2 to 5, a single scan of a spinning laser by 33.
  static constexpr std::uint64_t kMostUnpacked = 128u << 20;  ///< [byte], and ...
  static constexpr std::uint64_t kMostUnpackedRatio = 20;  ///< ... this many times the file's size
  static constexpr double kMostSeconds = 5;                ///< of CPU while Working, per 50 MB

  /// While one lives, its thread's CPU time counts as spent on this input.
  class Working
  {
   public:
    explicit Working(BoundedInput& input);
    ~Working();
    Working(const Working&) = delete;
    Working& operator=(const Working&) = delete;

   private:
    BoundedInput& input_;
  };

  /// \throws core::Error (kUnreadable): not a file that can be read, or empty.
  explicit BoundedInput(const std::string& path);
  ~BoundedInput();
  BoundedInput(const BoundedInput&) = delete;
  BoundedInput& operator=(const BoundedInput&) = delete;

  /// Up to `size` bytes; fewer only at the end.
  /// \throws core::Error (kUnreadable) on gz data that is damaged, kLimit on a limit.
  std::size_t read(unsigned char* to, std::size_t size);

  /// Whether it is a gz file; known after the first read().
  [[nodiscard]] bool packed() const;
  /// Whether gz data ended before its end mark; known once read() came back short.
  [[nodiscard]] bool truncated() const { return truncated_; }
  /// Reads on to the end.  \throws as read(): so that damage shows as such, not as what it led to.
  void drain();
  /// Share of the file read, 0 to 1.
  [[nodiscard]] double progress() const;

 private:
  void checkLimits() const;

  std::string path_;
  std::uint64_t size_ = 0, unpacked_ = 0;
  double spentSeconds_ = 0, workingSince_ = 0;
  bool truncated_ = false;
  gzFile_s* file_ = nullptr;
};
}  // namespace slamot::mrpt
