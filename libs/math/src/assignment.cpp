#include <slamot/math/assignment.h>

#include <limits>
#include <stdexcept>

namespace slamot::math
{
namespace
{
constexpr int kNone = -1;
constexpr int kMostBids = 8;  // in a row; more of them cost more than the searches they save

// The columns' potentials v keep each assigned row at the least of its reduced costs
// cost(i, j) - v[j]; a column that no row has yet has v = 0.  No more rows than columns.
class ShortestPaths
{
 public:
  ShortestPaths(std::vector<double> cost, int rows, int columns)
      : cost_(std::move(cost)),
        columns_(columns),
        v_(size(columns), 0.0),
        rowOf_(size(columns), kNone),
        columnOf_(size(rows), kNone),
        distance_(size(columns)),
        from_(size(columns))
  {
    for (const int row : bid(rows)) augment(row);
  }

  [[nodiscard]] const std::vector<int>& columnOfRow() const { return columnOf_; }

 private:
  static std::size_t size(int n) { return static_cast<std::size_t>(n); }
  [[nodiscard]] const double* costs(int row) const
  {
    return cost_.data() + size(row) * size(columns_);
  }

  struct TwoBest
  {
    int column = kNone;
    double cost = std::numeric_limits<double>::infinity(), secondCost = cost;
  };
  [[nodiscard]] TwoBest twoBest(int row) const
  {
    TwoBest out;
    const double* c = costs(row);
    for (int j = 0; j < columns_; ++j)
    {
      const double reduced = c[j] - v_[size(j)];
      if (reduced >= out.secondCost) continue;
      const bool isBest = reduced < out.cost;
      out.secondCost = isBest ? out.cost : reduced;
      if (isBest) out.cost = reduced, out.column = j;
    }
    return out;
  }

  /// Augmenting row reduction: each row takes its best column, whose potential falls until the
  /// second best is as good.  A row that lost its column goes on at once while potentials fall.
  /// \return the rows left without a column.
  std::vector<int> bid(int rows)
  {
    std::vector<int> left;
    for (int next = 0; next < rows; ++next)
    {
      int row = next;
      for (int bids = 0; row != kNone && bids < kMostBids; ++bids)
      {
        const TwoBest best = twoBest(row);
        const int loser = rowOf_[size(best.column)];
        const bool falls = columns_ > 1 && best.secondCost > best.cost;
        if (loser != kNone && !falls) break;
        if (falls) v_[size(best.column)] -= best.secondCost - best.cost;
        rowOf_[size(best.column)] = row;
        columnOf_[size(row)] = best.column;
        if (loser != kNone) columnOf_[size(loser)] = kNone;
        row = loser;
      }
      if (row != kNone) left.push_back(row);
    }
    return left;
  }

  /// Gives a row a column, along the cheapest path of reassignments.
  void augment(int row)
  {
    open_.clear();
    for (int j = 0; j < columns_; ++j) open_.push_back(j);
    std::fill(distance_.begin(), distance_.end(), std::numeric_limits<double>::infinity());
    done_.clear();
    int i = row, column = kNone;
    double length = 0;
    while (i != kNone)
    {
      const std::size_t nearest = relax(i, column, length);
      column = open_[nearest];
      length = distance_[size(column)];
      open_[nearest] = open_.back();
      open_.pop_back();
      i = rowOf_[size(column)];
      if (i != kNone) done_.push_back(column);
    }
    for (const int j : done_) v_[size(j)] += distance_[size(j)] - length;
    while (column != kNone)
    {
      const int before = from_[size(column)];
      const int taker = before == kNone ? row : rowOf_[size(before)];
      rowOf_[size(column)] = taker;
      columnOf_[size(taker)] = column;
      column = before;
    }
  }

  /// Goes on from row i, which `column` led to.  \return the place in open_ of the nearest column.
  std::size_t relax(int i, int column, double length)
  {
    const double* c = costs(i);
    const double base = column == kNone ? 0 : length - (c[column] - v_[size(column)]);
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < open_.size(); ++k)
    {
      const auto j = size(open_[k]);
      const double d = base + c[j] - v_[j];
      if (d < distance_[j])
      {
        distance_[j] = d;
        from_[j] = column;
      }
      if (distance_[j] < least) least = distance_[j], nearest = k;
    }
    return nearest;
  }

  std::vector<double> cost_;  // row by row
  int columns_;
  std::vector<double> v_;
  std::vector<int> rowOf_, columnOf_;
  // Of one search: the columns not yet reached for good, and those on the way.
  std::vector<double> distance_;
  std::vector<int> from_, open_, done_;
};

std::vector<double> rowByRow(const Eigen::Ref<const Eigen::MatrixXd>& cost)
{
  std::vector<double> out(static_cast<std::size_t>(cost.size()));
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<RowMajor>(out.data(), cost.rows(), cost.cols()) = cost;
  return out;
}
}  // namespace

std::vector<int> assign(const Eigen::Ref<const Eigen::MatrixXd>& cost)
{
  if (cost.size() == 0) return std::vector<int>(static_cast<std::size_t>(cost.rows()), kNone);
  if (!cost.allFinite()) throw std::domain_error("assignment needs finite costs");
  const int rows = static_cast<int>(cost.rows()), columns = static_cast<int>(cost.cols());
  if (rows <= columns) return ShortestPaths(rowByRow(cost), rows, columns).columnOfRow();

  const auto rowOfColumn = ShortestPaths(rowByRow(cost.transpose()), columns, rows).columnOfRow();
  std::vector<int> out(static_cast<std::size_t>(rows), kNone);
  for (std::size_t j = 0; j < rowOfColumn.size(); ++j)
    out[static_cast<std::size_t>(rowOfColumn[j])] = static_cast<int>(j);
  return out;
}
}  // namespace slamot::math
