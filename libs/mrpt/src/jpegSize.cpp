#include "jpegSize.h"

namespace slamot::mrpt
{
namespace
{
constexpr unsigned kMarker = 0xff, kFirstFrame = 0xc0, kLastFrame = 0xcf, kScan = 0xda;

// Of the same range, but tables.
bool isFrame(unsigned marker)
{
  return marker >= kFirstFrame && marker <= kLastFrame && marker != 0xc4 && marker != 0xc8 &&
         marker != 0xcc;
}
bool hasNoLength(unsigned marker)
{
  return marker == 0x01 || (marker >= 0xd0 && marker <= 0xd9);
}
}  // namespace

std::optional<std::pair<std::uint32_t, std::uint32_t>> jpegSize(const unsigned char* data,
                                                                std::size_t size)
{
  const auto word = [&](std::size_t i) -> std::uint32_t { return data[i] * 256u + data[i + 1]; };
  // Decoders go by the first bytes: others would be of another kind, whatever they hold.
  if (size < 3 || data[0] != 0xff || data[1] != 0xd8 || data[2] != 0xff) return std::nullopt;
  for (std::size_t i = 2; i + 1 < size;)
  {
    if (data[i] != kMarker || data[i + 1] == kMarker)  // decoders skip what lies between segments
    {
      ++i;
      continue;
    }
    const unsigned marker = data[i + 1];
    i += 2;
    if (hasNoLength(marker) || marker == 0) continue;
    if (marker == kScan || i + 7 >= size) return std::nullopt;
    if (isFrame(marker)) return std::pair{word(i + 5), word(i + 3)};
    i += word(i);
  }
  return std::nullopt;
}
}  // namespace slamot::mrpt
