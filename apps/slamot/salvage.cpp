#include "salvage.h"

#include <cstdio>

namespace slamot::apps
{
void tellSalvaged(const std::string& truncation, const eval::Record& record)
{
  const double span = record.steps.empty() ? 0 : record.steps.back().time - record.steps[0].time;
  std::fprintf(stderr, "slamot: error: %s; its first %zu steps, %.2f s, were used\n",
               truncation.substr(0, truncation.rfind("; ")).c_str(), record.steps.size(), span);
}
}  // namespace slamot::apps
