#pragma once

namespace slamot::scans
{
/// Adds the filters that live on laser scans to core::FilterRegistry.  Once is enough; more does
/// nothing.
void registerAll();
}  // namespace slamot::scans
