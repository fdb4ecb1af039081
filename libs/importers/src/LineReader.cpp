#include <slamot/core/Error.h>
#include <slamot/importers/LineReader.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace slamot::importers
{
namespace
{
namespace fs = std::filesystem;
using core::ExitStatus;

constexpr std::size_t kChunk = std::size_t{1} << 16;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
}  // namespace

LineReader::LineReader(std::string path) : path_(std::move(path)), file_(nullptr, gzclose)
{
  std::error_code error;
  if (fs::is_directory(path_, error))
    throw core::Error(ExitStatus::kUnreadable, path_, "is a folder", "give a text file");
  errno = 0;
  file_.reset(gzopen(path_.c_str(), "rb"));
  if (!file_)
    throw core::Error(ExitStatus::kUnreadable, path_,
                      std::string("can't be read: ") + std::strerror(errno ? errno : ENOMEM),
                      "check the name and the rights");
  size_ = fs::file_size(path_, error);
  if (error) size_ = 0;
  fill();
  const std::string_view start(buffer_.data(), end_);
  if (start.substr(0, kByteOrderMark.size()) == kByteOrderMark) begin_ = kByteOrderMark.size();
}

bool LineReader::fill()
{
  if (end_ > begin_) std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (end_ > kLongestLine || bytes_ > kMostBytes)
    throw core::Error(
        ExitStatus::kLimit, path_ + " line " + std::to_string(number_ + 1),
        end_ > kLongestLine ? "the line is over 1 MiB" : "the file is over 4 GiB of text",
        "split it");
  buffer_.resize(end_ + kChunk);
  const int got = gzread(file_.get(), buffer_.data() + end_, kChunk);
  int code = Z_OK;
  const char* reason = gzerror(file_.get(), &code);
  // zlib tells a gz file cut short only by this code, after it has handed out the intact part.
  if (code == Z_BUF_ERROR)
    throw core::Error(ExitStatus::kTruncated, path_, "the compressed file ends early",
                      "copy it again");
  if (got < 0 || code != Z_OK)
    throw core::Error(ExitStatus::kUnreadable, path_, std::string("can't be read: ") + reason,
                      "copy it again");
  end_ += static_cast<std::size_t>(got);
  bytes_ += static_cast<std::uint64_t>(got);
  return got > 0;
}

std::optional<std::string_view> LineReader::next()
{
  std::size_t searched = begin_;
  const void* newline = nullptr;
  while (!(newline = end_ > searched ? std::memchr(buffer_.data() + searched, '\n', end_ - searched)
                                     : nullptr))
  {
    searched = end_ - begin_;
    if (!fill()) break;
  }
  if (!newline && begin_ == end_) return std::nullopt;
  const char* first = buffer_.data() + begin_;
  const char* last = newline ? static_cast<const char*>(newline) : buffer_.data() + end_;
  begin_ = static_cast<std::size_t>(last - buffer_.data()) + (newline ? 1 : 0);
  ++number_;
  if (last > first && last[-1] == '\r') --last;
  return std::string_view(first, static_cast<std::size_t>(last - first));
}

double LineReader::progress() const
{
  const auto offset = gzoffset(file_.get());
  return size_ && offset > 0 ? static_cast<double>(offset) / static_cast<double>(size_) : 0;
}

std::string plainOrGz(const std::string& path)
{
  std::error_code error;
  if (fs::exists(path, error)) return path;
  if (fs::exists(path + ".gz", error)) return path + ".gz";
  return {};
}
}  // namespace slamot::importers
