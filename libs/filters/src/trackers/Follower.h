#pragma once

#include "Bank.h"
#include "Settings.h"

#include <memory>

namespace slamot::filters::trackers
{
/// Follows targets from poses that somebody else estimates, in the frame of those poses: which blob
/// is of which target, and when targets begin, are believed and are lost.
class Follower
{
 public:
  Follower(const Settings& settings, std::unique_ptr<Bank> bank, const core::Starts& starts);

  /// Takes in a step: time goes on by dt [s], then the blobs seen from the pose.
  void process(const core::Step& step, double dt, const Pose2D& pose);
  /// The confirmed targets, in rising order of ids, for a pose of this covariance.
  [[nodiscard]] std::vector<core::TargetEstimate> estimates(const Gaussian<Pose2D>& pose) const;
  /// What became of the last step's blobs.
  [[nodiscard]] const std::vector<core::Pairing>& pairings() const { return pairings_; }
  [[nodiscard]] core::Diagnostics diagnostics() const { return bank_->diagnostics(); }

 private:
  void match(const Eye& eye, const core::BlobScan& scan);
  void settle(std::size_t blob, const core::Blob& b, const Eye& eye, double time);
  void dropLost(double time);

  Settings settings_;
  std::unique_ptr<Bank> bank_;
  Tracks tracks_;
  std::vector<Seen> seen_;
  std::vector<Candidate> candidates_;
  std::vector<std::int32_t> matches_;
  std::vector<core::Pairing> pairings_;
};
}  // namespace slamot::filters::trackers
