#pragma once

#include <Eigen/Core>
#include <vector>

namespace slamot::math
{
/// The assignment of rows to columns with the smallest sum of costs: for each row its column, or -1
/// for the rows left over where there are more rows than columns.  Exact, in O(n² m).
/// Shortest augmenting paths: Jonker, Volgenant, "A shortest augmenting path algorithm for dense
/// and sparse linear assignment problems", 1987.
/// \throws std::domain_error if a cost is not finite.
[[nodiscard]] std::vector<int> assign(const Eigen::Ref<const Eigen::MatrixXd>& cost);
}  // namespace slamot::math
