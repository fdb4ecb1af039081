#pragma once

namespace slamot::filters
{
/// Adds the built-in filters to the registry; further calls do nothing.  Explicit, since static
/// libraries drop registrars that nobody refers to.
void registerAll();
}  // namespace slamot::filters
