#pragma once

#include <slamot/math/geometry.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace slamot::moving
{
/// What a cell of the plane has been, as far as a laser saw it lately.
enum class Evidence
{
  kUnknown,  ///< not looked at, or not lately
  kFree,     ///< looked through, and nothing stands beside it
  kOccupied  ///< something stands here, or in a neighbouring cell
};

/// Where nothing was and where something stood: an occupancy grid that forgets.  A return from
/// where beams have passed before is of something that moved there.
class FreeSpace
{
 public:
  /// How large cells are, and what is believed of them for how long.
  struct Options
  {
    double cell = 0.1;    ///< [m]
    double margin = 0.1;  ///< a beam is free up to this before its return, and nothing stands in a
                          ///< place unless it does within this [m]
    double marginPerRange = 0.035;  ///< the same, and as much more per range: what headings are off
    double remember = 15.0;         ///< a cell not seen for longer is unknown [s]
  };

  /// \param origin near what is looked at: cells are counted from there.
  explicit FreeSpace(const Options& options, const Point2D& origin = {0, 0})
      : options_(options), origin_(origin)
  {
  }

  /// \param range at which the place is seen [m].
  [[nodiscard]] Evidence at(const Point2D& p, double range, double time) const;
  /// Whether something stood in the very cell.
  [[nodiscard]] bool isOccupied(const Point2D& p, double time) const;
  /// A beam from the laser to its return.  \param counts whether the return is of what stands.
  void add(const Point2D& laser, const Point2D& end, bool counts, double time);
  /// Whatever was seen in a place, as if it had not been.
  void forget(const Point2D& p);
  /// Drops what is forgotten; to be called once a scan.
  void tidy(double time);

 private:
  struct Cell
  {
    float odds = 0,
          before = 0;        // log odds of being occupied, and what they were before its last scan
    bool hit = false;        // in its last scan, of which each counts once, and a return wins
    std::uint32_t scan = 0;  // the last scan
    double seen = 0;         // [s]
  };
  using Key = std::uint64_t;
  [[nodiscard]] Key keyOf(int x, int y) const;
  [[nodiscard]] int indexOf(double along) const;
  [[nodiscard]] int column(const Point2D& p) const { return indexOf(p.x - origin_.x); }
  [[nodiscard]] int row(const Point2D& p) const { return indexOf(p.y - origin_.y); }
  [[nodiscard]] float oddsAt(int x, int y, double time) const;
  [[nodiscard]] double marginAt(double range) const
  {
    return options_.margin + options_.marginPerRange * range;
  }
  void passThrough(const Point2D& laser, const Point2D& end, double time);
  void change(int x, int y, bool occupied, double time);

  Options options_;
  Point2D origin_;
  std::unordered_map<Key, Cell> cells_;
  std::uint32_t scan_ = 1;
};
}  // namespace slamot::moving
