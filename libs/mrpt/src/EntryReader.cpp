#include "EntryReader.h"

#include <mrpt/core/exceptions.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>

namespace slamot::mrpt
{
struct EntryReader::Impl
{
  std::string path;
  ::mrpt::io::CFileGZInputStream file;
  std::size_t count = 0;
};

EntryReader::EntryReader(const std::string& path) : impl_(std::make_unique<Impl>())
{
  impl_->path = path;
  if (!impl_->file.open(path))
    throw core::Error(core::ExitStatus::kUnreadable, path, "can't be read", "give a rawlog");
}

EntryReader::~EntryReader() = default;

std::optional<Entry> EntryReader::next()
{
  if (impl_->file.checkEOF()) return std::nullopt;
  auto archive = ::mrpt::serialization::archiveFrom(impl_->file);
  Entry entry;
  entry.path = impl_->path;
  entry.number = impl_->count++;
  try
  {
    entry.object = archive.ReadObject();
  }
  catch (const ::mrpt::serialization::CExceptionEOF&)
  {
    return std::nullopt;
  }
  catch (const std::exception&)
  {
    entry.fail("can't be read", "check the file", core::ExitStatus::kUnreadable);
  }
  if (entry.object) entry.className = entry.object->GetRuntimeClass()->className;
  return entry;
}

double EntryReader::progress() const
{
  const auto size = impl_->file.getTotalBytesCount();
  const auto at = static_cast<double>(impl_->file.getPosition());
  return size == 0 ? 1 : std::min(1.0, at / static_cast<double>(size));
}
}  // namespace slamot::mrpt
