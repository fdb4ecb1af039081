#pragma once

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <zlib.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace slamot::tests
{
/// A file's bytes, unpacked if they are gz.
inline std::string unpackedBytes(const std::string& path)
{
  std::string out;
  const gzFile file = ::gzopen(path.c_str(), "rb");
  char buffer[4096];
  for (int n; (n = ::gzread(file, buffer, sizeof buffer)) > 0;)
    out.append(buffer, static_cast<std::size_t>(n));
  ::gzclose(file);
  return out;
}

inline std::string rawBytes(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

inline void saveBytes(const std::string& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

inline void savePacked(const std::string& path, const std::string& bytes)
{
  const gzFile file = ::gzopen(path.c_str(), "wb6");
  const int n = ::gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  if (::gzclose(file) != Z_OK || n != static_cast<int>(bytes.size()))
    throw std::runtime_error("can't write " + path);
}

/// What MRPT writes for an object.
inline std::string serialized(const ::mrpt::serialization::CSerializable& object)
{
  ::mrpt::io::CMemoryStream memory;
  auto archive = ::mrpt::serialization::archiveFrom(memory);
  archive << object;
  return {static_cast<const char*>(memory.getRawBufferData()), memory.getTotalBytesCount()};
}
}  // namespace slamot::tests
