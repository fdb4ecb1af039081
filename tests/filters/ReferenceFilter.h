#pragma once

#include "LinearSighting.h"
#include "denseKalman.h"
#include "sighting/Matching.h"

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
  /// The first scan's pose, that scan's only use for its covariance: the map is relative to it.
  Gaussian<Pose2D> frame;
  int near = 0, far = 0;  ///< paired sightings by their coordinates

  /// \param priors the poses before the scan, \param poses those after it.
  void scan(const core::LandmarkScan& scan, const std::vector<Pose2D>& priors,
            const std::vector<Pose2D>& poses)
  {
    if (settings_.informed && !begun_)
    {
      const Matrix3 R = math::poseRotation(particles[0].pose.phi);
      frame = {priors[0], R * pending.cov * R.transpose()};
      pending.cov.setZero();
    }
    begun_ = true;
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

  /// What the frame's uncertainty adds to the covariance of a pose at (x, y): by how much it moves
  /// if the frame is moved and turned about the first scan's place.
  [[nodiscard]] Matrix3 frameCovAt(double x, double y) const
  {
    Matrix3 moved;
    const Pose2D local = math::between(frame.mean, {x, y, 0});
    constexpr double h = 1e-5;
    for (int k = 0; k < 3; ++k)
    {
      Pose2D ahead = frame.mean, behind = frame.mean;
      (k == 0 ? ahead.x : k == 1 ? ahead.y : ahead.phi) += h;
      (k == 0 ? behind.x : k == 1 ? behind.y : behind.phi) -= h;
      const Pose2D to = math::compose(ahead, local), from = math::compose(behind, local);
      moved.col(k) = Vector3(to.x - from.x, to.y - from.y, to.phi - from.phi) / (2 * h);
    }
    return moved * frame.cov * moved.transpose();
  }

 private:
  using RangeBearing = models::RangeBearing;
  static constexpr std::int32_t kNew = filters::kNew, kRejected = filters::kRejected;

  /// One sighting of one landmark from a pose.
  static LinearSighting seen(const Pose2D& pose, const Mark& m, const core::Sighting& s)
  {
    return linearise(pose, {m.x[0], m.x[1]}, m.P, {s.range, s.bearing}, {s.rangeStd, s.bearingStd});
  }

  void match(Particle& p, const core::LandmarkScan& scan) const
  {
    std::vector<filters::Candidate> candidates;
    p.matches.assign(scan.sightings.size(), kNew);
    for (std::size_t j = 0; j < scan.sightings.size(); ++j)
      for (std::size_t k = 0; k < p.map.size(); ++k)
      {
        const core::Sighting& s = scan.sightings[j];
        if (settings_.knownIds && p.map[k].id != s.id) continue;
        const LinearSighting l = seen(p.belief.mean, p.map[k], s);
        const Matrix2 S = l.S(p.map[k].P) + l.byPose * p.belief.cov * l.byPose.transpose();
        const double d2 = l.nu.dot(S.inverse() * l.nu);
        if (settings_.knownIds)
          p.matches[j] = d2 <= settings_.outer ? static_cast<std::int32_t>(k) : kRejected;
        else if (d2 <= settings_.outer)
          candidates.push_back({d2 + std::log(S.determinant()), static_cast<std::int32_t>(j),
                                static_cast<std::int32_t>(k), d2 <= settings_.inner});
      }
    if (!settings_.knownIds) filters::matchGreedily(candidates, p.matches);
  }

  /// All paired sightings as one vector: its density, and what it tells of the pose.
  void weigh(Particle& p, const core::LandmarkScan& scan)
  {
    const auto paired =
        std::count_if(p.matches.begin(), p.matches.end(), [](auto m) { return m >= 0; });
    p.logWeight += static_cast<double>(static_cast<long>(p.matches.size()) - paired) *
                   std::log(settings_.newDensity);
    if (paired == 0) return;
    Eigen::VectorXd nu(2 * paired);
    Eigen::MatrixXd H(2 * paired, 3), R = Eigen::MatrixXd::Zero(2 * paired, 2 * paired);
    Eigen::Index at = 0;
    for (std::size_t j = 0; j < p.matches.size(); ++j)
    {
      if (p.matches[j] < 0) continue;
      const Mark& m = p.map[static_cast<std::size_t>(p.matches[j])];
      const LinearSighting l = seen(p.belief.mean, m, scan.sightings[j]);
      nu.segment<2>(at) = l.nu;
      H.middleRows<2>(at) = l.byPose;
      R.block<2, 2>(at, at) = l.S(m.P);
      at += 2;
      ++(l.near ? near : far);
    }
    const test::DenseUpdate update(p.belief.cov, H, R, nu);
    p.logWeight += update.logDensity;
    const Vector3 shift = test::times(update.gain, nu);
    p.belief.mean = {p.belief.mean.x + shift[0], p.belief.mean.y + shift[1],
                     p.belief.mean.phi + shift[2]};
    const Matrix3 P = update.cov;
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
      const LinearSighting l = seen(p.pose, m, s);
      const Matrix2 K = m.P * l.byPoint.transpose() * l.S(m.P).inverse();
      const Matrix2 I = Matrix2::Identity() - K * l.byPoint;
      m.x += K * l.nu;
      m.P = (I * m.P * I.transpose() + K * l.R * K.transpose()).eval();
      ++m.sightings;
    }
  }

  Settings settings_;
  bool begun_ = false;
};
}  // namespace slamot::test
