#pragma once

#include "LandmarkScan.h"

namespace slamot::filters::rbpf
{
/// A particle's map as an intensity: the landmarks are a random finite set, and the map is the
/// Gaussian mixture D(m) = Σ w N(m; μ, P) whose integral over a region is the number of landmarks
/// expected there.  Vo and Ma 2006 for the mixture; Mullane, Vo, Adams, Vo 2011 for SLAM with it;
/// Xin, Jia, Gou 2014 with unscented transforms, as corrected: equation (23) multiplies the
/// intensity into the terms of detection, and each sighting updates the map once.
///
/// A component is a maps::Landmark whose `existence` is its weight w.  Those in view are updated:
///     D' = (1 - p_D) D + Σ_z Σ_j w_j(z) N(μ_j(z), P_j),
///     w_j(z) = p_D w_j q_j(z) / (c + Σ_l p_D w_l q_l(z)),   q_j(z) = N(z; h(μ_j), S_j),
/// then pruned, merged and capped.  A sighting that no component explains bears one, small, which
/// counts from the next scan on.
class Intensity
{
 public:
  Intensity(const Settings& settings, LandmarkScan& scan, maps::LandmarkPool& pool)
      : settings_(settings), scan_(scan), pool_(pool)
  {
  }

  struct Component
  {
    maps::Landmark at{};
    double detection = 0;  ///< p_D at its place
    std::uint32_t slot = 0;
  };
  struct Pair
  {
    std::size_t component, sighting;
    Innovation innovation;
    double weight;  ///< p_D w q, then w_j(z)
  };
  /// A component of the posterior before merging.
  struct Piece
  {
    maps::Landmark at{};
    double weight = 0;
    std::uint32_t slot = 0;
    std::int32_t sighting = kNew;  ///< that it took in; kNew: none
    bool merged = false;
  };
  struct Scratch
  {
    std::vector<Component> components;
    std::vector<Pair> pairs;
    std::vector<double> evidence;  ///< c + Σ p_D w q, of each sighting
    std::vector<double> shares;    ///< the largest of any component, of each sighting
    std::vector<Piece> pieces, merged;
  };

  /// Takes the scan into a particle's map, seen from its pose.
  /// \param matches becomes, for each sighting, the slot of what explains it best, kNew where it
  /// bore a component, or kRejected: clutter.
  /// \return log of the particle's weight by this scan.
  double update(maps::LandmarkMap& map, const Eye& eye, std::vector<std::int32_t>& matches,
                Scratch& scratch, int lane);

  /// p_D at a component's place: the detection probability, times how much of it is in view.
  [[nodiscard]] double detectionAt(const Eye& eye, const maps::Landmark& m) const;

  // The steps of update(), each on its own for tests.
  void collect(const maps::LandmarkMap& map, const Eye& eye, Scratch& scratch) const;
  void pair(const Eye& eye, Scratch& scratch) const;
  [[nodiscard]] double logWeight(const Eye& eye, const Scratch& scratch) const;
  void split(Scratch& scratch) const;
  void merge(Scratch& scratch) const;

 private:
  [[nodiscard]] double logSingleFeature(const Eye& eye, const Scratch& scratch) const;
  void explain(Scratch& scratch, std::vector<std::int32_t>& matches) const;
  void giveSlots(Scratch& scratch) const;
  void store(maps::LandmarkMap& map, const Eye& eye, std::vector<std::int32_t>& matches,
             Scratch& scratch, int lane);
  void cap(maps::LandmarkMap& map, int lane);

  const Settings& settings_;
  LandmarkScan& scan_;
  maps::LandmarkPool& pool_;
};
}  // namespace slamot::filters::rbpf
