#include "GzWriter.h"

#include <slamot/core/Error.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <limits>

namespace slamot::mrpt
{
GzWriter::GzWriter(const std::string& path)
    : path_(path), temporary_(path + "." + std::to_string(::getpid()) + ".part")
{
  file_ = ::gzopen(temporary_.c_str(), "wb6");
  if (file_ == nullptr) fail(std::strerror(errno));
}

GzWriter::~GzWriter()
{
  if (file_ == nullptr) return;
  ::gzclose(file_);
  std::remove(temporary_.c_str());
}

void GzWriter::write(const void* data, std::size_t size)
{
  constexpr std::size_t kMost = std::numeric_limits<int>::max();
  if (size == 0) return;
  if (file_ == nullptr || size > kMost ||
      ::gzwrite(file_, data, static_cast<unsigned>(size)) != static_cast<int>(size))
    fail("writing failed");
}

void GzWriter::close()
{
  if (file_ == nullptr) return;
  const int status = ::gzclose(file_);
  file_ = nullptr;
  if (status == Z_OK && std::rename(temporary_.c_str(), path_.c_str()) == 0) return;
  std::remove(temporary_.c_str());
  fail("can't be completed");
}

void GzWriter::fail(const std::string& what) const
{
  throw core::Error(core::ExitStatus::kUnreadable, path_, what,
                    "give a path in a folder that exists, with space left");
}
}  // namespace slamot::mrpt
