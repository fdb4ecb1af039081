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
  Map(const Settings& settings, Belief& belief) : settings_(&settings), belief_(&belief) {}
  /// A copied map belongs to the copy of its belief.
  void attach(const Settings& settings, Belief& belief)
  {
    settings_ = &settings;
    belief_ = &belief;
  }

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

  // The same in steps, for hypotheses that part over what a sighting is of.

  /// What a sighting may be of.
  struct Alternative
  {
    std::int32_t thing;  ///< a landmark's slot, or kNew
    double logWeight;   ///< of this, its log density [1/(m rad)] by the chance of the miss it isn't
    double missed;      ///< that chance; 1 where it is nothing known
    double density;     ///< of the sighting if it is of the landmark and that exists [1/(m rad)]
    SightingRows rows;  ///< for the update, where it is a landmark
  };
  /// Begins a scan. \return the sightings.
  std::vector<Ray> begin(int robot, const core::LandmarkScan& scan, double time);
  /// What a sighting may be of, as things stand, likeliest first; not of what was seen in this
  /// scan.  What is not worth a thought beside the likeliest is left out.
  [[nodiscard]] std::vector<Alternative> alternatives(int robot, const Ray& ray, double time) const;
  /// Counts the scan's k-th sighting, of a landmark or, after the scan's update, of nothing known.
  /// \return the slot.
  std::int32_t take(int robot, const Ray& ray, std::size_t k, const Alternative& of, double time);
  /// Ends the scan: landmarks that should have been seen and were not get less likely.
  /// \return log of the chance to miss all landmarks, which seen ones' alternatives are weighed by.
  double miss(int robot, double time);

  /// A landmark's identity, or its number in order of discovery.
  [[nodiscard]] int idOf(int slot) const { return entries_[static_cast<std::size_t>(slot)].id; }

 private:
  static constexpr double kReported = 0.5;
  struct Entry
  {
    int id = core::kNoId;
    int sightings = 0;  // 0: the slot is free
    double lastSeen = 0;
    int rejections = 0;  // sightings with its identity in a row that were elsewhere
    Point2D first;       // its first estimate
    double existence = 1;
    bool seen = false;  // in this scan
  };
  [[nodiscard]] bool isConfirmed(const Entry& e) const
  {
    return e.sightings >= settings_->confirmSightings && e.existence >= kReported;
  }
  /// A landmark that a sighting may be of.
  struct Possible
  {
    int slot;
    Innovation innovation;
    double noise;  ///< what multiplies the sighting's variances
  };
  [[nodiscard]] std::vector<Possible> possible(int robot, const Eye& eye, const Ray& ray,
                                               double time) const;
  [[nodiscard]] bool isRatherNew(int robot, int object, const Eye& eye, const Ray& ray,
                                 const Innovation& o) const;
  [[nodiscard]] double chanceToSee(int robot, const Eye& eye, int slot) const;
  void matchKnown(const core::LandmarkScan& scan, std::vector<std::int32_t>& matches) const;
  void matchByPlace(int robot, double time, Scan& out);
  void keepInReach(int robot, const core::LandmarkScan& scan, double time);
  [[nodiscard]] bool isInReach(int robot, const core::LandmarkScan& scan) const;
  [[nodiscard]] double slack(int robot, const core::Sighting& s) const;
  [[nodiscard]] double reachOf(int robot, const core::LandmarkScan& scan) const;
  void forget(int slot);
  void forgetUnconfirmed(double time);
  [[nodiscard]] double noise(const Entry& e, double time) const
  {
    return settings_->noiseAfter(time - e.lastSeen);
  }
  void look(const core::LandmarkScan& scan);
  void start(int robot, const Ray& ray, int id, double time, const Point2D& from,
             std::int32_t& slot);

  const Settings* settings_;
  Belief* belief_;
  std::vector<Entry> entries_;  // by slot
  std::unordered_map<int, int> slotOf_;
  int nextNumber_ = 0;
  int scanNumber_ = 0;  // of what this scan's first sighting would start: alike in all hypotheses
  LogProduct
      missed_;  // chance of this scan's misses, those of seen landmarks' alternatives included
  double farthest_ = 0;  // sighting yet [m]
  Point2D centre_;       // of the local landmarks
  double reach_ = 0;
  core::FieldOfView fov_;  // of this scan
  Point2D from_;           // where the robot was before it
  double largestVar_ = 0;  // of a landmark's place, when they were made local [m²]
};
}  // namespace slamot::filters::ekf
