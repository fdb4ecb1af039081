#include <algorithm>
#include <map>

#include "poseErrors.h"

namespace slamot::eval
{
namespace
{
using Outcome = core::Pairing::Outcome;

// Times come from 100 ns ticks on one side and from text on the other.
constexpr double kSameTime = 2e-6;

/// Which landmark each sighting truly was of: as the truth has it, else as the sensor said.
class TrueIds
{
 public:
  explicit TrueIds(const Truth& truth) : truth_(truth) {}

  [[nodiscard]] std::optional<int> of(const PairingRow& row) const
  {
    const auto& list = truth_.associations;
    if (list.empty())
      return row.seenId == core::kNoId ? std::nullopt : std::optional<int>(row.seenId);
    auto it = std::lower_bound(list.begin(), list.end(), row.time - kSameTime,
                               [](const TrueAssociation& a, double time) { return a.time < time; });
    for (; it != list.end() && it->time <= row.time + kSameTime; ++it)
      if (it->index == row.pairing.index) return it->id;
    return std::nullopt;
  }

 private:
  const Truth& truth_;
};

/// The true landmark that most sightings of each mapped one were of; the earliest, if several.
std::map<int, int> foundersByLandmark(const Record& record, const TrueIds& trueIds)
{
  struct Votes
  {
    std::map<int, int> count;
    std::vector<int> order;
  };
  std::map<int, Votes> votes;
  for (const PairingRow& row : record.pairings)
  {
    if (row.pairing.isBlob || row.pairing.outcome == Outcome::kRejected) continue;
    const auto id = trueIds.of(row);
    if (!id) continue;
    Votes& v = votes[row.pairing.id];
    if (++v.count[*id] == 1) v.order.push_back(*id);
  }
  std::map<int, int> out;
  for (const auto& [landmark, v] : votes)
    out[landmark] =
        *std::max_element(v.order.begin(), v.order.end(),
                          [&v = v](int a, int b) { return v.count.at(a) < v.count.at(b); });
  return out;
}
}  // namespace

std::optional<AssociationCounts> countAssociations(const Record& record, const Truth& truth)
{
  const TrueIds trueIds(truth);
  const std::map<int, int> founders = foundersByLandmark(record, trueIds);
  AssociationCounts out;
  int correct = 0, wrong = 0;
  bool any = false, anyTruth = false;
  for (const PairingRow& row : record.pairings)
  {
    if (row.pairing.isBlob) continue;
    any = true;
    const auto truly = trueIds.of(row);
    anyTruth = anyTruth || truly;
    if (row.pairing.outcome == Outcome::kNew) ++out.created;
    if (row.pairing.outcome == Outcome::kRejected) ++out.rejected;
    if (row.pairing.outcome != Outcome::kKnown || !truly) continue;
    // Clutter belongs to no landmark, even one made of clutter.
    const bool right = *truly != core::kNoId && founders.at(row.pairing.id) == *truly;
    ++(right ? correct : wrong);
  }
  if (!any) return std::nullopt;
  if (anyTruth)
  {
    out.correct = correct;
    out.wrong = wrong;
  }
  return out;
}
}  // namespace slamot::eval
