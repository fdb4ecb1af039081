#include "LandmarkScan.h"

#include <algorithm>
#include <limits>

namespace slamot::filters::rbpf
{
namespace
{
constexpr int kFirstHits = 2;  // sightings of a track before it counts: a lone one may be false
constexpr double kLogTwoPi = 1.8378770664093453;

double mostLikely(const std::vector<Choice>& choices)
{
  double most = choices[0].logLikelihood;
  for (const Choice& c : choices) most = std::max(most, c.logLikelihood);
  return most;
}

double logSum(const std::vector<Choice>& choices)
{
  const double most = mostLikely(choices);
  double sum = 0;
  for (const Choice& c : choices) sum += std::exp(c.logLikelihood - most);
  return most + std::log(sum);
}

const Choice& draw(const std::vector<Choice>& choices, double logTotal, math::RandomStream& random)
{
  double left = random.uniform();
  for (const Choice& c : choices)
    if ((left -= std::exp(c.logLikelihood - logTotal)) < 0) return c;
  return choices.back();
}
}  // namespace

void LandmarkScan::listChoices(const maps::LandmarkMap& map, const Eye& eye,
                               const PoseUpdate::Result& pose, std::size_t j,
                               const std::vector<std::int32_t>& matches,
                               std::vector<Choice>& choices) const
{
  choices.assign(1, {kNew, logNew_[j], {}});
  const Matrix3 poseCov = pose.root * pose.root.transpose();
  for (const std::uint32_t slot : slots_.near(j))
  {
    const auto what = static_cast<std::int32_t>(slot);
    const maps::Landmark* m = map.find(slot);
    if (!m || std::find(matches.begin(), matches.end(), what) != matches.end()) continue;
    Innovation o;
    // With the sighting's whole noise, as in match().
    if (!innovateLandmark(eye, j, *m, &poseCov, o, 1)) continue;
    const Innovation now = withPose(shifted(o, pose.shift), poseCov);
    if (now.d2 <= settings_.gates.outer)
      choices.push_back({what, -0.5 * (now.d2 + std::log(now.det)) - kLogTwoPi, o});
  }
}

PoseUpdate LandmarkScan::continueTracks(const maps::LandmarkMap& map, const Eye& eye,
                                        const Matrix3& root, std::vector<std::int32_t>& followed,
                                        TrackScratch& scratch,
                                        std::vector<std::int32_t>& matches) const
{
  const Matrix3 poseCov = root * root.transpose();
  scratch.candidates.clear();
  scratch.innovations.resize(slots_.size());
  for (std::size_t j = 0; j < slots_.size(); ++j)
  {
    std::int32_t& slot = followed[tracks_.place(j)];
    if (tracks_.hits(j) == 1) slot = kNew;
    Innovation& o = scratch.innovations[j];
    const maps::Landmark* m = slot >= 0 ? map.find(static_cast<std::uint32_t>(slot)) : nullptr;
    if (!m ||
        !innovateLandmark(eye, j, *m, &poseCov, o, slots_.noise(static_cast<std::uint32_t>(slot))))
      continue;
    const Innovation now = withPose(o, poseCov);
    if (now.d2 <= settings_.gates.outer)
      scratch.candidates.push_back(
          {now.d2 + std::log(now.det), static_cast<std::int32_t>(j), slot, true});
  }
  // Two tracks may be of one landmark, each begun while the other was out of sight: the one that
  // fits better keeps it.
  matchGreedily(scratch.candidates, matches);
  PoseUpdate update;
  scratch.open.clear();
  for (std::size_t j = 0; j < slots_.size(); ++j)
    if (matches[j] >= 0)
      update.add(scratch.innovations[j]);
    else
    {
      matches[j] = kRejected;
      if (tracks_.hits(j) >= kFirstHits) scratch.open.push_back(j);
    }
  return update;
}

std::vector<std::size_t>::iterator LandmarkScan::clearest(const maps::LandmarkMap& map,
                                                          const Eye& eye,
                                                          const PoseUpdate::Result& pose,
                                                          const std::vector<std::int32_t>& matches,
                                                          TrackScratch& scratch) const
{
  double leastDoubt = std::numeric_limits<double>::infinity();
  auto out = scratch.open.begin();
  for (auto it = scratch.open.begin(); it != scratch.open.end(); ++it)
  {
    listChoices(map, eye, pose, *it, matches, scratch.choices);
    const double doubt = logSum(scratch.choices) - mostLikely(scratch.choices);
    if (!(doubt < leastDoubt)) continue;
    leastDoubt = doubt;
    out = it;
    scratch.chosen.swap(scratch.choices);
  }
  return out;
}

double LandmarkScan::matchTracks(const maps::LandmarkMap& map, const Eye& eye, const Matrix3& root,
                                 std::vector<std::int32_t>& followed, math::RandomStream& random,
                                 TrackScratch& scratch, std::vector<std::int32_t>& matches) const
{
  followed.resize(tracks_.capacity(), kNew);
  matches.resize(slots_.size());
  PoseUpdate update = continueTracks(map, eye, root, followed, scratch, matches);
  double logGain = 0;
  while (!scratch.open.empty())
  {
    const auto next = clearest(map, eye, update.solve(root), matches, scratch);
    const std::size_t j = *next;
    const double total = logSum(scratch.chosen);
    const Choice& choice = draw(scratch.chosen, total, random);
    matches[j] = choice.what;
    followed[tracks_.place(j)] =
        choice.what >= 0 ? choice.what : static_cast<std::int32_t>(slots_.newSlot(j));
    logGain += total - choice.logLikelihood;
    if (choice.what >= 0) update.add(choice.innovation);
    scratch.open.erase(next);
  }
  return logGain;
}
}  // namespace slamot::filters::rbpf
