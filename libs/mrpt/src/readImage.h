#pragma once

#include <cstddef>
#include <memory>

namespace mrpt::obs
{
class CObservationImage;
}

namespace slamot::mrpt
{
/// An image from its bytes in a log, walked over before.  OpenCV decodes it: MRPT's own JPEG reader
/// ends the process where one is damaged.  A picture that can't be decoded is left empty.
[[nodiscard]] std::shared_ptr<::mrpt::obs::CObservationImage> readImage(const unsigned char* data,
                                                                        std::size_t size);
}  // namespace slamot::mrpt
