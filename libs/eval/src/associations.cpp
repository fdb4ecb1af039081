#include <algorithm>
#include <map>
#include <set>

#include "poseErrors.h"
#include "sameTime.h"

namespace slamot::eval
{
namespace
{
using Outcome = core::Pairing::Outcome;

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

std::optional<double> share(int part, int of)
{
  if (of == 0) return std::nullopt;
  return static_cast<double>(part) / of;
}

/// Takes in one sighting after another, in the order of the run.
class Counter
{
 public:
  Counter(const Record& record, const TrueIds& trueIds)
      : trueIds_(trueIds), founders_(foundersByLandmark(record, trueIds))
  {
  }

  void add(const PairingRow& row)
  {
    const Outcome outcome = row.pairing.outcome;
    if (outcome == Outcome::kNew) ++out_.created;
    if (outcome == Outcome::kRejected) ++out_.rejected;
    const auto truly = trueIds_.of(row);
    if (!truly) return;
    anyTruth_ = true;
    const bool isClutter = *truly == core::kNoId;
    ++(isClutter ? out_.clutter : out_.sightings);
    // Clutter belongs to no landmark, even one made of clutter.
    const bool fits =
        !isClutter && outcome != Outcome::kRejected && founders_.at(row.pairing.id) == *truly;
    if (outcome == Outcome::kKnown) ++(fits ? correct_ : wrong_);
    if (outcome == Outcome::kKnown && isClutter) ++out_.clutterPaired;
    if (outcome == Outcome::kNew && fits && founded_.insert(*truly).second) ++out_.founded;
  }

  [[nodiscard]] AssociationCounts result() const
  {
    AssociationCounts out = out_;
    if (anyTruth_) out.correct = correct_, out.wrong = wrong_;
    return out;
  }

 private:
  const TrueIds& trueIds_;
  std::map<int, int> founders_;
  AssociationCounts out_;
  int correct_ = 0, wrong_ = 0;
  bool anyTruth_ = false;
  std::set<int> founded_;  // true landmarks that have one of the map
};
}  // namespace

std::optional<double> AssociationCounts::rightOfPaired() const
{
  return share(correct.value_or(0), correct.value_or(0) + wrong.value_or(0));
}
std::optional<double> AssociationCounts::rightOfSightings() const
{
  return share(correct.value_or(0) + founded, sightings);
}
std::optional<double> AssociationCounts::pairedOfClutter() const
{
  return share(clutterPaired, clutter);
}

std::map<int, int> foundersByLandmark(const Record& record, const Truth& truth)
{
  return foundersByLandmark(record, TrueIds(truth));
}

std::optional<AssociationCounts> countAssociations(const Record& record, const Truth& truth)
{
  const TrueIds trueIds(truth);
  Counter counter(record, trueIds);
  bool any = false;
  for (const PairingRow& row : record.pairings)
  {
    if (row.pairing.isBlob) continue;
    any = true;
    counter.add(row);
  }
  if (!any) return std::nullopt;
  return counter.result();
}
}  // namespace slamot::eval
