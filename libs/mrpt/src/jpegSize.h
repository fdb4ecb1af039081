#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace slamot::mrpt
{
/// Width and height that a JPEG's frame header claims (ITU T.81, B.2.2); none if there is none:
/// then no decoder makes an image of it.
[[nodiscard]] std::optional<std::pair<std::uint32_t, std::uint32_t>> jpegSize(
    const unsigned char* data, std::size_t size);
}  // namespace slamot::mrpt
