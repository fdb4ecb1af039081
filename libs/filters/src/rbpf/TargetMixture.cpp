#include "TargetMixture.h"

#include "sighting/inView.h"

#include <limits>

namespace slamot::filters::rbpf
{
namespace
{
/// eᵀ P⁻¹ e for a positive definite P, of which the lower triangle is read. Eigen's decompositions
/// take seconds to build.
template <int N>
double squaredLength(Eigen::Matrix<double, N, 1> e, Eigen::Matrix<double, N, N> P)
{
  double sum = 0;
  for (int k = 0; k < N; ++k)
  {
    sum += e[k] * e[k] / P(k, k);
    for (int i = k + 1; i < N; ++i)  // what is left, given the coordinates before
    {
      const double factor = P(i, k) / P(k, k);
      e[i] -= factor * e[k];
      for (int j = k + 1; j <= i; ++j) P(i, j) -= factor * P(j, k);
    }
  }
  return sum;
}

/// Squared Mahalanobis distance of two targets by the covariance of the lighter, grown by a floor:
/// of place, velocity and what else moves on, so that targets that cross are far apart.
template <class Motion>
double distance2(const typename Motion::State& heavy, const typename Motion::State& light,
                 double floorVar, double most)
{
  if (Motion::hasVelocity(heavy) != Motion::hasVelocity(light))
    return std::numeric_limits<double>::infinity();
  const Matrix2 place = light.pointCov() + floorVar * Matrix2::Identity();
  const Vector2 d = heavy.x.template head<2>() - light.x.template head<2>();
  const double det = place.determinant();
  const double d2 =
      (place(1, 1) * d[0] * d[0] - 2 * place(0, 1) * d[0] * d[1] + place(0, 0) * d[1] * d[1]) / det;
  // The distance by all of the state is no less than that by the place.
  if (!(d2 <= most) || !Motion::hasVelocity(light)) return d2;
  const auto a = Motion::kinematics(heavy), b = Motion::kinematics(light);
  auto cov = (b.jacobian * light.P * b.jacobian.transpose()).eval();
  cov.diagonal().array() += floorVar;
  return squaredLength((a.value - b.value).eval(), cov);
}

/// Weighted targets as one with their moments, taken about the first.
template <class Motion>
class Moments
{
 public:
  using State = typename Motion::State;
  explicit Moments(const State& centre) : centre_(centre) {}
  void add(const State& s, double weight)
  {
    auto d = (s.x - centre_.x).eval();
    if constexpr (Motion::kAngle >= 0) d[Motion::kAngle] = math::wrapToPi(d[Motion::kAngle]);
    w_ += weight;
    first_ += weight * d;
    second_ += weight * (s.P + d * d.transpose());
  }
  [[nodiscard]] double weight() const { return w_; }
  [[nodiscard]] State state() const
  {
    State out = centre_;
    const Vector d = first_ / w_;
    out.x += d;
    if constexpr (Motion::kAngle >= 0)
      out.x[Motion::kAngle] = math::wrapToPi(out.x[Motion::kAngle]);
    out.P = second_ / w_ - d * d.transpose();
    out.P = (0.5 * (out.P + out.P.transpose())).eval();
    return out;
  }

 private:
  using Vector = decltype(State::x);
  State centre_;
  double w_ = 0;
  Vector first_ = Vector::Zero();
  decltype(State::P) second_ = decltype(State::P)::Zero();
};

template <class T, class WeightOf>
void sortByWeight(std::vector<T>& list, const WeightOf& weightOf)
{
  std::stable_sort(list.begin(), list.end(),
                   [&](const T& a, const T& b) { return weightOf(a) > weightOf(b); });
}
}  // namespace

template <class Motion>
void TargetMixture<Motion>::begin(const core::BlobScan& scan, const BlobRays& rays,
                                  std::uint64_t number, std::vector<double> noise)
{
  scan_ = &rays;
  fov_ = scan.fov;
  birthKeys_ = labels_.birthKeys(scan.blobs, number);
  noise_ = std::move(noise);
  if (rays.rays.empty()) return;
  rangeVar_ = bearingVar_ = 0;
  for (const Ray& r : rays.rays)
  {
    rangeVar_ = std::max(rangeVar_, r.hasRange ? r.varRange : 0.0);
    bearingVar_ = std::max(bearingVar_, r.varBearing);
  }
}

template <class Motion>
void TargetMixture<Motion>::predict(Mixture& mixture, double dt) const
{
  if (mixture.empty()) return;
  const double survival = std::pow(set_.survival, dt);
  for (Component& c : mixture)
  {
    motion_.predict(c.state, dt);
    c.weight *= survival;
  }
}

template <class Motion>
double TargetMixture<Motion>::detectionAt(const Eye& eye, const State& s) const
{
  constexpr double kLeastVar = 1e-12;  // of a target whose place is known, and no sighting yet
  const double var = largestEigenvalue(s.P(0, 0), s.P(0, 1), s.P(1, 1)) + rangeVar_ + kLeastVar;
  return set_.detection * partInView(fov_, eye, s.x[0], s.x[1], var, bearingVar_ + kLeastVar);
}

/// Density of false blobs like this one [1/(m rad), or 1/rad of a bearing alone].
template <class Motion>
double TargetMixture<Motion>::clutter(std::size_t blob) const
{
  const double width = fov_.bearingMax - fov_.bearingMin;
  return set_.clutter /
         (scan_->rays[blob].hasRange ? width * (fov_.rangeMax - fov_.rangeMin) : width);
}

template <class Motion>
void TargetMixture<Motion>::collect(const Mixture& mixture, const Eye& eye, Scratch& s) const
{
  s.detection.clear();
  s.label.clear();
  for (const Component& c : mixture)
  {
    s.detection.push_back(detectionAt(eye, c.state));
    s.label.push_back(labels_.find(c.label));
  }
}

template <class Motion>
void TargetMixture<Motion>::pair(const Mixture& mixture, const Eye& eye, Scratch& s) const
{
  s.pairs.clear();
  s.evidence.clear();
  for (std::size_t k = 0; k < scan_->rays.size(); ++k)
  {
    const Ray& ray = scan_->rays[k];
    const std::size_t first = s.pairs.size();
    double evidence = clutter(k);
    for (std::size_t j = 0; j < mixture.size(); ++j)
    {
      Innovation o;
      if (s.detection[j] <= 0 || !Tracks::fits(labels_.list()[s.label[j]], (*scan_->blobs)[k]) ||
          !innovateTarget(eye, ray, mixture[j].state, o, nullptr, noise_[s.label[j]]) ||
          o.d2 > (ray.hasRange ? gates_.outer : gates_.outer1))
        continue;
      const double q = std::exp(logDensity(o, ray.hasRange));
      s.pairs.push_back({j, k, o, s.detection[j] * mixture[j].weight * q});
      evidence += s.pairs.back().weight;
    }
    for (std::size_t p = first; p < s.pairs.size(); ++p) s.pairs[p].weight /= evidence;
    s.evidence.push_back(evidence);
  }
}

template <class Motion>
double TargetMixture<Motion>::logWeight(const Mixture& mixture, const Scratch& s) const
{
  double sum = 0;
  for (std::size_t j = 0; j < mixture.size(); ++j) sum -= s.detection[j] * mixture[j].weight;
  for (const double e : s.evidence) sum += std::log(e);
  return sum;
}

template <class Motion>
void TargetMixture<Motion>::split(const Mixture& mixture, const Eye& eye, Scratch& s) const
{
  s.pieces.clear();
  for (std::size_t j = 0; j < mixture.size(); ++j)
  {
    s.pieces.push_back({mixture[j]});
    s.pieces.back().component.weight *= 1 - s.detection[j];
  }
  for (const Pair& p : s.pairs)
  {
    if (p.weight < set_.pruneWeight) continue;
    s.pieces.push_back({mixture[p.component], static_cast<std::int32_t>(p.blob)});
    Component& c = s.pieces.back().component;
    c.weight = p.weight;
    correctTarget(motion_, c.state, eye, scan_->rays[p.blob], p.innovation);
  }
}

// Those with different labels are of different births: one target may have had both, or two that
// are both believed have met; these stay apart unless nothing tells them apart.
template <class Motion>
bool TargetMixture<Motion>::mayMerge(const Component& heavy, const Component& light) const
{
  constexpr double kNearlyTheSame = 0.05;
  double most = set_.mergeDistance2;
  if (heavy.label != light.label)
  {
    const Track& a = labels_.list()[labels_.find(heavy.label)];
    const Track& b = labels_.list()[labels_.find(light.label)];
    if (a.identified || b.identified || a.label != b.label) return false;
    if (a.confirmed && b.confirmed) most *= kNearlyTheSame;
  }
  return distance2<Motion>(heavy.state, light.state, set_.floorVar, most) <= most;
}

template <class Motion>
void TargetMixture<Motion>::merge(Mixture& mixture, Scratch& s) const
{
  sortByWeight(s.pieces, [](const Piece& p) { return p.component.weight; });
  mixture.clear();
  s.blobs.clear();
  for (std::size_t i = 0; i < s.pieces.size(); ++i)
  {
    const Component& heavy = s.pieces[i].component;
    if (heavy.weight < set_.pruneWeight) break;
    if (s.pieces[i].merged) continue;
    Moments<Motion> moments(heavy.state);
    moments.add(heavy.state, heavy.weight);
    bool isAlone = true;
    for (std::size_t k = i + 1; k < s.pieces.size(); ++k)
    {
      Piece& light = s.pieces[k];
      if (light.merged || !mayMerge(heavy, light.component)) continue;
      light.merged = true;
      isAlone = false;
      moments.add(light.component.state, light.component.weight);
    }
    mixture.push_back(heavy);
    s.blobs.push_back(s.pieces[i].blob);
    if (isAlone) continue;
    mixture.back().state = moments.state();
    mixture.back().weight = moments.weight();
  }
}

// Two targets may come under one label, where the second was born beside the first.  What is too
// much for one target then takes the label that its blob has for something new.
template <class Motion>
void TargetMixture<Motion>::divide(Mixture& mixture, const Scratch& s) const
{
  for (std::size_t j = 1; j < mixture.size(); ++j)
  {
    if (s.blobs[j] < 0 || labels_.list()[labels_.find(mixture[j].label)].identified) continue;
    double sum = mixture[j].weight;
    for (std::size_t i = 0; i < j; ++i)
      if (mixture[i].label == mixture[j].label) sum += mixture[i].weight;
    const auto blob = static_cast<std::size_t>(s.blobs[j]);
    if (sum > kMostOfOneTarget && sum > mixture[j].weight && mayStart(*scan_, blob))
      mixture[j].label = birthKeys_[blob];
  }
}

// What explains each blob: the label of the component with the largest share, unless most is left
// to clutter.
template <class Motion>
void TargetMixture<Motion>::explain(std::vector<std::int32_t>& matches, Scratch& s) const
{
  matches.assign(s.evidence.size(), kRejected);
  s.shares.assign(s.evidence.size(), 0);
  for (const Pair& p : s.pairs)
  {
    if (2 * clutter(p.blob) > s.evidence[p.blob] || p.weight <= s.shares[p.blob]) continue;
    s.shares[p.blob] = p.weight;
    matches[p.blob] = static_cast<std::int32_t>(s.label[p.component]);
  }
}

template <class Motion>
void TargetMixture<Motion>::bear(Mixture& mixture, const Eye& eye,
                                 std::vector<std::int32_t>& matches) const
{
  for (std::size_t k = 0; k < matches.size(); ++k)
  {
    if (matches[k] != kRejected || !mayStart(*scan_, k)) continue;
    mixture.push_back(
        {motion_.birth(invert(eye, scan_->rays[k])), set_.birthWeight, birthKeys_[k]});
    matches[k] = kNew;
  }
  sortByWeight(mixture, [](const Component& c) { return c.weight; });
  const auto most = static_cast<std::size_t>(set_.mostComponents);
  if (mixture.size() > most) mixture.resize(most);
}

template <class Motion>
double TargetMixture<Motion>::update(Mixture& mixture, const Eye& eye,
                                     std::vector<std::int32_t>& matches, Scratch& s) const
{
  collect(mixture, eye, s);
  pair(mixture, eye, s);
  const double weight = logWeight(mixture, s);
  split(mixture, eye, s);
  merge(mixture, s);
  divide(mixture, s);
  explain(matches, s);
  bear(mixture, eye, matches);
  return weight;
}

template <class Motion>
const typename TargetMixture<Motion>::Component* TargetMixture<Motion>::heaviest(
    const Mixture& mixture, std::uint64_t label)
{
  for (const Component& c : mixture)
    if (c.label == label) return &c;
  return nullptr;
}

template class TargetMixture<models::DifferentialDriveTarget>;
template class TargetMixture<models::DampedVelocityTarget>;
template class TargetMixture<models::ConstantVelocityTarget>;
template class TargetMixture<models::ConstantAccelerationTarget>;
template class TargetMixture<models::ManoeuvringTarget>;
}  // namespace slamot::filters::rbpf
