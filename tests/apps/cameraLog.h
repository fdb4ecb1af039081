#pragma once

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>
#include <slamot/mrpt/timestamp.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include <slamot/perception/Camera.h>
#include "../perception/castScans.h"
#include "../perception/drawnScenes.h"

// A drive past posts behind an orange target, with laser and camera, as a log of MRPT's own
// classes.
namespace slamot::test
{
using perception::test::Circle;

struct CameraLogOptions
{
  bool frames = false;        ///< pairs of actions and frames; else observations only
  bool filesBeside = false;   ///< images in <log>_Images
  bool jpeg = true;           ///< of images in the log
  double cameraDelay = 0.06;  ///< after the scan [s]
  int steps = 40;
  bool comments = false;          ///< one at each step, as of the day of its writing
  bool odometryInFrames = false;  ///< beside the actions, the same again
  int jumpBackAt = -1;            ///< from this step on the clock is 5 s behind
};

class CameraLog
{
 public:
  static constexpr double kSpeed = 0.5, kPeriod = 0.2, kStart = 100;  // [m/s, s, s]

  [[nodiscard]] static Pose2D robotAt(double time)
  {
    const double t = time - kStart;
    return {kSpeed * t, 0.02 * t * t / 2, 0.04 * t};
  }
  [[nodiscard]] static Circle targetAt(double time)
  {
    const double t = time - kStart;
    return {{3 + 0.6 * t, 0.4 * std::sin(0.8 * t)}, 0.2};
  }
  [[nodiscard]] static std::vector<Circle> posts()
  {
    std::vector<Circle> out;
    for (int i = 0; i < 6; ++i)
    {
      out.push_back({{1.5 + 2.0 * i, 2.0}, 0.1});
      out.push_back({{2.5 + 2.0 * i, -2.0}, 0.1});
    }
    return out;
  }
  [[nodiscard]] static perception::Camera camera()
  {
    perception::Camera c;
    c.width = 640, c.height = 480;
    c.fx = c.fy = 500, c.cx = 319.5, c.cy = 239.5;
    return c;
  }

  static void write(const std::string& path, const CameraLogOptions& options = {})
  {
    ::mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(!options.jpeg);
    ::mrpt::io::CFileGZOutputStream file(path);
    auto archive = ::mrpt::serialization::archiveFrom(file);
    Pose2D last = robotAt(kStart);
    for (int i = 0; i < options.steps; ++i)
    {
      const double jump = options.jumpBackAt >= 0 && i >= options.jumpBackAt ? -5 : 0;
      const double time = kStart + kPeriod * i + jump;
      if (options.comments)
      {
        ::mrpt::obs::CObservationComment comment;
        comment.timestamp = mrpt::toTimestamp(1.7e9 + i);
        comment.text = "seen by hand";
        archive << comment;
      }
      const double looked = time + (options.frames ? 0 : options.cameraDelay);
      const auto laser = scan(time, static_cast<std::uint64_t>(i));
      const auto image = picture(looked, i, path, options);
      if (options.frames)
      {
        ::mrpt::obs::CActionCollection actions;
        ::mrpt::obs::CActionRobotMovement2D movement;
        movement.computeFromOdometry(::mrpt::poses::CPose2D(math::between(last, robotAt(time))),
                                     {});
        movement.timestamp = mrpt::toTimestamp(time);
        actions.insert(movement);
        last = robotAt(time);
        ::mrpt::obs::CSensoryFrame frame;
        frame.insert(laser);
        frame.insert(image);
        if (options.odometryInFrames)
          frame.insert(std::make_shared<::mrpt::obs::CObservationOdometry>(odometry(time)));
        archive << actions;
        if (options.comments)
        {
          ::mrpt::obs::CObservationComment comment;
          comment.timestamp = mrpt::toTimestamp(1.7e9);
          archive << comment;
        }
        archive << frame;
        continue;
      }
      archive << odometry(time) << *laser << *image << odometry(time + 0.1);
    }
  }

 private:
  static ::mrpt::obs::CObservationOdometry odometry(double time)
  {
    ::mrpt::obs::CObservationOdometry out;
    out.timestamp = mrpt::toTimestamp(time);
    out.sensorLabel = "ODOMETRY";
    out.odometry = ::mrpt::poses::CPose2D(robotAt(time));
    return out;
  }
  static std::shared_ptr<::mrpt::obs::CObservation2DRangeScan> scan(double time, std::uint64_t seed)
  {
    perception::test::World world;
    const Pose2D robot = robotAt(time);
    const auto add = [&](Circle c)
    {
      const Pose2D at = math::between(robot, {c.at.x, c.at.y, 0});
      world.circles.push_back({{at.x, at.y}, c.radius});
    };
    for (const Circle& c : posts()) add(c);
    add(targetAt(time));
    const core::LaserScan cast = perception::test::scanOf(world, {}, seed);
    auto out = std::make_shared<::mrpt::obs::CObservation2DRangeScan>();
    out->timestamp = mrpt::toTimestamp(time);
    out->sensorLabel = "LASER";
    out->sensorPose = ::mrpt::poses::CPose3D(0.1, 0, 0.3, 0, 0, 0);
    out->aperture = static_cast<float>(math::kPi);
    out->rightToLeft = true;
    out->maxRange = 30;
    out->resizeScan(cast.ranges.size());
    for (std::size_t i = 0; i < cast.ranges.size(); ++i)
    {
      const bool hit = std::isfinite(cast.ranges[i]);
      out->setScanRange(i, hit ? cast.ranges[i] : 30.0f);
      out->setScanRangeValidity(i, hit);
    }
    return out;
  }

  /// Upright cylinders from the floor to a height, the farthest first.
  static cv::Mat drawn(double time)
  {
    struct Thing
    {
      Circle circle;
      double height, distance;
      cv::Scalar color;
    };
    cv::Mat image = perception::test::background();
    const Pose2D robot = robotAt(time);
    std::vector<Thing> things;
    const auto add = [&](const Circle& c, double height, const cv::Scalar& color)
    {
      const Pose2D at = math::between(robot, {c.at.x, c.at.y, 0});
      const double x = at.x - 0.15;
      things.push_back({{{x, at.y}, c.radius}, height, std::hypot(x, at.y), color});
    };
    for (const Circle& c : posts()) add(c, 1.2, perception::test::color(60, 0.1, 0.3));
    add(targetAt(time), 0.6, perception::test::color(25, 0.9, 0.8));
    std::sort(things.begin(), things.end(),
              [](const Thing& a, const Thing& b) { return a.distance > b.distance; });
    const perception::Camera c = camera();
    for (const Thing& t : things)
    {
      if (t.circle.at.x < 0.3) continue;
      const double middle = std::atan2(t.circle.at.y, t.circle.at.x);
      const double half = std::asin(t.circle.radius / t.distance);
      const auto left = c.pixel({middle + half, 0}), right = c.pixel({middle - half, 0});
      const auto row = [&](double z) { return c.cy + c.fy * (0.5 - z) / t.circle.at.x; };
      cv::rectangle(image, cv::Point(cvRound(left.x), cvRound(row(t.height))),
                    cv::Point(cvRound(right.x), cvRound(row(0))), t.color, cv::FILLED);
    }
    perception::test::addNoise(image, 4, static_cast<std::uint64_t>(1000 * time));
    return image;
  }

  static std::shared_ptr<::mrpt::obs::CObservationImage> picture(double time, int i,
                                                                 const std::string& path,
                                                                 const CameraLogOptions& options)
  {
    const cv::Mat pixels = drawn(time);
    auto out = std::make_shared<::mrpt::obs::CObservationImage>();
    out->timestamp = mrpt::toTimestamp(time);
    out->sensorLabel = "CAMERA";
    // MRPT's cameras: z ahead, x right, y down.
    out->cameraPose = ::mrpt::poses::CPose3D(0.15, 0, 0.5, -math::kPi / 2, 0, -math::kPi / 2);
    out->cameraParams.ncols = 640, out->cameraParams.nrows = 480;
    const perception::Camera c = camera();
    out->cameraParams.setIntrinsicParamsFromValues(c.fx, c.fy, c.cx, c.cy);
    if (options.filesBeside)
    {
      const std::string folder = path.substr(0, path.size() - 7) + "_Images";
      std::filesystem::create_directories(folder);
      const std::string name = "camera_" + std::to_string(i) + ".png";
      cv::imwrite(folder + "/" + name, pixels);
      out->image.setExternalStorage(name);
    }
    else
      out->image = ::mrpt::img::CImage(pixels, ::mrpt::img::DEEP_COPY);
    return out;
  }
};
}  // namespace slamot::test
