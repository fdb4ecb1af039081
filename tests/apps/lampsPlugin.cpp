#include <slamot/perception/LandmarkDetector.h>

// A plugin as an author outside the tree writes it: what begins nearer than told.
class Lamps : public slamot::perception::LandmarkDetector
{
 public:
  Lamps(slamot::core::Params& p, const slamot::perception::LaserOptions&)
      : maxRange_(p.positive("max_range_m"))
  {
  }
  [[nodiscard]] std::vector<slamot::perception::DetectedLandmark> detect(
      const slamot::core::LaserScan&,
      const std::vector<slamot::perception::Cluster>& clusters) const override
  {
    std::vector<slamot::perception::DetectedLandmark> out;
    for (const auto& c : clusters)
      if (c.points.front().range < maxRange_)
        out.push_back({{c.points.front().at, 0.01 * slamot::Matrix2::Identity()}, 0});
    return out;
  }
  [[nodiscard]] double maxRange() const override { return maxRange_; }

 private:
  double maxRange_;
};

SLAMOT_REGISTER_LANDMARK_DETECTOR("lamps", Lamps)
