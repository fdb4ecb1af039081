#pragma once

#include "Engine.h"

namespace slamot::filters::ekf
{
/// Several EKFs that differ by what their landmark sightings were of, each as likely as what it
/// explains: a multi-hypothesis tracker (Reid 1979) whose landmarks exist with a probability, as in
/// a Poisson multi-Bernoulli mixture (Garcia-Fernandez, Williams, Granstrom, Svensson 2018) with
/// the robot's pose in the same Gaussian (EK-PMBM SLAM: Ge et al. 2022).  The Poisson part, of
/// landmarks not yet seen, is uniform and stays so.  What the likeliest believes is the estimate.
class Hypotheses : public EkfSlamot::Engine
{
 public:
  Hypotheses(const Settings& settings, std::unique_ptr<Hypothesis> first);

  core::Update process(int robot, const core::Step& step) override;
  [[nodiscard]] core::Estimate estimate(int robot) const override { return best().estimate(robot); }
  [[nodiscard]] core::RobotAndTarget robotAndTarget(int target) const override
  {
    return best().robotAndTarget(target);
  }
  core::Fusion fuse(const core::Evidence& evidence, const core::FusionOptions& options) override;
  /// The likeliest one.  \throws core::Error (kNonsense) once an estimate has overflowed.
  [[nodiscard]] Hypothesis& best() const;
  /// How likely each hypothesis is, likeliest first; the sum is 1.
  [[nodiscard]] std::vector<double> weights() const;
  void predictTarget(core::RobotAndTarget& other, double dt) const override
  {
    best().predictTarget(other, dt);
  }

 private:
  struct Weighted
  {
    std::unique_ptr<Hypothesis> filter;
    double logWeight;
    std::vector<core::Pairing> pairings;  // of this scan's landmark sightings
    int close = 0;                        // of them: taken in the frame of their rays
  };
  using List = std::vector<Weighted>;
  /// What one hypothesis becomes with a scan.
  List branch(Weighted&& parent, int robot, const core::LandmarkScan& scan, double time) const;
  void takeUndoubted(Weighted& of, int robot, const std::vector<Ray>& rays, double time,
                     std::vector<std::size_t>& open) const;
  void takeOne(Weighted& of, int robot, const Ray& ray, std::size_t k, const Map::Alternative& as,
               double time) const;
  [[nodiscard]] List split(List&& of, int robot, const Ray& ray, std::size_t k, double time) const;

  [[nodiscard]] List likeliestOf(List list) const;

  Settings settings_;
  List list_;  // likeliest first
};
}  // namespace slamot::filters::ekf
