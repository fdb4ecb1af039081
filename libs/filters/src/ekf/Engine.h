#pragma once

#include "Map.h"

#include <slamot/filters/EkfSlamot.h>
#include <slamot/models/TargetMotion.h>

#include <map>

namespace slamot::filters
{
/// The filter without its target model's type, and for any number of robots.
class EkfSlamot::Engine
{
 public:
  virtual ~Engine() = default;
  virtual core::Update process(int robot, const core::Step& step) = 0;
  [[nodiscard]] virtual core::Estimate estimate(int robot) const = 0;
  [[nodiscard]] virtual core::RobotAndTarget robotAndTarget(int target) const = 0;
  virtual core::Fusion fuse(const core::Evidence& evidence, const core::FusionOptions& options) = 0;
  virtual void predictTarget(core::RobotAndTarget& other, double dt) const = 0;
};
}  // namespace slamot::filters

namespace slamot::filters::ekf
{
/// How robots that share one belief know each other.
struct Mates
{
  std::string label;     ///< of blobs that are robots; empty: there are none
  std::vector<int> ids;  ///< that sensors tell, by robot; none: those of blobs are not believed
};

/// An engine that can be one of several hypotheses, without its target model's type.
class Hypothesis : public EkfSlamot::Engine
{
 public:
  [[nodiscard]] virtual std::unique_ptr<Hypothesis> clone() const = 0;
  /// The two halves of process(): to the step's time, and its sightings.
  virtual void move(int robot, const core::Step& step) = 0;
  /// \param landmarks absent: none, or they have been taken already.
  virtual core::Update take(int robot, const core::Step& step,
                            const core::LandmarkScan* landmarks) = 0;
  [[nodiscard]] virtual Belief& belief() = 0;
  [[nodiscard]] virtual Map& map() = 0;
};

template <class Motion>
class EngineOf : public Hypothesis
{
 public:
  EngineOf(const Settings& settings, const Motion& motion,
           const std::vector<core::FilterContext>& contexts, const Mates& mates);

  core::Update process(int robot, const core::Step& step) override
  {
    move(robot, step);
    return take(robot, step, step.landmarks ? &*step.landmarks : nullptr);
  }
  [[nodiscard]] std::unique_ptr<Hypothesis> clone() const override;
  void move(int robot, const core::Step& step) override;
  core::Update take(int robot, const core::Step& step,
                    const core::LandmarkScan* landmarks) override;
  [[nodiscard]] Belief& belief() override { return belief_; }
  [[nodiscard]] Map& map() override { return map_; }
  [[nodiscard]] core::Estimate estimate(int robot) const override;
  [[nodiscard]] core::RobotAndTarget robotAndTarget(int target) const override;
  core::Fusion fuse(const core::Evidence& evidence, const core::FusionOptions& options) override;
  void predictTarget(core::RobotAndTarget& other, double dt) const override;

 private:
  EngineOf(const EngineOf&) = default;  // map_ is the other's until attached
  using State = typename Motion::State;
  static constexpr int kSize = State::kSize;
  struct Target
  {
    int slot;
    State state;  // x and P are the belief's; the rest is the motion model's own
  };
  struct BlobScan
  {
    std::vector<core::Blob> blobs;  // those that are targets
    std::vector<int> index;         // their places in the step
    BlobRays rays;
    std::vector<std::int32_t> matches;
  };

  void startTarget(int id, const core::ObjectStart& start, double time);
  void addTarget(const State& state);
  void addKnowledge(const Target& target, const State& known);
  [[nodiscard]] State stateOf(const Target& target) const;
  void moveRobot(int robot, const Gaussian<Pose2D>& increment);
  void moveTargets(double dt);
  void takeScan(int robot, const core::Step& step, const core::LandmarkScan* landmarks,
                std::vector<core::Pairing>& pairings);
  void matchTargets(int robot, const core::BlobScan& scan, double time, BlobScan& out);
  void matchMates(int robot, const core::BlobScan& scan, double time,
                  std::vector<core::Pairing>& pairings);
  [[nodiscard]] double noiseOf(int robot, int mate, double time) const;
  [[nodiscard]] Gaussian<Point2D> seenPlace(int robot, const Ray& ray) const;
  void updateBanks(int robot, const BlobScan& scan, double time);
  void settleTargets(int robot, const BlobScan& scan, double time,
                     std::vector<core::Pairing>& pairings);
  void birth(int robot, const Ray& ray);
  void dropLost(double time);
  void wrapAngles();
  [[nodiscard]] Belief::Rows rowsOf(const Eigen::MatrixXd& H, const Target* target) const;
  core::Fusion fuseBlocks(const core::Evidence& evidence, const core::FusionOptions& options,
                          const Target* target);
  [[nodiscard]] const Target* targetWith(int id) const;

  Settings settings_;
  Motion motion_;
  Mates mates_;
  Belief belief_;
  Map map_;
  Tracks tracks_;
  std::vector<Target> targets_;     // as tracks_
  std::vector<Point2D> predicted_;  // of each robot: its place after the last motion
  std::vector<double> times_;       // of each robot's last step
  double time_;                     // of the latest
  std::map<std::pair<int, int>, double> mateSeen_;  // by whom, which: when last
  std::vector<SightingRows> rows_;
  std::vector<Candidate> candidates_;
};
}  // namespace slamot::filters::ekf
