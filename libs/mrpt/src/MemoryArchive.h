#pragma once

#include <mrpt/serialization/CArchive.h>

#include <cstring>
#include <stdexcept>

namespace slamot::mrpt
{
/// Bytes in memory as MRPT's parser reads them.  Reading beyond them throws; MRPT's own streams
/// come back short there, and its parser goes on with fields that were never set.
class MemoryArchive : public ::mrpt::serialization::CArchive
{
 public:
  MemoryArchive(const unsigned char* data, std::size_t size) : data_(data), left_(size) {}
  [[nodiscard]] std::size_t left() const { return left_; }

 protected:
  std::size_t read(void* to, std::size_t size) override
  {
    if (size > left_) throw std::runtime_error("read beyond the object's end");
    std::memcpy(to, data_, size);
    data_ += size;
    left_ -= size;
    return size;
  }
  std::size_t write(const void*, std::size_t) override
  {
    throw std::logic_error("this archive is for reading");
  }

 private:
  const unsigned char* data_;
  std::size_t left_;
};
}  // namespace slamot::mrpt
