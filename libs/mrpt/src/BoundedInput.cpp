#include "BoundedInput.h"

#include <slamot/core/Error.h>
#include <sys/stat.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <limits>
#include <vector>

namespace slamot::mrpt
{
using core::Error;
using core::ExitStatus;

namespace
{
constexpr std::uint64_t kSizeOfBudget = 50u << 20;  // [byte] that kMostSeconds are for

double cpuSeconds()
{
  timespec t{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
}  // namespace

BoundedInput::Working::Working(BoundedInput& input) : input_(input)
{
  input_.workingSince_ = cpuSeconds();
}
BoundedInput::Working::~Working()
{
  input_.spentSeconds_ += cpuSeconds() - input_.workingSince_;
}

BoundedInput::BoundedInput(const std::string& path) : path_(path)
{
  struct stat info = {};
  if (::stat(path.c_str(), &info) != 0)
    throw Error(ExitStatus::kUnreadable, path, std::strerror(errno), "give the path of a rawlog");
  if (!S_ISREG(info.st_mode))
    throw Error(ExitStatus::kUnreadable, path,
                S_ISDIR(info.st_mode) ? "is a folder" : "is not a regular file",
                "give the path of a rawlog");
  if (info.st_size == 0)
    throw Error(ExitStatus::kUnreadable, path, "is empty", "give the path of a rawlog");
  size_ = static_cast<std::uint64_t>(info.st_size);
  file_ = ::gzopen(path.c_str(), "rb");
  if (file_ == nullptr)
    throw Error(ExitStatus::kUnreadable, path, std::strerror(errno), "give the path of a rawlog");
  ::gzbuffer(file_, 1u << 17);
}

BoundedInput::~BoundedInput()
{
  if (file_ != nullptr) ::gzclose(file_);
}

std::size_t BoundedInput::read(unsigned char* to, std::size_t size)
{
  constexpr std::size_t kChunk = 1u << 20;  // how often the limits are looked at
  std::size_t got = 0;
  while (got < size)
  {
    checkLimits();
    const auto wanted = static_cast<unsigned>(std::min(kChunk, size - got));
    const int n = ::gzread(file_, to + got, wanted);
    int status = Z_OK;
    const char* message = ::gzerror(file_, &status);
    if (status == Z_BUF_ERROR)
      truncated_ = true;
    else if (n < 0 || status != Z_OK)
      throw Error(ExitStatus::kUnreadable,
                  path_ + ", byte " + std::to_string(::gzoffset(file_)) + " of the gz file",
                  std::string("damaged (") + message + ")", "fetch or record the file anew");
    if (n <= 0) break;
    got += static_cast<std::size_t>(n);
    unpacked_ += static_cast<std::size_t>(n);
    if (static_cast<unsigned>(n) < wanted) break;
  }
  return got;
}

bool BoundedInput::packed() const
{
  return ::gzdirect(file_) == 0;
}

void BoundedInput::drain()
{
  std::vector<unsigned char> rest(1u << 20);
  while (read(rest.data(), rest.size()) == rest.size())
  {
  }
}

double BoundedInput::progress() const
{
  return std::min(1.0, static_cast<double>(::gzoffset(file_)) / static_cast<double>(size_));
}

void BoundedInput::checkLimits() const
{
  if (unpacked_ > kMostUnpacked + kMostUnpackedRatio * size_)
    throw Error(ExitStatus::kLimit, path_,
                "unpacks to over " + std::to_string(unpacked_ >> 20) + " MB, far beyond its size",
                "unpack it with gunzip first, if it is sound");
  const double share = static_cast<double>(size_) / static_cast<double>(kSizeOfBudget);
  if (spentSeconds_ + cpuSeconds() - workingSince_ > kMostSeconds * std::max(1.0, share))
    throw Error(ExitStatus::kLimit, path_, "takes too long to read",
                "split it with rawlog-edit --cut");
}
}  // namespace slamot::mrpt
