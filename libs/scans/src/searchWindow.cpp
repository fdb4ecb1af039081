#include "searchWindow.h"

#include <algorithm>
#include <queue>

namespace slamot::scans
{
namespace
{
// Deviations from what is expected against likelihood: as if so many of a scan's points told
// something of their own, since neighbours hit the same wall.
constexpr double kIndependentPoints = 30;

using Cells = std::vector<std::array<int, 2>>;

/// Poses of one heading, displaced from the centre by x .. x + 2^level - 1 cells, y likewise.
struct Block
{
  double bound;  ///< of score less what the deviation costs
  double score;
  int level, turn, x, y;

  /// The best one last; of equal ones the first in order, so that the result is one.
  bool operator<(const Block& o) const
  {
    if (bound != o.bound) return bound < o.bound;
    if (level != o.level) return level > o.level;
    return std::tie(o.turn, o.y, o.x) < std::tie(turn, y, x);
  }
};

/// A search takes as long as there are points, and some hundreds tell as well where it ends.
std::vector<Point2D> evenlySome(const std::vector<Point2D>& points)
{
  constexpr std::size_t kMost = 400;
  if (points.size() <= kMost) return points;
  std::vector<Point2D> out;
  for (std::size_t i = 0; i < kMost; ++i) out.push_back(points[i * points.size() / kMost]);
  return out;
}

class Search
{
 public:
  Search(const LocalMap& map, const std::vector<Point2D>& points, const SearchWindow& window,
         double least)
      : map_(map), window_(window), least_(least), radius_(cellsOf(window.radius))
  {
    // The turn that moves a far point by one cell; the farthest are few.
    std::vector<double> ranges;
    for (const Point2D& p : points) ranges.push_back(std::hypot(p.x, p.y));
    const auto far = ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() * 8 / 10);
    std::nth_element(ranges.begin(), far, ranges.end());
    turnStep_ = std::clamp(LocalMap::kCell / *far, 0.003, 0.05);
    turns_ = static_cast<int>(std::ceil(window.turn / turnStep_));
    while (topLevel_ + 1 < BlockMaxima::kLevels && (2 << topLevel_) <= radius_) ++topLevel_;
    const std::vector<Point2D> some = evenlySome(points);
    for (int i = -turns_; i <= turns_; ++i) rotate(some, i);
  }

  std::optional<SearchResult> run()
  {
    for (int i = -turns_; i <= turns_; ++i)
      for (int y = -radius_; y <= radius_; y += 1 << topLevel_)
        for (int x = -radius_; x <= radius_; x += 1 << topLevel_) open(topLevel_, i, x, y);
    while (!blocks_.empty())
    {
      const Block best = blocks_.top();
      blocks_.pop();
      if (best.level == 0) return SearchResult{poseOf(best), best.score};
      const int half = 1 << (best.level - 1);
      for (const int y : {best.y, best.y + half})
        for (const int x : {best.x, best.x + half})
          if (x <= radius_ && y <= radius_) open(best.level - 1, best.turn, x, y);
    }
    return std::nullopt;
  }

 private:
  static int cellsOf(double length)
  {
    return static_cast<int>(std::ceil(length / LocalMap::kCell));
  }

  void rotate(const std::vector<Point2D>& points, int turn)
  {
    const Pose2D pose{window_.centre.x, window_.centre.y, window_.centre.phi + turn * turnStep_};
    Cells cells;
    cells.reserve(points.size());
    for (const Point2D& p : points) cells.push_back(map_.cellOf(math::transform(pose, p)));
    cells_.push_back(std::move(cells));
  }

  void open(int level, int turn, int x, int y)
  {
    int sum = 0;
    const Cells& cells = cells_[static_cast<std::size_t>(turn + turns_)];
    for (const auto& [cx, cy] : cells) sum += map_.field().bound(level, cx + x, cy + y);
    const double score = sum / (LocalMap::kHit * static_cast<double>(cells.size()));
    if (score < least_) return;
    blocks_.push({score - cost(level, turn, x, y), score, level, turn, x, y});
  }

  /// What the block's pose nearest to the centre deviates.
  [[nodiscard]] double cost(int level, int turn, int x, int y) const
  {
    const int size = (1 << level) - 1;
    const double dx = LocalMap::kCell * (x > 0 ? x : std::min(0, x + size));
    const double dy = LocalMap::kCell * (y > 0 ? y : std::min(0, y + size));
    const double s = window_.positionStd, t = turn * turnStep_ / window_.headingStd;
    return 0.5 * ((dx * dx + dy * dy) / (s * s) + t * t) / kIndependentPoints;
  }

  [[nodiscard]] Pose2D poseOf(const Block& b) const
  {
    return {window_.centre.x + b.x * LocalMap::kCell, window_.centre.y + b.y * LocalMap::kCell,
            math::wrapToPi(window_.centre.phi + b.turn * turnStep_)};
  }

  const LocalMap& map_;
  const SearchWindow& window_;
  double least_, turnStep_ = 0;
  int radius_, turns_ = 0, topLevel_ = 0;
  std::vector<Cells> cells_;  // by turn
  std::priority_queue<Block> blocks_;
};
}  // namespace

std::optional<SearchResult> searchWindow(const LocalMap& map, const std::vector<Point2D>& points,
                                         const SearchWindow& window, double least)
{
  if (map.empty() || points.empty()) return std::nullopt;
  return Search(map, points, window, least).run();
}
}  // namespace slamot::scans
