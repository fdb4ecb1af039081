#include <slamot/math/assignment.h>

#include <limits>
#include <stdexcept>

namespace slamot::math
{
namespace
{
constexpr int kNone = -1;

// Rows are added one by one, each along the cheapest path of reassignments; the potentials u, v
// keep all reduced costs cost(i, j) - u[i] - v[j] at or above zero.
class AugmentingPaths
{
 public:
  explicit AugmentingPaths(const Eigen::Ref<const Eigen::MatrixXd>& cost)
      : cost_(cost), u_(rows(), 0.0), v_(columns(), 0.0), rowOf_(columns(), kNone)
  {
    for (std::size_t row = 0; row < rows(); ++row) addRow(static_cast<int>(row));
  }

  [[nodiscard]] std::vector<int> columnOfRow() const
  {
    std::vector<int> out(rows(), kNone);
    for (std::size_t j = 0; j < columns(); ++j)
      if (rowOf_[j] != kNone) out[static_cast<std::size_t>(rowOf_[j])] = static_cast<int>(j);
    return out;
  }

 private:
  struct Search
  {
    std::vector<double> distance;
    std::vector<int> from;  // column before, on the path to this one
    std::vector<bool> done;
  };

  [[nodiscard]] std::size_t rows() const { return static_cast<std::size_t>(cost_.rows()); }
  [[nodiscard]] std::size_t columns() const { return static_cast<std::size_t>(cost_.cols()); }

  void addRow(int row)
  {
    Search s{std::vector<double>(columns(), std::numeric_limits<double>::infinity()),
             std::vector<int>(columns(), kNone), std::vector<bool>(columns(), false)};
    double length = 0;
    int column = kNone;
    for (int i = row; i != kNone; i = rowOf_[static_cast<std::size_t>(column)])
    {
      relax(s, i, column, length);
      column = nearest(s);
      length = s.distance[static_cast<std::size_t>(column)];
      s.done[static_cast<std::size_t>(column)] = true;
    }
    updatePotentials(s, row, length);
    for (int j = column; j != kNone; j = s.from[static_cast<std::size_t>(j)])
    {
      const int before = s.from[static_cast<std::size_t>(j)];
      rowOf_[static_cast<std::size_t>(j)] =
          before == kNone ? row : rowOf_[static_cast<std::size_t>(before)];
    }
  }

  void relax(Search& s, int i, int column, double length) const
  {
    for (std::size_t j = 0; j < columns(); ++j)
    {
      if (s.done[j]) continue;
      const double d =
          length + cost_(i, static_cast<Eigen::Index>(j)) - u_[static_cast<std::size_t>(i)] - v_[j];
      if (d >= s.distance[j]) continue;
      s.distance[j] = d;
      s.from[j] = column;
    }
  }

  [[nodiscard]] int nearest(const Search& s) const
  {
    std::size_t best = columns();
    for (std::size_t j = 0; j < columns(); ++j)
      if (!s.done[j] && (best == columns() || s.distance[j] < s.distance[best])) best = j;
    return static_cast<int>(best);
  }

  void updatePotentials(const Search& s, int row, double length)
  {
    u_[static_cast<std::size_t>(row)] += length;
    for (std::size_t j = 0; j < columns(); ++j)
    {
      if (!s.done[j]) continue;
      const double slack = length - s.distance[j];
      v_[j] -= slack;
      if (rowOf_[j] != kNone) u_[static_cast<std::size_t>(rowOf_[j])] += slack;
    }
  }

  const Eigen::Ref<const Eigen::MatrixXd>& cost_;
  std::vector<double> u_, v_;
  std::vector<int> rowOf_;
};
}  // namespace

std::vector<int> assign(const Eigen::Ref<const Eigen::MatrixXd>& cost)
{
  if (cost.size() == 0) return std::vector<int>(static_cast<std::size_t>(cost.rows()), kNone);
  if (!cost.allFinite()) throw std::domain_error("assignment needs finite costs");
  if (cost.rows() <= cost.cols()) return AugmentingPaths(cost).columnOfRow();

  const Eigen::MatrixXd transposed = cost.transpose();
  const std::vector<int> rowOfColumn = AugmentingPaths(transposed).columnOfRow();
  std::vector<int> out(static_cast<std::size_t>(cost.rows()), kNone);
  for (std::size_t j = 0; j < rowOfColumn.size(); ++j)
    out[static_cast<std::size_t>(rowOfColumn[j])] = static_cast<int>(j);
  return out;
}
}  // namespace slamot::math
