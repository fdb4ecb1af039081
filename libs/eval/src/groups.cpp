#include "groups.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace slamot::eval
{
namespace
{
constexpr double kFarthest = 1e15;  // in squares from the origin

/// Points by the squares of a grid that they lie in.
class Grid
{
 public:
  Grid(double side, const std::vector<Point2D>& points) : side_(side)
  {
    for (std::size_t i = 0; i < points.size(); ++i) entries_.emplace_back(square(points[i]), i);
    std::sort(entries_.begin(), entries_.end());
  }

  /// Calls `use` with the place of each point in the point's square and those around it.
  template <class F>
  void around(const Point2D& p, F&& use) const
  {
    const auto [row, column] = square(p);
    for (double r = row - 1; r <= row + 1; ++r)
    {
      // Neighbours in a row of squares lie side by side.
      const auto from =
          std::lower_bound(entries_.begin(), entries_.end(), Entry({r, column - 1}, 0));
      for (auto it = from; it != entries_.end() && it->first <= Square(r, column + 1); ++it)
        use(it->second);
    }
  }

 private:
  // Whole numbers, which as doubles hold coordinates of any size.
  using Square = std::pair<double, double>;
  using Entry = std::pair<Square, std::size_t>;

  [[nodiscard]] Square square(const Point2D& p) const
  {
    const Square out{std::floor(p.y / side_), std::floor(p.x / side_)};
    // Beyond, a square and the next have the same number; NaN has none.
    if (!(std::abs(out.first) < kFarthest && std::abs(out.second) < kFarthest))
      throw std::domain_error("metrics of sets need finite points, not beyond all bounds");
    return out;
  }

  double side_;
  std::vector<Entry> entries_;
};

/// Sets of places that are joined one after another.
class DisjointSets
{
 public:
  explicit DisjointSets(std::size_t count) : parent_(count)
  {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i)
  {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) { parent_[find(i)] = find(j); }

 private:
  std::vector<std::size_t> parent_;
};
}  // namespace

std::vector<Group> groupsWithin(double distance, const std::vector<Point2D>& first,
                                const std::vector<Point2D>& second)
{
  const Grid grid(distance, second);
  DisjointSets sets(first.size() + second.size());
  std::vector<char> near(first.size() + second.size(), 0);
  for (std::size_t i = 0; i < first.size(); ++i)
    grid.around(first[i],
                [&](std::size_t j)
                {
                  if ((first[i] - second[j]).sqrNorm() >= distance * distance) return;
                  sets.join(i, first.size() + j);
                  near[i] = near[first.size() + j] = 1;
                });
  std::vector<Group> out;
  constexpr auto kNoGroup = static_cast<std::size_t>(-1);
  std::vector<std::size_t> groupOf(near.size(), kNoGroup);
  for (std::size_t i = 0; i < near.size(); ++i)
  {
    if (!near[i]) continue;
    std::size_t& group = groupOf[sets.find(i)];
    if (group == kNoGroup)
    {
      group = out.size();
      out.emplace_back();
    }
    const bool isFirst = i < first.size();
    (isFirst ? out[group].first : out[group].second).push_back(isFirst ? i : i - first.size());
  }
  return out;
}
}  // namespace slamot::eval
