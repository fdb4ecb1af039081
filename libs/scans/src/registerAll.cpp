#include <slamot/core/FilterRegistry.h>
#include <slamot/scans/ScanSlamFilter.h>
#include <slamot/scans/registerAll.h>

namespace slamot::scans
{
void registerAll()
{
  static const bool once = []
  {
    core::FilterRegistry::instance().add("scan-slam",
                                         [](core::Params& p, const core::FilterContext& c)
                                         { return std::make_unique<ScanSlamFilter>(p, c); });
    return true;
  }();
  (void)once;
}
}  // namespace slamot::scans
