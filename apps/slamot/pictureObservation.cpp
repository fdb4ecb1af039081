#include "pictureObservation.h"

#include <mrpt/obs/CObservationImage.h>
#include <slamot/core/Error.h>
#include <slamot/mrpt/timestamp.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

namespace slamot::apps
{
namespace
{
constexpr const char* kLabel = "CAMERA";

void save(const cv::Mat& pixels, const std::filesystem::path& path)
{
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error || !cv::imwrite(path.string(), pixels))
    throw core::Error(core::ExitStatus::kUnreadable, path.string(), "can't be written",
                      "choose another place with --output");
}
}  // namespace

std::shared_ptr<::mrpt::obs::CObservation> pictureObservation(const sim::Picture& picture,
                                                              const sim::CameraSetup& camera,
                                                              double time,
                                                              const ImagesBeside* beside)
{
  const cv::Mat pixels(picture.height, picture.width, CV_8UC3,
                       const_cast<std::uint8_t*>(picture.bgr.data()));
  auto out = std::make_shared<::mrpt::obs::CObservationImage>();
  out->timestamp = mrpt::toTimestamp(time);
  out->sensorLabel = kLabel;
  // MRPT's cameras have z ahead, x to the right and y down.
  out->cameraPose = ::mrpt::poses::CPose3D(
      camera.x, camera.y, camera.z, math::wrapToPi(camera.yaw - math::kPi / 2), 0, -math::kPi / 2);
  auto& lens = out->cameraParams;
  lens.ncols = static_cast<std::uint32_t>(camera.width);
  lens.nrows = static_cast<std::uint32_t>(camera.height);
  lens.setIntrinsicParamsFromValues(camera.focal, camera.focal, 0.5 * (camera.width - 1),
                                    0.5 * (camera.height - 1));
  if (beside != nullptr)
  {
    const std::string name = ImagesBeside::nameOf(time);
    save(pixels, beside->pathOf(name));
    out->image.setExternalStorage(name);
    return out;
  }
  ::mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(
      false);  // pixels as they are take ten times as much
  ::mrpt::img::CImage::SERIALIZATION_JPEG_QUALITY(95);
  out->image = ::mrpt::img::CImage(pixels, ::mrpt::img::DEEP_COPY);
  return out;
}
}  // namespace slamot::apps
