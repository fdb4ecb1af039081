#pragma once

#include "rbpf/Matching.h"

#include <slamot/core/Step.h>
#include <slamot/models/RangeBearing.h>

#include <Eigen/LU>
#include <algorithm>

namespace slamot::test
{
/// The particle filter's map side as plainly as it can be written: every landmark a pair of
/// matrices in a list, every one looked at for every sighting, the whole scan one dense Gaussian.
/// It draws nothing: poses are told to it, so that everything else can be compared number by
/// number.
class ReferenceFilter
{
 public:
  struct Settings
  {
    bool informed, knownIds;
    double inner, outer, newDensity;
  };
  struct Mark
  {
    int id;
    Vector2 x;
    Matrix2 P;
    int sightings;
  };
  struct Particle
  {
    Pose2D pose;  ///< as last sampled
    double logWeight = 0;
    std::vector<Mark> map;
    std::vector<std::int32_t>
        matches;              ///< of the last scan: an index into map, or as in Matching.h
    Gaussian<Pose2D> belief;  ///< before sampling
  };

  ReferenceFilter(const Settings& settings, std::size_t n) : particles(n), settings_(settings) {}

  std::vector<Particle> particles;
  Gaussian<Pose2D> pending;  ///< odometry since poses were last sampled

  /// \param priors the poses before the scan, \param poses those after it.
  void scan(const core::LandmarkScan& scan, const std::vector<Pose2D>& priors,
            const std::vector<Pose2D>& poses)
  {
    for (std::size_t i = 0; i < particles.size(); ++i)
    {
      Particle& p = particles[i];
      const Matrix3 R = math::poseRotation(p.pose.phi);
      p.belief = {priors[i], settings_.informed ? Matrix3(R * pending.cov * R.transpose())
                                                : Matrix3(Matrix3::Zero())};
      match(p, scan);
      weigh(p, scan);
      p.pose = poses[i];
      update(p, scan);
    }
    pending = {};
  }

 private:
  using RangeBearing = models::RangeBearing;
  static constexpr std::int32_t kNew = filters::rbpf::kNew, kRejected = filters::rbpf::kRejected;

  struct Seen  // one sighting of one landmark from a pose
  {
    Seen(const Pose2D& pose, const Mark& m, const core::Sighting& s)
    {
      const Point2D at{m.x[0], m.x[1]};
      nu = RangeBearing::residual({s.range, s.bearing}, RangeBearing::predict(pose, at));
      const auto J = RangeBearing::jacobians(pose, at);
      byPose = J.pose;
      byPoint = J.point;
      R = RangeBearing(s.rangeStd, s.bearingStd).noise();
      S = byPoint * m.P * byPoint.transpose() + R;
    }
    [[nodiscard]] Matrix2 withPose(const Matrix3& P) const
    {
      return S + byPose * P * byPose.transpose();
    }
    Vector2 nu;
    Eigen::Matrix<double, 2, 3> byPose;
    Matrix2 byPoint, R, S;
  };

  void match(Particle& p, const core::LandmarkScan& scan) const
  {
    std::vector<filters::rbpf::Candidate> candidates;
    p.matches.assign(scan.sightings.size(), kNew);
    for (std::size_t j = 0; j < scan.sightings.size(); ++j)
      for (std::size_t k = 0; k < p.map.size(); ++k)
      {
        const core::Sighting& s = scan.sightings[j];
        if (settings_.knownIds && p.map[k].id != s.id) continue;
        const Seen seen(p.belief.mean, p.map[k], s);
        const Matrix2 S = seen.withPose(p.belief.cov);
        const double d2 = seen.nu.dot(S.inverse() * seen.nu);
        if (settings_.knownIds)
          p.matches[j] = d2 <= settings_.outer ? static_cast<std::int32_t>(k) : kRejected;
        else if (d2 <= settings_.outer)
          candidates.push_back({d2 + std::log(S.determinant()), static_cast<std::int32_t>(j),
                                static_cast<std::int32_t>(k), d2 <= settings_.inner});
      }
    if (!settings_.knownIds) filters::rbpf::matchGreedily(candidates, p.matches);
  }

  /// All paired sightings as one vector: its density, and what it tells of the pose.
  void weigh(Particle& p, const core::LandmarkScan& scan) const
  {
    const auto paired =
        std::count_if(p.matches.begin(), p.matches.end(), [](auto m) { return m >= 0; });
    p.logWeight += static_cast<double>(static_cast<long>(p.matches.size()) - paired) *
                   std::log(settings_.newDensity);
    if (paired == 0) return;
    Eigen::VectorXd nu(2 * paired);
    Eigen::MatrixXd H(2 * paired, 3), S = Eigen::MatrixXd::Zero(2 * paired, 2 * paired);
    Eigen::Index at = 0;
    for (std::size_t j = 0; j < p.matches.size(); ++j)
    {
      if (p.matches[j] < 0) continue;
      const Seen seen(p.belief.mean, p.map[static_cast<std::size_t>(p.matches[j])],
                      scan.sightings[j]);
      nu.segment<2>(at) = seen.nu;
      H.middleRows<2>(at) = seen.byPose;
      S.block<2, 2>(at, at) = seen.S;
      at += 2;
    }
    S += H * p.belief.cov * H.transpose();
    const Eigen::MatrixXd K = p.belief.cov * H.transpose() * S.inverse();
    p.logWeight -= 0.5 * (nu.dot(S.inverse() * nu) + std::log(S.determinant())) +
                   static_cast<double>(paired) * std::log(math::kTwoPi);
    const Vector3 shift = K * nu;
    p.belief.mean = {p.belief.mean.x + shift[0], p.belief.mean.y + shift[1],
                     p.belief.mean.phi + shift[2]};
    const Matrix3 P = p.belief.cov - K * H * p.belief.cov;
    p.belief.cov = 0.5 * (P + P.transpose());
  }

  static void update(Particle& p, const core::LandmarkScan& scan)
  {
    for (std::size_t j = 0; j < p.matches.size(); ++j)
    {
      const core::Sighting& s = scan.sightings[j];
      if (p.matches[j] == kRejected) continue;
      if (p.matches[j] == kNew)
      {
        const Vector2 z(s.range, s.bearing);
        const Point2D at = RangeBearing::invert(p.pose, z);
        const Matrix2 J = RangeBearing::invertJacobian(p.pose, z);
        const Matrix2 R = RangeBearing(s.rangeStd, s.bearingStd).noise();
        p.map.push_back({s.id, {at.x, at.y}, J * R * J.transpose(), 1});
        continue;
      }
      Mark& m = p.map[static_cast<std::size_t>(p.matches[j])];
      const Seen seen(p.pose, m, s);
      const Matrix2 K = m.P * seen.byPoint.transpose() * seen.S.inverse();
      const Matrix2 I = Matrix2::Identity() - K * seen.byPoint;
      m.x += K * seen.nu;
      m.P = (I * m.P * I.transpose() + K * seen.R * K.transpose()).eval();
      ++m.sightings;
    }
  }

  Settings settings_;
};
}  // namespace slamot::test
