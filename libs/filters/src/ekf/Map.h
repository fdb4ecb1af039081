#pragma once

#include "Belief.h"
#include "Settings.h"

#include <unordered_map>

namespace slamot::filters::ekf
{
/// The landmarks of a belief: which there are, which one a sighting is of, and which are local.
class Map : public core::LandmarkView
{
 public:
  Map(const Settings& settings, Belief& belief) : settings_(settings), belief_(belief) {}

  void visit(const std::function<void(const core::LandmarkEstimate&)>& visitor) const override;
  [[nodiscard]] std::size_t size() const override;

  /// What a scan's sightings are of: a landmark's slot, kNew or kRejected.
  struct Scan
  {
    std::vector<Ray> rays;
    std::vector<std::int32_t> matches;
    Point2D from;  ///< where the robot is before the update
  };
  /// Pairs a scan's sightings, and appends the rows of those that are paired.
  [[nodiscard]] Scan match(int robot, const core::LandmarkScan& scan, double time,
                           std::vector<SightingRows>& rows);
  /// After the update: counts, starts new landmarks, drops old ones that nothing confirmed.
  /// \return for each sighting the landmark's slot, or kRejected.
  std::vector<std::int32_t> settle(int robot, const core::LandmarkScan& scan, const Scan& matched,
                                   double time);
  /// A landmark's identity, or its number in order of discovery.
  [[nodiscard]] int idOf(int slot) const { return entries_[static_cast<std::size_t>(slot)].id; }

 private:
  struct Entry
  {
    int id = core::kNoId;
    int sightings = 0;  // 0: the slot is free
    double lastSeen = 0;
    int rejections = 0;  // sightings with its identity in a row that were elsewhere
    Point2D first;       // its first estimate
  };
  [[nodiscard]] bool isConfirmed(const Entry& e) const
  {
    return e.sightings >= settings_.confirmSightings;
  }
  void matchKnown(const core::LandmarkScan& scan, std::vector<std::int32_t>& matches) const;
  void matchByPlace(int robot, double time, Scan& out);
  void keepInReach(int robot, const core::LandmarkScan& scan, double time);
  [[nodiscard]] bool isInReach(int robot, const core::LandmarkScan& scan) const;
  [[nodiscard]] double slack(int robot, const core::Sighting& s) const;
  void forget(int slot);
  void forgetUnconfirmed(double time);
  [[nodiscard]] double noise(const Entry& e, double time) const
  {
    return settings_.noiseAfter(time - e.lastSeen);
  }
  void start(int robot, const Ray& ray, int id, double time, const Point2D& from,
             std::int32_t& slot);

  const Settings& settings_;
  Belief& belief_;
  std::vector<Entry> entries_;  // by slot
  std::unordered_map<int, int> slotOf_;
  int nextNumber_ = 0;
  Point2D centre_;  // of the local landmarks
  double reach_ = 0;
  double largestVar_ = 0;  // of a landmark's place, when they were made local [m²]
};
}  // namespace slamot::filters::ekf
