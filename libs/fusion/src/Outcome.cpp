#include <slamot/fusion/Outcome.h>

#include <numeric>

namespace slamot::fusion
{
namespace
{
constexpr std::array<const char*, static_cast<std::size_t>(Outcome::kCount)> kOutcomes = {
    "fused",
    "did_not_pay",
    "fusion_off",
    "wrong_version",
    "wrong_length",
    "wrong_checksum",
    "contradictory",
    "from_itself",
    "unknown_sender",
    "to_another",
    "other_frame",
    "not_newer",
    "too_old",
    "from_the_future",
    "not_finite",
    "absurd",
    "not_positive_definite",
    "no_such_target",
    "nothing_usable",
    "target_gate_failed",
    "candidate_gate_failed",
    "refused_by_filter"};
constexpr std::array<const char*, static_cast<std::size_t>(Note::kCount)> kNotes = {
    "ambiguous",        "late_candidates", "candidates_outside",
    "could_be_another", "candidate_fused", "target_fused"};
}  // namespace

const char* name(Outcome outcome)
{
  return kOutcomes.at(static_cast<std::size_t>(outcome));
}

const char* name(Note note)
{
  return kNotes.at(static_cast<std::size_t>(note));
}

std::int64_t MessageCounts::messages() const
{
  return std::accumulate(outcomes_.begin(), outcomes_.end(), std::int64_t{0});
}

std::vector<std::pair<std::string, std::int64_t>> MessageCounts::rows() const
{
  std::vector<std::pair<std::string, std::int64_t>> out;
  for (std::size_t i = 0; i < outcomes_.size(); ++i) out.emplace_back(kOutcomes[i], outcomes_[i]);
  for (std::size_t i = 0; i < notes_.size(); ++i) out.emplace_back(kNotes[i], notes_[i]);
  return out;
}
}  // namespace slamot::fusion
