#include <slamot/mrpt/RawlogEditor.h>

#include "EntryReader.h"
#include "GzWriter.h"
#include "readImage.h"
#include "readMotion.h"
#include "readObservation.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/serialization/CArchive.h>

#include <cstring>
#include <filesystem>
#include <opencv2/core.hpp>

namespace slamot::mrpt
{
using ::mrpt::obs::CObservation;

namespace
{
const std::string& distinct(const std::string& from, const std::string& to)
{
  std::error_code error;
  if (std::filesystem::equivalent(from, to, error))
    throw core::Error(core::ExitStatus::kUnreadable, to, "is the log that is read",
                      "choose another name with --output");
  return to;
}

std::vector<unsigned char> bytesOf(const CObservation& observation)
{
  ::mrpt::io::CMemoryStream memory;
  auto archive = ::mrpt::serialization::archiveFrom(memory);
  archive << observation;
  const auto* first = static_cast<const unsigned char*>(memory.getRawBufferData());
  return {first, first + memory.getTotalBytesCount()};
}
}  // namespace

struct RawlogEditor::Impl
{
  Impl(const std::string& from, const std::string& to)
      : reader(from, EntryReader::For::kEditing), writer(distinct(from, to))
  {
  }
  EntryReader reader;
  GzWriter writer;
};

RawlogEditor::RawlogEditor(const std::string& from, const std::string& to)
    : impl_(std::make_unique<Impl>(from, to))
{
}
RawlogEditor::~RawlogEditor() = default;

std::optional<EditedEntry> RawlogEditor::next()
{
  auto entry = impl_->reader.next();
  if (!entry) return std::nullopt;
  EditedEntry out;
  out.isFrame_ = entry->kind == Entry::Kind::kFrame;
  out.mayTakeObservations = out.isFrame_ || entry->kind == Entry::Kind::kObservation;
  out.countAt_ = entry->countAt;
  if (entry->kind == Entry::Kind::kActions)
  {
    if (const auto movement = movementAmong(*entry))
      out.increment = incrementOf(*movement, *entry).mean;
  }
  else
    for (const Entry::Part& part : entry->parts)
    {
      const auto observation = std::dynamic_pointer_cast<const CObservation>(part.object);
      // A comment's time is that of its writing.
      if (!observation ||
          std::dynamic_pointer_cast<const ::mrpt::obs::CObservationComment>(observation))
        continue;
      SensedEntry& sensed = out.sensed.emplace_back();
      sensed.observation = observation;
      sensed.pictureAt = part.pictureAt;
      if (const auto* o =
              dynamic_cast<const ::mrpt::obs::CObservation2DRangeScan*>(observation.get()))
        sensed.laser = laserScanOf(*o, *entry);
    }
  out.bytes_ = std::move(entry->bytes);
  return out;
}

cv::Mat EditedEntry::picture(const SensedEntry& image) const
{
  if (image.pictureAt == 0) return {};
  return decodePicture(bytes_.data() + image.pictureAt, bytes_.size() - image.pictureAt);
}

void RawlogEditor::write(const EditedEntry& entry,
                         const std::vector<std::shared_ptr<CObservation>>& added)
{
  std::vector<unsigned char> bytes = entry.bytes_;
  if (entry.isFrame_ && !added.empty())
  {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + entry.countAt_, sizeof count);
    count += static_cast<std::uint32_t>(added.size());
    std::memcpy(bytes.data() + entry.countAt_, &count, sizeof count);
    bytes.pop_back();  // the frame's end flag
  }
  for (const auto& observation : added)
  {
    const auto more = bytesOf(*observation);
    bytes.insert(bytes.end(), more.begin(), more.end());
  }
  if (entry.isFrame_ && !added.empty()) bytes.push_back(kEndFlag);
  impl_->writer.write(bytes.data(), bytes.size());
}

void RawlogEditor::close()
{
  impl_->writer.close();
}

double RawlogEditor::progress() const
{
  return impl_->reader.progress();
}

std::string RawlogEditor::imagesFolder(const std::string& log)
{
  return (std::filesystem::path(log).replace_extension().string()) + "_Images";
}
}  // namespace slamot::mrpt
