#pragma once

#include "BestMap.h"
#include "Intensity.h"
#include "JointFusion.h"
#include "ParticleSet.h"
#include "PathTree.h"
#include "TargetMixture.h"
#include "Workers.h"

#include <slamot/core/Team.h>
#include <slamot/filters/RbpfSlamot.h>

namespace slamot::filters
{
/// The filter without its target model's type.
class RbpfSlamot::Engine
{
 public:
  virtual ~Engine() = default;
  virtual core::Update process(const core::Step& step) = 0;
  [[nodiscard]] virtual core::Estimate estimate() const = 0;
  [[nodiscard]] virtual std::vector<core::WeightedPose> particles() const = 0;
  [[nodiscard]] virtual std::vector<core::PathPose> path() const = 0;
  [[nodiscard]] virtual std::size_t mapBytes() const = 0;
  [[nodiscard]] virtual core::RobotAndTarget robotAndTarget(int target) const = 0;
  virtual core::Fusion fuse(const core::Evidence& evidence, const core::FusionOptions& options) = 0;
  virtual void predictTarget(core::RobotAndTarget& other, double dt) const = 0;
};
}  // namespace slamot::filters

namespace slamot::filters::rbpf
{
// Purposes of random streams.
enum : std::uint64_t
{
  kStartStream = 1,
  kMoveStream,
  kSampleStream,
  kResampleStream,
  kAssociateStream,
  kFuseStream
};

template <class Motion>
class EngineOf : public RbpfSlamot::Engine
{
 public:
  EngineOf(const Settings& settings, const Motion& motion, const core::FilterContext& context);

  core::Update process(const core::Step& step) override;
  [[nodiscard]] core::Estimate estimate() const override { return estimate_; }
  [[nodiscard]] std::vector<core::WeightedPose> particles() const override;
  [[nodiscard]] std::vector<core::PathPose> path() const override;
  [[nodiscard]] std::size_t mapBytes() const override { return pool_.bytes(); }
  [[nodiscard]] core::RobotAndTarget robotAndTarget(int target) const override;
  core::Fusion fuse(const core::Evidence& evidence, const core::FusionOptions& options) override;
  void predictTarget(core::RobotAndTarget& other, double dt) const override;

 private:
  using State = typename Motion::State;
  struct Outcome  // what one particle made of a scan
  {
    std::vector<std::int32_t> landmarks, blobs;
    Vector3 mean;  // of its pose before sampling (informed), else the pose
    Matrix3 cov;   // of that mean; zero for a sampled pose
  };
  struct Scratch
  {
    MatchScratch match;
    std::vector<Innovation> innovations;
    TrackScratch tracks;
    Intensity::Scratch intensity;
    typename TargetMixture<Motion>::Scratch mixture;
    std::vector<std::pair<Innovation, bool>> paired;  // with confirmed targets; with a range?
  };

  void start(const core::FilterContext& context);
  void startTargets(const core::Starts& starts);
  void move(const Gaussian<Pose2D>& increment);
  void samplePending(std::uint64_t stream);
  void predictTargets(double dt);
  void takeScan(const core::Step& step);
  void settleFrame();
  void updateParticle(std::size_t i, int lane);
  double placeByMarginal(std::size_t i, const Matrix3& root, Scratch& scratch);
  double placeBySample(std::size_t i, const Matrix3& root, Scratch& scratch, bool sampled,
                       int lane);
  void matchTargets(std::size_t i, const Eye& prior, Scratch& scratch);
  double weighTargets(std::size_t i, const Eye& eye, PoseUpdate* update, Scratch& scratch);
  Vector3 samplePose(std::size_t i, const PoseUpdate::Result& r);
  void settleTracks(double time);
  std::vector<double> voteShares(std::size_t blob, std::size_t known) const;
  void dropLostTracks(double time);
  void normalise();
  void collectGarbage();
  void notePath(double time, bool isNew);
  /// Of a particle's robot in map axes, but for the frame's own doubt.
  [[nodiscard]] Gaussian<Pose2D> poseOf(std::size_t i) const;
  void updateEstimate(double time, bool afterScan);
  void showMap(std::size_t particle);
  [[nodiscard]] std::vector<core::Pairing> pairings(const core::Step& step) const;
  void estimateTracks();

  // Targets as a random finite set: targetSet.cpp.
  struct Summary  // of a label
  {
    double existence = 0;
    TargetMoments<Motion> moments;  // of each particle's heaviest component with it
  };
  [[nodiscard]] bool hasTargetSet() const { return settings_.targetSet.has_value(); }
  void beginSet(const core::Step& step);
  void matchSet(std::size_t i, const Eye& prior, Scratch& scratch);
  double shapeBySet(std::size_t i, const Eye& prior, PoseUpdate& update, Scratch& scratch) const;
  double takeIntoSet(std::size_t i, const Eye& eye, Scratch& scratch);
  double takeOverPairs(std::size_t i, const Eye& prior, Scratch& scratch);
  void settleSet(double time);
  void settleLabels();
  void absorb(std::size_t younger, std::size_t older);
  void dropLostLabels(double time);
  void dropLabels(const std::vector<std::uint64_t>& keys);
  [[nodiscard]] std::vector<Summary> summarise() const;
  void estimateSet();

  // The part of a team: team.cpp.
  using Kinematics = decltype(Motion::kinematics(State{}).value);
  static constexpr int kTarget = Kinematics::RowsAtCompileTime;
  using Joint = Eigen::Matrix<double, 3 + kTarget, 1>;  // robot and target, one particle's
  [[nodiscard]] std::optional<std::size_t> trackWith(int id) const;
  [[nodiscard]] Joint jointOf(const Particle<State>& p, std::optional<std::size_t> track) const;
  [[nodiscard]] core::RobotAndTarget jointMoments(std::size_t track) const;
  [[nodiscard]] CommonErrors commonErrors(const core::RobotAndTarget& own,
                                          std::optional<std::size_t> track) const;
  void carryOut(const JointFusion& fusion, std::optional<std::size_t> track,
                const core::RobotAndTarget& own);
  void shiftParticle(Particle<State>& p, std::optional<std::size_t> track, const Joint& by,
                     const JointFusion& fusion) const;

  Settings settings_;
  Motion motion_;
  std::uint64_t seed_;
  std::uint64_t stepNumber_ = 0;
  Workers workers_;
  maps::LandmarkPool pool_;
  ParticleSet<State> particles_;
  Tracks tracks_;
  LandmarkScan scan_;
  Intensity intensity_;
  BlobRays blobRays_;
  TargetLabels labels_;  // targets = gm-phd, as mixture_
  TargetMixture<Motion> mixture_;
  std::vector<std::uint64_t> hidden_;  // labels of targets that have an older one
  Gaussian<Pose2D> pending_;           // informed: motion since the poses were last sampled
  Matrix3 pendingRoot_;                // a square root of its covariance, for the scan
  bool placed_ = false;                // informed: a pose has been sampled, or the map begun
  std::vector<Pose2D> priors_;         // each particle's pose before the scan
  std::vector<double> weights_;        // normalised, after the scan
  std::vector<Outcome> outcomes_;
  std::vector<Scratch> scratch_;
  std::vector<double> targetNoise_;  // of each track, where its sightings shape the poses
  std::vector<int> blobIds_;         // the target that the scan's blobs are of, on the whole
  std::uint64_t resamplings_ = 0;
  std::size_t best_ = 0;
  BestMap bestMap_;
  PathTree paths_;
  bool drawn_ = true;                       // poses since the last draw that paths_ knows
  PathTree::Node shown_ = PathTree::kNone;  // of the particle whose map is shown
  core::Estimate estimate_;
  Matrix3 spread_ = Matrix3::Zero();        // of the estimated pose, but for the frame's doubt
  bool fromScan_ = false;                   // whether the estimate is of outcomes_
  bool isMoved_ = false;                    // by a team: particles' shifts count
  std::vector<core::RobotAndTarget> kept_;  // since the particles were resampled
  core::Diagnostics diagnostics_;
};
}  // namespace slamot::filters::rbpf
