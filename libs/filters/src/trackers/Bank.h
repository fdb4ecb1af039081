#pragma once

#include "Seen.h"

#include <slamot/core/Start.h>

namespace slamot::filters::trackers
{
/// The estimators of the targets that are followed, one for each: what of them is no bookkeeping.
/// Targets are numbered in the order of their making; dropping one moves those after it.
class Bank
{
 public:
  virtual ~Bank() = default;

  /// Time goes on by dt [s] >= 0; called once a step.
  virtual void predict(double dt) = 0;
  /// A new last target, from what is told of its start, or from a first observation with a range.
  virtual void start(const core::ObjectStart& told) = 0;
  virtual void birth(const Eye& eye, const Seen& z) = 0;
  virtual void drop(std::size_t target) = 0;
  /// Takes in an observation of a target.
  virtual void take(std::size_t target, const Eye& eye, const Seen& z) = 0;

  [[nodiscard]] virtual std::size_t size() const = 0;
  /// Innovation of an observation by a target, for gates; false where it has none.
  virtual bool innovate(std::size_t target, const Eye& eye, const Seen& z, Innovation& o) const = 0;
  /// With the track's names.
  [[nodiscard]] virtual core::TargetEstimate estimate(std::size_t target,
                                                      const Track& track) const = 0;
  /// Of what was taken in since the last prediction.
  [[nodiscard]] virtual core::Diagnostics diagnostics() const { return {}; }
};
}  // namespace slamot::filters::trackers
