#pragma once

#include <cstddef>
#include <memory>

namespace cv
{
class Mat;
}
namespace mrpt::obs
{
class CObservationImage;
}

namespace slamot::mrpt
{
/// An image from its bytes in a log, walked over before, without its pixels: only the name of its
/// file, if it is in one.  \throws std::exception where MRPT refuses the rest.
[[nodiscard]] std::shared_ptr<::mrpt::obs::CObservationImage> readImage(const unsigned char* data,
                                                                        std::size_t size);

/// The pixels of a picture (CImage) whose bytes begin here, walked over before.  OpenCV decodes it:
/// MRPT's own JPEG reader ends the process where one is damaged.  Empty if it can't be decoded.
[[nodiscard]] cv::Mat decodePicture(const unsigned char* bytes, std::size_t size);
}  // namespace slamot::mrpt
