#include <slamot/results/hints.h>

#include <algorithm>

namespace slamot::results
{
namespace
{
using Outcome = core::Pairing::Outcome;

/// What became of the sightings of landmarks, or of the blobs.
struct Tally
{
  std::size_t all = 0, rejected = 0, nameless = 0, namelessRejected = 0;
};

Tally tally(const eval::Record& record, bool blobs)
{
  Tally t;
  for (const eval::PairingRow& row : record.pairings)
  {
    if (row.pairing.isBlob != blobs) continue;
    const bool rejected = row.pairing.outcome == Outcome::kRejected;
    const bool nameless = row.seenId == core::kNoId;
    ++t.all;
    t.rejected += rejected ? 1 : 0;
    t.nameless += nameless ? 1 : 0;
    t.namelessRejected += rejected && nameless ? 1 : 0;
  }
  return t;
}

std::string noIdentities(const Tally& t, const std::string& method)
{
  return std::to_string(t.nameless) + " of " + std::to_string(t.all) +
         " landmark sightings have no identity and were rejected; to pair them by place: --set " +
         method + ".association=nn";
}

std::string noTarget(const Tally& t, const std::string& method)
{
  const std::string none = "no target among " + std::to_string(t.all) + " blobs: ";
  if (t.rejected == t.all)
    return none + "none has a range, and a target starts at a blob with a range, or from [start]";
  return none + "none was seen " + method + ".target_confirm_sightings times with pauses up to " +
         method + ".target_tentative_s; lower the one or raise the other";
}
}  // namespace

std::vector<std::string> hintsOf(const eval::Record& record, const std::string& method)
{
  std::vector<std::string> hints;
  const Tally sightings = tally(record, false), blobs = tally(record, true);
  // Some without identity may be clutter; most, all of them refused, are a wrong setting.
  if (2 * sightings.nameless > sightings.all && sightings.namelessRejected == sightings.nameless)
    hints.push_back(noIdentities(sightings, method));
  else if (record.hasMap && record.landmarks.empty() && sightings.all > 0)
    hints.push_back("no landmark among " + std::to_string(sightings.all) +
                    " sightings: none was seen " + method +
                    ".confirm_sightings times; lower it, or check the log's deviations");
  if (record.targets.empty() && blobs.all > 0) hints.push_back(noTarget(blobs, method));
  const bool scanned = std::any_of(record.steps.begin(), record.steps.end(),
                                   [](const eval::StepRow& s) { return s.scan; });
  if (record.hasMap && !record.steps.empty() && !scanned)
    hints.push_back(
        "the log holds no landmark sightings and no blobs, so the path is odometry's; see what it "
        "holds with slamot info");
  return hints;
}
}  // namespace slamot::results
