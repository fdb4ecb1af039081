#include <slamot/core/FilterRegistry.h>
#include <slamot/scans/ScanSlamFilter.h>
#include <slamot/scans/ScanSlamotFilter.h>
#include <slamot/scans/registerAll.h>

namespace slamot::scans
{
namespace
{
template <class F>
void add(const char* name)
{
  core::FilterRegistry::instance().add(name, [](core::Params& p, const core::FilterContext& c)
                                       { return std::make_unique<F>(p, c); });
}
}  // namespace

void registerAll()
{
  static const bool once = []
  {
    add<ScanSlamFilter>("scan-slam");
    add<ScanSlamotFilter>("scan-slamot");
    return true;
  }();
  (void)once;
}
}  // namespace slamot::scans
