#include "Follower.h"

namespace slamot::filters::trackers
{
Follower::Follower(const Settings& settings, std::unique_ptr<Bank> bank, const core::Starts& starts)
    : settings_(settings), bank_(std::move(bank)), tracks_(settings.tracks)
{
  for (const auto& [id, start] : starts.targets)
  {
    if (!start.value[core::ObjectStart::kX] || !start.value[core::ObjectStart::kY]) continue;
    tracks_.addStart(id, starts.time.value_or(0));
    bank_->start(start);
  }
}

void Follower::process(const core::Step& step, double dt, const Pose2D& pose)
{
  pairings_.clear();
  bank_->predict(std::max(0.0, dt));
  if (!step.blobs) return;
  const Eye eye(pose);
  match(eye, *step.blobs);
  for (std::size_t k = 0; k < matches_.size(); ++k) settle(k, step.blobs->blobs[k], eye, step.time);
  dropLost(step.time);
}

void Follower::match(const Eye& eye, const core::BlobScan& scan)
{
  seen_.clear();
  BlobRays rays{&scan.blobs, {}};
  for (const core::Blob& b : scan.blobs)
  {
    seen_.push_back(settings_.seen(b));
    rays.rays.push_back(seen_.back().ray);
  }
  const auto innovate = [&](std::size_t k, std::size_t t, Innovation& o)
  {
    if (!bank_->innovate(t, eye, seen_[k], o)) return false;
    if (settings_.known && scan.blobs[k].id != core::kNoId) o.d2 = 0;
    return true;
  };
  matchBlobs(rays, tracks_.list(), settings_.gates, innovate, candidates_, matches_);
}

void Follower::settle(std::size_t k, const core::Blob& blob, const Eye& eye, double time)
{
  core::Pairing pairing{true, static_cast<int>(k), core::Pairing::Outcome::kRejected, core::kNoId};
  if (matches_[k] >= 0)
  {
    const auto t = static_cast<std::size_t>(matches_[k]);
    bank_->take(t, eye, seen_[k]);
    tracks_.hit(t, blob, time);
    pairing.outcome = core::Pairing::Outcome::kKnown;
    pairing.id = tracks_.list()[t].id;
  }
  else if (matches_[k] == kNew)
  {
    tracks_.add(blob, time);
    bank_->birth(eye, seen_[k]);
    pairing.outcome = core::Pairing::Outcome::kNew;
    pairing.id = tracks_.list().back().id;
  }
  else
    tracks_.reject(blob);
  pairings_.push_back(pairing);
}

void Follower::dropLost(double time)
{
  for (std::size_t t = bank_->size(); t-- > 0;)
  {
    const Matrix3 cov = bank_->estimate(t, tracks_.list()[t]).pose.cov;
    if (!tracks_.isLost(t, time, std::sqrt(0.5 * (cov(0, 0) + cov(1, 1))))) continue;
    tracks_.erase(t);
    bank_->drop(t);
  }
}

std::vector<core::TargetEstimate> Follower::estimates(const Gaussian<Pose2D>& pose) const
{
  std::vector<core::TargetEstimate> out;
  for (std::size_t t = 0; t < bank_->size(); ++t)
  {
    if (!tracks_.list()[t].confirmed) continue;
    out.push_back(bank_->estimate(t, tracks_.list()[t]));
    // What is not certain of the robot's pose moves the target as a rigid whole.
    Gaussian<Pose2D>& target = out.back().pose;
    Matrix3 T = Matrix3::Identity();
    T(0, 2) = pose.mean.y - target.mean.y;
    T(1, 2) = target.mean.x - pose.mean.x;
    target.cov += T * pose.cov * T.transpose();
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return out;
}
}  // namespace slamot::filters::trackers
