#include "cameraOf.h"

#include <mrpt/obs/CObservationImage.h>

#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

namespace slamot::apps
{
namespace
{
/// Columns: ahead, left, up in the axes of a lens (z ahead, x right, y down).
const Matrix3 kLens = (Matrix3() << 0, -1, 0, 0, 0, -1, 1, 0, 0).finished();
}  // namespace

cv::Mat pixelsOf(const mrpt::EditedEntry& entry, const mrpt::SensedEntry& sensed,
                 const std::string& folder)
{
  const auto& image =
      dynamic_cast<const ::mrpt::obs::CObservationImage&>(*sensed.observation).image;
  if (!image.isExternallyStored())
  {
    cv::Mat out = entry.picture(sensed);
    if (out.empty()) throw NoImage("an empty image, or a damaged one");
    return out;
  }
  const auto path = std::filesystem::path(folder) / image.getExternalStorageFile();
  cv::Mat out;
  try
  {
    out = cv::imread(path.string(), cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  }
  catch (const cv::Exception&)
  {
    // of a size that makes no sense
  }
  if (out.empty()) throw NoImage(path.string() + " is missing or damaged");
  return out;
}

perception::Camera cameraOf(const ::mrpt::obs::CObservationImage& observation,
                            const perception::Camera& otherwise)
{
  const auto& p = observation.cameraParams;
  if (!(p.fx() > 0) && otherwise.fx > 0) return otherwise;
  perception::Camera out;
  out.width = static_cast<int>(p.ncols);
  out.height = static_cast<int>(p.nrows);
  out.fx = p.fx(), out.fy = p.fy(), out.cx = p.cx(), out.cy = p.cy();
  using Model = ::mrpt::img::DistortionModel;
  if (p.distortion == Model::kannala_brandt) out.lens = perception::Camera::Lens::kFisheye;
  if (p.distortion != Model::none)
    for (std::size_t i = 0; i < out.distortion.size(); ++i) out.distortion[i] = p.dist[i];
  if (out.lens == perception::Camera::Lens::kFisheye)  // MRPT keeps k3, k4 behind p1, p2
    out.distortion = {p.k1(), p.k2(), p.k3(), p.k4(), 0, 0, 0, 0};
  return out;
}

perception::Mount mountOf(const ::mrpt::poses::CPose3D& pose_robot_camera)
{
  const Matrix3 r = pose_robot_camera.getRotationMatrix().asEigen();
  perception::Mount out;
  out.place = {pose_robot_camera.x(), pose_robot_camera.y(), pose_robot_camera.z()};
  if (!out.place.allFinite() || !r.allFinite() ||
      (r * r.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff() > 1e-3)
    throw NoImage("the camera's pose makes no sense");
  const bool isLens = std::abs(r(2, 1)) > std::abs(r(2, 2));
  out.rotation = isLens ? Matrix3(r * kLens) : r;
  return out;
}
}  // namespace slamot::apps
