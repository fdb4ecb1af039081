#pragma once

#include <slamot/moving/MovingOptions.h>

#include <map>

#include "MovingTrack.h"

namespace slamot::moving
{
/// The track with a box whose outline a return is near to; none: null.
[[nodiscard]] const MovingTrack* ownerOf(const Point2D& at, const std::vector<MovingTrack>& tracks);

/// Whose the things in a scan are.
struct Claims
{
  std::map<const MovingTrack*, Thing> boxes;
  std::vector<Thing> rest;  ///< small things that are no box's
};
[[nodiscard]] Claims claim(const std::vector<perception::Cluster>& clusters,
                           const std::vector<MovingTrack>& tracks, const Look& look,
                           const FreeSpace& space, const MovingOptions& options);

/// Places of a track that is no box yet and of a thing in lists of them.
struct PointPair
{
  std::size_t track, thing;
};
/// Nearest first, each track and each thing at most once.
[[nodiscard]] std::vector<PointPair> pairPoints(const std::vector<MovingTrack>& tracks,
                                                const std::vector<Thing>& things);
}  // namespace slamot::moving
