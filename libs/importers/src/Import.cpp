#include <slamot/importers/Import.h>

namespace slamot::importers
{
core::Step Import::deliver(core::Step step)
{
  ++counts_.steps;
  counts_.end = step.time;
  if (step.landmarks)
  {
    ++counts_.landmarkScans;
    counts_.sightings += step.landmarks->sightings.size();
  }
  if (step.blobs)
  {
    ++counts_.blobScans;
    counts_.blobs += step.blobs->blobs.size();
  }
  counts_.lasers += step.lasers.size();
  return step;
}
}  // namespace slamot::importers
