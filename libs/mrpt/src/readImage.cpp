#include "readImage.h"

#include "MemoryArchive.h"
#include "jpegSize.h"
#include "objectLayout.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservationImage.h>

#include <opencv2/imgcodecs.hpp>

namespace slamot::mrpt
{
namespace
{
using ::mrpt::img::CImage;
using ::mrpt::obs::CObservationImage;

/// A JPEG of fewer bytes than this part of its pixels is damaged, or made to waste time.
constexpr std::size_t kMostPixelsPerByte = 1000;

cv::Mat decodeJpeg(const unsigned char* bytes, std::uint32_t n)
{
  const auto size = jpegSize(bytes, n);
  if (!size || std::size_t{size->first} * size->second > kMostPixelsPerByte * n) return {};
  try
  {
    return cv::imdecode(cv::Mat(1, static_cast<int>(n), CV_8U, const_cast<unsigned char*>(bytes)),
                        cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  }
  catch (const cv::Exception&)
  {
    return {};
  }
}

cv::Mat decode(ByteCursor& c)
{
  const auto bytes = [&] { return const_cast<unsigned char*>(c.here()); };
  if (c.flag())  // colours
  {
    const auto width = c.read<std::int32_t>(), height = c.read<std::int32_t>();
    if (width < 0 || height < 0) return cv::Mat(-height, -width, CV_8UC3, bytes()).clone();
    const auto n = c.read<std::uint32_t>();
    return decodeJpeg(bytes(), n);
  }
  const auto width = c.read<std::uint32_t>(), height = c.read<std::uint32_t>();
  c.skip(sizeof(std::uint32_t));
  const auto size = c.read<std::uint32_t>();
  c.skip(sizeof(std::uint32_t) + 1);
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  if (pixels == 0 || (size != pixels && size != 2 * pixels)) return {};
  return cv::Mat(static_cast<int>(height), static_cast<int>(width),
                 size == pixels ? CV_8UC1 : CV_16UC1, bytes())
      .clone();
}
}  // namespace

std::shared_ptr<CObservationImage> readImage(const unsigned char* bytes, std::size_t size)
{
  std::vector<unsigned char> copy(bytes, bytes + size);  // which a cursor may mend
  unsigned char* const data = copy.data();
  const PicturePlace place = pictureIn(ByteCursor(data, size));
  // MRPT reads the rest, with an empty picture in the place of this one.
  ::mrpt::io::CMemoryStream memory;
  ::mrpt::serialization::archiveFrom(memory) << CImage();
  const auto* empty = static_cast<const unsigned char*>(memory.getRawBufferData());
  std::vector<unsigned char> rest(data, data + place.begin);
  rest.insert(rest.end(), empty, empty + memory.getTotalBytesCount());
  rest.insert(rest.end(), data + place.end, data + size);
  MemoryArchive archive(rest.data(), rest.size());
  auto out = std::dynamic_pointer_cast<CObservationImage>(archive.ReadObject());
  if (!out || archive.left() != 0) return nullptr;

  ByteCursor picture(data, size, place.begin);
  (void)readHeader(picture);
  if (!picture.flag()) return out;
  std::string name(picture.count(1u << 20, 1, "bytes of a file's name"), '\0');
  std::memcpy(name.data(), picture.here(), name.size());
  out->image.setExternalStorage(name);
  return out;
}

cv::Mat decodePicture(const unsigned char* bytes, std::size_t size)
{
  std::vector<unsigned char> copy(bytes, bytes + size);  // which a cursor may mend
  ByteCursor picture(copy.data(), size);
  (void)readHeader(picture);
  if (picture.flag()) return {};
  return decode(picture);
}
}  // namespace slamot::mrpt
