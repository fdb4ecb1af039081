#include <slamot/core/Error.h>
#include <slamot/mrpt/RawlogInfo.h>
#include <slamot/mrpt/RawlogSource.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <string>

namespace
{
using slamot::mrpt::RawlogSource;

/// Bytes as a file that is not on a disk.
class MemoryFile
{
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size) : fd_(::memfd_create("rawlog", 0))
  {
    ok_ = fd_ >= 0 && ::write(fd_, data, size) == static_cast<ssize_t>(size);
  }
  ~MemoryFile() { ::close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(fd_); }

 private:
  int fd_;
  bool ok_ = false;
};

void readAll(const std::string& path, const RawlogSource::Options& options)
{
  try
  {
    RawlogSource source(path, options);
    while (source.next())
    {
    }
  }
  catch (const slamot::core::Error& e)
  {
    if (e.status() == slamot::core::ExitStatus::kInternal) __builtin_trap();
  }
}
}  // namespace

/// Whatever the bytes: a core::Error of another kind than "internal", or steps.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const MemoryFile file(data, size);
  if (!file.ok()) return 0;
  RawlogSource::Options options;
  readAll(file.path(), options);
  options.salvage = true;
  options.sensor = {0.1, 0.01};
  options.odometry.fromLog = false;
  options.odometry.vStd = options.odometry.omegaStd = 0.1;
  readAll(file.path(), options);
  (void)slamot::mrpt::inspectRawlog(file.path());
  return 0;
}
