#pragma once

#include <slamot/core/Error.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace slamot::mrpt
{
/// Thrown by a cursor at the end of the bytes that are there.
struct NeedMore
{
};

/// Thrown on bytes that can't be a rawlog's.
struct Damage
{
  std::size_t at;  ///< place in the cursor's bytes
  std::string what, mend;
  core::ExitStatus status;
};

/// Walks over little-endian bytes, never beyond them.
class ByteCursor
{
 public:
  ByteCursor(unsigned char* data, std::size_t size, std::size_t at = 0)
      : data_(data), size_(size), at_(at)
  {
  }

  [[nodiscard]] std::size_t at() const { return at_; }
  [[nodiscard]] std::size_t left() const { return size_ - at_; }
  [[nodiscard]] const unsigned char* here() const { return data_ + at_; }

  void skip(std::size_t n)
  {
    if (n > left()) throw NeedMore{};
    at_ += n;
  }

  template <class T>
  T read()
  {
    T value;
    const unsigned char* from = here();
    skip(sizeof value);
    std::memcpy(&value, from, sizeof value);
    return value;
  }

  /// A bool.  Old logs hold some that were never set: any value but 0 and 1, which MRPT would read
  /// into a C++ bool as it is, is made 1.
  bool flag()
  {
    unsigned char* byte = data_ + at_;
    skip(1);
    if (*byte > 1) *byte = 1;
    return *byte == 1;
  }

  /// A number of things of at least `bytesEach`, which must be there.
  std::uint32_t count(std::uint32_t most, std::size_t bytesEach, const std::string& what)
  {
    const std::size_t before = at_;
    const auto n = read<std::uint32_t>();
    if (n > most)
      throw Damage{before, std::to_string(n) + " " + what + " make no sense", "", kNonsense};
    if (bytesEach * n > left()) throw NeedMore{};
    return n;
  }

  void text(std::uint32_t most, const std::string& what) { skip(count(most, 1, what)); }

  [[noreturn]] void damage(const std::string& what, const std::string& mend = {},
                           core::ExitStatus status = kNonsense) const
  {
    throw Damage{at_, what, mend, status};
  }

 private:
  static constexpr core::ExitStatus kNonsense = core::ExitStatus::kNonsense;

  unsigned char* data_;
  std::size_t size_, at_;
};
}  // namespace slamot::mrpt
