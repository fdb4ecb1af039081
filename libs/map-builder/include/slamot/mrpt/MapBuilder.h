#pragma once

#include <mrpt/slam/CMetricMapBuilder.h>
#include <slamot/core/Config.h>
#include <slamot/core/Start.h>

#include <memory>

namespace slamot::mrpt
{
/// A filter of slamot's as MRPT's programs run their own map builders.
///
/// The metric map is a CMultiMetricMap with one CLandmarkGaussianMap; the simple map holds the
/// frames that were taken 0.1 m or 5 degrees apart.  With enableMapUpdating(false) no frame is
/// added to the simple map; the filter maps all the same, or it would not know where it is.
class MapBuilder : public ::mrpt::slam::CMetricMapBuilder
{
 public:
  /// \param config as for slamot run: the filter's section, [run] (method, seed), [start],
  /// [odometer], [sensor], [log].  \param starts where the config has no [start].
  /// \throws core::Error (kConfig).
  explicit MapBuilder(core::Config config, const core::Starts& starts = {}, int threads = 1);
  ~MapBuilder() override;

  /// Begins anew.  \param x0 where the robot is: its mean and its standard deviations; null: as
  /// the config says.  \throws core::Error (kConfig) for a map that is not empty: filters begin
  /// without one.
  void initialize(const ::mrpt::maps::CSimpleMap& initialMap = ::mrpt::maps::CSimpleMap(),
                  const ::mrpt::poses::CPosePDF* x0 = nullptr) override;

  /// \throws core::Error (kNonsense) if values make no sense, or time goes backwards; the filter is
  /// then as before.
  void processActionObservation(::mrpt::obs::CActionCollection& action,
                                ::mrpt::obs::CSensoryFrame& observations) override;
  /// Observations alone, odometry among them.  Those of one timestamp are taken together, once one
  /// of another timestamp comes or flush() is called.  \throws as processActionObservation().
  void processObservation(const ::mrpt::obs::CObservation::Ptr& observation);
  /// Takes in what waited for more of its timestamp.
  void flush();

  /// A Gaussian.
  [[nodiscard]] ::mrpt::poses::CPose3DPDF::Ptr getCurrentPoseEstimation() const override;
  /// Frames with their poses, as the robot was believed to be when they were taken.
  void getCurrentlyBuiltMap(::mrpt::maps::CSimpleMap& out) const override;
  /// Frames in that simple map.
  unsigned int getCurrentlyBuiltMapSize() override;
  /// As it was after the last step; the pointer stays valid, what it points to changes.
  [[nodiscard]] const ::mrpt::maps::CMultiMetricMap* getCurrentlyBuiltMetricMap() const override;
  /// Paths, map, targets and particles, as slamot render draws them.  \param file its name's end is
  /// its format, as .png or .bmp.  \param unused MRPT's choice of format.
  /// \throws core::Error: kUnreadable if it can't be written, kInternal where there is no OpenGL.
  void saveCurrentEstimationToImage(const std::string& file, bool unused = true) override;

 private:
  struct Parts;
  void keep(const ::mrpt::obs::CSensoryFrame& frame);
  void keepHeld();

  std::unique_ptr<Parts> parts_;
};
}  // namespace slamot::mrpt
