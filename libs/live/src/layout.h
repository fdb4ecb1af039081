#pragma once

#include <slamot/fusion/Message.h>

#include <cstring>
#include <optional>

// Numbers in bytes, little endian as the machines that this builds for.
namespace slamot::live
{
/// Puts numbers one after another, behind four letters; a checksum closes it.
class Packer
{
 public:
  explicit Packer(const char (&letters)[5]) : bytes_(letters, letters + 4) {}

  template <class T>
  Packer& add(T value)
  {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
    return *this;
  }
  Packer& add(const fusion::Bytes& bytes)
  {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
  }
  [[nodiscard]] fusion::Bytes close()
  {
    bytes_.resize(bytes_.size() + 4);
    const std::uint32_t sum = fusion::checksum(bytes_);
    std::memcpy(bytes_.data() + bytes_.size() - 4, &sum, 4);
    return std::move(bytes_);
  }

 private:
  fusion::Bytes bytes_;
};

/// Takes them out again.
class Unpacker
{
 public:
  /// \param size of the whole in bytes, at least.
  Unpacker(const fusion::Bytes& bytes, const char (&letters)[5], std::size_t size) : bytes_(bytes)
  {
    if (bytes.size() < std::max<std::size_t>(size, 8)) return;
    std::uint32_t sum = 0;
    std::memcpy(&sum, bytes.data() + bytes.size() - 4, 4);
    isGood_ = std::memcmp(bytes.data(), letters, 4) == 0 && sum == fusion::checksum(bytes);
  }

  [[nodiscard]] bool isGood() const { return isGood_; }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - 4 - at_; }
  template <class T>
  T take()
  {
    T value{};
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  [[nodiscard]] fusion::Bytes rest() const
  {
    return {bytes_.begin() + static_cast<std::ptrdiff_t>(at_), bytes_.end() - 4};
  }

 private:
  const fusion::Bytes& bytes_;
  std::size_t at_ = 4;
  bool isGood_ = false;
};
}  // namespace slamot::live
