#include "Relations.h"

#include <slamot/importers/TextTable.h>

namespace slamot::importers
{
namespace
{
using core::ExitStatus;

constexpr double kOutOfPlane = 0.1;  // [m, rad]
}  // namespace

std::vector<eval::Relation> readRelations(const std::string& path)
{
  auto table = TextTable::blanks(path, {"t1", "t2", "dx", "dy", "dz", "droll", "dpitch", "dyaw"});
  std::vector<eval::Relation> out;
  while (table.next())
  {
    const eval::Relation r{table.number(0),
                           table.number(1),
                           {table.number(2), table.number(3), math::wrapToPi(table.number(7))}};
    if (r.from == r.to)
      table.fail(ExitStatus::kNonsense, "relates a time to itself", "remove the row");
    for (const std::size_t column : {4, 5, 6})
      if (std::abs(table.number(column)) > kOutOfPlane)
        table.failAt(column, ExitStatus::kNonsense, "the relation leaves the plane",
                     "give relations of a drive on a floor");
    out.push_back(r);
  }
  if (out.empty()) table.fail(ExitStatus::kUnreadable, "holds no rows", "copy it again");
  return out;
}
}  // namespace slamot::importers
