#include "Hypotheses.h"

#include "relate.h"

#include <slamot/core/Error.h>

#include <Eigen/Cholesky>

#include <utility>

namespace slamot::filters::ekf
{
using Kind = core::Pairing::Outcome;

namespace
{
constexpr int kMostAtOnce = 3;  // times those kept: some will be one

/// Sorts by weight, and leaves out those beyond `most` and less likely than `least` of the first.
template <class T>
void cut(std::vector<T>& list, int most, double least)
{
  std::stable_sort(list.begin(), list.end(),
                   [](const T& a, const T& b) { return a.logWeight > b.logWeight; });
  const double first = list.front().logWeight, floor = first + std::log(least);
  const auto end = std::find_if(list.begin() + 1, list.end(),
                                [&](const T& h) { return !(h.logWeight >= floor); });
  list.erase(end, list.end());
  if (static_cast<int>(list.size()) > most) list.erase(list.begin() + most, list.end());
}

/// Whether two put the robots at the same places, as far as they know.
bool agree(const Belief& a, const Belief& b, double distance2)
{
  constexpr double kGrowth = 0.2;                    // of a variance
  const Matrix3 floor = 1e-8 * Matrix3::Identity();  // a start may be known exactly
  for (int r = 0; r < a.robots(); ++r)
  {
    const int j = a.robot(r);
    const Matrix3 A = a.P().block<3, 3>(j, j) + floor, B = b.P().block<3, 3>(j, j) + floor;
    Vector3 d = a.x().segment<3>(j) - b.x().segment<3>(j);
    d[2] = math::wrapToPi(d[2]);
    const Eigen::LDLT<Matrix3> ldlt(A);
    // tr(A⁻¹ B) is 3 where they agree.
    if (!(d.dot(ldlt.solve(d)) < distance2 && std::abs(ldlt.solve(B).trace() - 3) < 3 * kGrowth))
      return false;
  }
  return true;
}

void wrapHeading(Belief& belief, int robot)
{
  double& heading = belief.x()[robot + 2];
  heading = math::wrapToPi(heading);
}
}  // namespace

Hypotheses::Hypotheses(const Settings& settings, std::unique_ptr<Hypothesis> first)
    : settings_(settings)
{
  list_.push_back({std::move(first), 0, {}, 0});
}

Hypothesis& Hypotheses::best() const
{
  if (list_.empty()) failOverflow();
  return *list_.front().filter;
}

core::Update Hypotheses::process(int robot, const core::Step& step)
{
  (void)best();
  for (Weighted& h : list_)
  {
    h.pairings.clear();
    h.close = 0;
    h.filter->move(robot, step);
  }
  List list = std::exchange(list_, {});  // an overflow from here on leaves none
  if (step.landmarks)
  {
    List next;
    for (Weighted& h : list)
    {
      List children = branch(std::move(h), robot, *step.landmarks, step.time);
      std::move(children.begin(), children.end(), std::back_inserter(next));
      cut(next, kMostAtOnce * settings_.arrival->most, settings_.arrival->least);
    }
    list = likeliestOf(std::move(next));
  }
  core::Update out;
  for (std::size_t i = list.size(); i-- > 0;)
    out = list[i].filter->take(robot, step, nullptr);  // the last is the likeliest's
  out.pairings.insert(out.pairings.begin(), list.front().pairings.begin(),
                      list.front().pairings.end());
  out.diagnostics.close += list.front().close;
  list_ = std::move(list);
  return out;
}

// Those that agree on where the robot is differ in what will not matter, and are one.
Hypotheses::List Hypotheses::likeliestOf(List list) const
{
  cut(list, static_cast<int>(list.size()), settings_.arrival->least);
  List kept;
  for (Weighted& h : list)
  {
    const auto same = std::find_if(
        kept.begin(), kept.end(),
        [&](Weighted& k)
        { return agree(k.filter->belief(), h.filter->belief(), settings_.arrival->merge); });
    if (same == kept.end())
      kept.push_back(std::move(h));
    else
      same->logWeight += std::log1p(std::exp(h.logWeight - same->logWeight));
  }
  cut(kept, settings_.arrival->most, settings_.arrival->least);
  const double likeliest = kept.front().logWeight;
  for (Weighted& h : kept) h.logWeight -= likeliest;
  return kept;
}

Hypotheses::List Hypotheses::branch(Weighted&& parent, int robot, const core::LandmarkScan& scan,
                                    double time) const
{
  const int r = parent.filter->belief().robot(robot);
  const std::vector<Ray> rays = parent.filter->map().begin(r, scan, time);
  std::vector<std::size_t> open;
  takeUndoubted(parent, r, rays, time, open);
  List out;
  out.push_back(std::move(parent));
  for (const std::size_t k : open) out = split(std::move(out), r, rays[k], k, time);
  for (Weighted& h : out)
  {
    h.logWeight += h.filter->map().miss(r, time);
    if (std::isnan(h.logWeight)) failOverflow();
    std::sort(h.pairings.begin(), h.pairings.end(),
              [](const auto& a, const auto& b) { return a.index < b.index; });
  }
  return out;
}

// Sightings that can be of one landmark only, which no other one can be of, update at once. `open`
// becomes the others, those of fewest things first: each pose that is left has less in doubt then.
void Hypotheses::takeUndoubted(Weighted& of, int robot, const std::vector<Ray>& rays, double time,
                               std::vector<std::size_t>& open) const
{
  Map& map = of.filter->map();
  std::vector<std::vector<Map::Alternative>> all;
  std::map<std::int32_t, int> claims;
  for (const Ray& ray : rays)
  {
    all.push_back(map.alternatives(robot, ray, time));
    for (const auto& a : all.back()) ++claims[a.thing];
  }
  std::vector<SightingRows> rows;
  double densities = 0;
  for (std::size_t k = 0; k < rays.size(); ++k)
  {
    const Map::Alternative& a = all[k].front();
    if (a.thing == kNew || all[k].size() > 1 || claims[a.thing] > 1)
    {
      open.push_back(k);
      continue;
    }
    rows.push_back(a.rows);
    of.close += isClose(a.rows);
    densities += std::log(a.density);
    of.logWeight += a.logWeight;
    const std::int32_t slot = map.take(robot, rays[k], k, a, time);
    of.pairings.push_back({false, static_cast<int>(k), Kind::kKnown, map.idOf(slot)});
  }
  // What they are likely together, not each by itself.
  of.logWeight += of.filter->belief().update(rows) - densities;
  wrapHeading(of.filter->belief(), robot);
  std::stable_sort(open.begin(), open.end(),
                   [&](std::size_t a, std::size_t b)
                   {
                     const auto doubt = [&](std::size_t k) {
                       return all[k].front().thing == kNew ? rays.size() + all[k].size()
                                                           : all[k].size();
                     };
                     return doubt(a) < doubt(b);
                   });
}

void Hypotheses::takeOne(Weighted& of, int robot, const Ray& ray, std::size_t k,
                         const Map::Alternative& as, double time) const
{
  if (as.thing != kNew)
  {
    of.filter->belief().update({as.rows});
    of.close += isClose(as.rows);
    wrapHeading(of.filter->belief(), robot);
  }
  Map& map = of.filter->map();
  const std::int32_t slot = map.take(robot, ray, k, as, time);
  of.logWeight += as.logWeight;
  of.pairings.push_back(
      {false, static_cast<int>(k), as.thing == kNew ? Kind::kNew : Kind::kKnown, map.idOf(slot)});
}

Hypotheses::List Hypotheses::split(List&& of, int robot, const Ray& ray, std::size_t k,
                                   double time) const
{
  struct Child
  {
    std::size_t parent;
    Map::Alternative as;
    double logWeight;
  };
  std::vector<Child> children;
  for (std::size_t i = 0; i < of.size(); ++i)
    for (Map::Alternative& a : of[i].filter->map().alternatives(robot, ray, time))
    {
      const double weight = of[i].logWeight + a.logWeight;
      children.push_back({i, std::move(a), weight});
    }
  cut(children, settings_.arrival->most, 0.1 * settings_.arrival->least);
  List out;
  for (std::size_t c = 0; c < children.size(); ++c)
  {
    const std::size_t i = children[c].parent;
    const bool isLast = std::none_of(children.begin() + static_cast<std::ptrdiff_t>(c) + 1,
                                     children.end(), [&](const Child& o) { return o.parent == i; });
    out.push_back({isLast ? std::move(of[i].filter) : of[i].filter->clone(), of[i].logWeight,
                   of[i].pairings, of[i].close});
    takeOne(out.back(), robot, ray, k, children[c].as, time);
  }
  return out;
}

std::vector<double> Hypotheses::weights() const
{
  std::vector<double> out;
  double sum = 0;
  for (const Weighted& h : list_)
    sum += out.emplace_back(std::exp(h.logWeight - list_.front().logWeight));
  for (double& w : out) w /= sum;
  return out;
}

core::Fusion Hypotheses::fuse(const core::Evidence& evidence, const core::FusionOptions& options)
{
  const core::Fusion out = best().fuse(evidence, options);
  // One that follows other targets can't be told of this one.
  const auto cannot = [&](const Weighted& h)
  {
    try
    {
      (void)h.filter->fuse(evidence, options);
      return false;
    }
    catch (const core::Error&)
    {
      return true;
    }
  };
  list_.erase(std::remove_if(list_.begin() + 1, list_.end(), cannot), list_.end());
  return out;
}
}  // namespace slamot::filters::ekf
