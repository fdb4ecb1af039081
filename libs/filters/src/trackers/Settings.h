#pragma once

#include "Seen.h"
#include "sighting/SensorSettings.h"

namespace slamot::filters::trackers
{
/// The keys of all trackers.
struct Settings : TargetSettings
{
  bool known;         ///< association = known: identities are taken at their word, without gates
  bool places;        ///< observation = position: blobs with a range count as places
  double noiseScale;  ///< multiplies the deviations that the log tells

  /// \param glint the outliers' share where the configuration tells none.
  static Settings from(core::Params& p, double glint = 0);
  [[nodiscard]] Seen seen(const core::Blob& blob) const;
};
}  // namespace slamot::filters::trackers
