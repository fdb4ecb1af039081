#include <slamot/fusion/mates.h>

#include <algorithm>

namespace slamot::fusion
{
void takeOutMates(core::Step& step, const std::string& label)
{
  if (!step.blobs || label.empty()) return;
  auto& blobs = step.blobs->blobs;
  const auto isMate = [&](const core::Blob& b) { return b.label == label; };
  blobs.erase(std::remove_if(blobs.begin(), blobs.end(), isMate), blobs.end());
}
}  // namespace slamot::fusion
