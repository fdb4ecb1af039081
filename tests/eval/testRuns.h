#pragma once

#include <slamot/eval/Record.h>
#include <slamot/eval/Truth.h>

namespace slamot::eval
{
inline Gaussian<Pose2D> gaussian(const Pose2D& mean, double stdXy, double stdTheta)
{
  Gaussian<Pose2D> out;
  out.mean = mean;
  out.cov = Vector3(stdXy * stdXy, stdXy * stdXy, stdTheta * stdTheta).asDiagonal();
  return out;
}

/// A truth on an arc, one pose a second, and a record of it with no error, deviations 0.1 m and
/// 0.1 rad.
struct PerfectRun
{
  Truth truth;
  Record record;

  explicit PerfectRun(int count)
  {
    for (int i = 0; i < count; ++i)
    {
      const Pose2D pose(std::sin(0.2 * i) * 5, 5 - std::cos(0.2 * i) * 5, 0.2 * i);
      truth.robot.poses.push_back({double(i), pose, true});
      RobotRow row;
      row.time = i;
      row.robot = gaussian(pose, 0.1, 0.1);
      record.rows.push_back(row);
    }
  }

  /// Turns and moves what is estimated, covariances included, as a wrong start would.
  void moveMap(const Pose2D& by)
  {
    const Matrix3 R = math::poseRotation(by.phi);
    const auto move = [&](Gaussian<Pose2D>& g)
    {
      g.mean = math::compose(by, g.mean);
      g.cov = R * g.cov * R.transpose();
    };
    for (RobotRow& row : record.rows) move(row.robot);
    for (TargetTrack& track : record.targets)
      for (TargetRow& row : track.rows) move(row.pose);
    for (auto& m : record.landmarks)
    {
      m.position.mean = math::transform(by, m.position.mean);
      const Matrix2 R2 = R.topLeftCorner<2, 2>();
      m.position.cov = R2 * m.position.cov * R2.transpose();
    }
  }
};
}  // namespace slamot::eval
