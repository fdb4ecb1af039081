#pragma once

#include <slamot/core/Params.h>
#include <slamot/moving/FreeSpace.h>
#include <slamot/perception/LaserClusters.h>

namespace slamot::moving
{
/// What is followed of a moving thing.
enum class Shape
{
  kRectangle,  ///< a rectangle, by the faces and corners that are seen
  kCentre      ///< the middle of what is seen, which lies before the thing's own
};

/// A length that is known somewhat [m].
struct Extent
{
  double mean;  ///< [m]
  double std;   ///< [m]; 0: known
};

/// What moving things are like, and how they are told from what stands.
struct MovingOptions
{
  perception::LaserOptions laser;   ///< how scans are parted into things
  FreeSpace::Options freeSpace;     ///< where nothing stood
  Shape shape = Shape::kRectangle;  ///< what of a thing is followed
  Extent length{0.6, 0.3};          ///< along the heading
  Extent width{0.4, 0.2};           ///< across it
  double axleBehind = 0.18;         ///< of the middle: the point that does not slide sideways [m]
  double reportAhead = 0;           ///< of the middle: the point that is reported [m]
  double shapeStd = 0.03;           ///< how far the thing is from being a rectangle [m]
  double speedWalk = 1.0;           ///< [m/s per root of a second]
  double turnWalk = 2.0;            ///< [rad/s per root of a second]
  double slide = 0.03;              ///< across its heading [m per root of a second]
  double maxSize = 1.5;             ///< of what is looked at [m]
  int minPoints = 3;                ///< of a scan on it
  double confirmDistance = 0.3;     ///< to have moved [m]
  double confirmTime = 1.0;         ///< within this [s]
  int confirmScans = 4;             ///< to have been seen in
  double confirmFree = 0.4;    ///< part of its returns that must lie where nothing was, or where
                               ///< nothing is any more
  double tentativeTime = 0.5;  ///< unseen until dropped, before it has moved [s]
  double lostTime = 2.0;       ///< the same after [s]
  int seenThrough = 4;         ///< scans in a row that looked through it until dropped

  /// The keys of the section, as config-ini/scan-slamot.ini comments them. \throws core::Error
  /// (kConfig)
  static MovingOptions from(core::Params& p);
};
}  // namespace slamot::moving
