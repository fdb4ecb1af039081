#include "drives.h"
#include "filterRig.h"

#include <slamot/laws/checkFilter.h>
#include <slamot/math/statistics.h>
#include <slamot/sim/World.h>

namespace slamot::filters
{
namespace
{
class FilterLaws : public ::testing::TestWithParam<test::Way>
{
};
INSTANTIATE_TEST_SUITE_P(Each, FilterLaws, ::testing::ValuesIn(test::kWays), test::nameOf);
}  // namespace

TEST_P(FilterLaws, AreObeyed)
{
  registerAll();
  const core::Config config =
      core::Config::parse("[rbpf-slamot]\n" + test::keysOf(GetParam(), 40), "test");
  laws::LawOptions options;
  options.world = test::worldOf(GetParam());
  options.runs = 60;
  options.robotNees = {0.8, 100, "measure"};
  options.targetNees = {0.5, 100, "measure"};
  laws::checkFilter("rbpf-slamot", config, options);
}
}  // namespace slamot::filters
