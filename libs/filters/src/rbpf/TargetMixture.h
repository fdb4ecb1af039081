#pragma once

#include "ParticleSet.h"
#include "TargetLabels.h"
#include "sighting/Targets.h"

namespace slamot::filters::rbpf
{
/// A particle's moving targets as an intensity: a random finite set, by the Gaussian mixture
/// D(t) = Σ w N(t; x, P) over their states, given the particle's pose.  Vo and Ma 2006, "The
/// Gaussian mixture probability hypothesis density filter"; labels as by Panta, Clark, Vo 2009: a
/// component keeps its label through prediction and update, what is merged takes the heaviest's,
/// and a newborn gets a new one.
///
/// Weights decay by the chance to survive.  A scan of blobs updates them as Intensity does those of
/// landmarks: D' = (1 - p_D) D + Σ_z Σ_j w_j(z) N(x_j(z), P_j), w_j(z) = p_D w_j q_j(z) / (c + Σ_l
/// p_D w_l q_l(z)), over the components that z may be of by its label and identity; then pruned,
/// merged and capped; what is too heavy for one target is divided.  A blob with range that is more
/// likely false than of all of them bears one, small, which counts from the next scan on.
template <class Motion>
class TargetMixture
{
 public:
  using State = typename Motion::State;
  using Component = TargetComponent<State>;
  using Mixture = std::vector<Component>;

  TargetMixture(const TargetSetSettings& set, const Gates& gates, const Motion& motion,
                const TargetLabels& labels)
      : set_(set), gates_(gates), motion_(motion), labels_(labels)
  {
  }

  struct Pair
  {
    std::size_t component, blob;
    Innovation innovation;
    double weight;  ///< p_D w q, then w_j(z)
  };
  /// A component of the posterior before merging.
  struct Piece
  {
    Component component;
    std::int32_t blob = kNew;  ///< that it took in; kNew: none
    bool merged = false;
  };
  struct Scratch
  {
    std::vector<double> detection;   ///< p_D at each component's place
    std::vector<std::size_t> label;  ///< its place in TargetLabels
    std::vector<Pair> pairs;
    std::vector<double> evidence;  ///< c + Σ p_D w q, of each blob
    std::vector<double> shares;    ///< the largest of any component, of each blob
    std::vector<Piece> pieces;
    std::vector<std::int32_t> blobs;  ///< that the merged components mostly took in
  };

  /// Readies a scan.
  /// \param rays of its blobs; both must stay until the next scan.
  /// \param noise what multiplies the variances of blobs of each label.
  void begin(const core::BlobScan& scan, const BlobRays& rays, std::uint64_t number,
             std::vector<double> noise);

  void predict(Mixture& mixture, double dt) const;
  /// Takes the scan into a particle's mixture, seen from its pose.
  /// \param matches becomes, for each blob, the place in TargetLabels of what explains it best,
  /// kNew where it bore a component, or kRejected.
  /// \return log of the particle's weight by this scan: Σ_z log(c + Σ p_D w q) - Σ p_D w.
  double update(Mixture& mixture, const Eye& eye, std::vector<std::int32_t>& matches,
                Scratch& scratch) const;

  /// The heaviest component with a label; null if there is none.
  [[nodiscard]] static const Component* heaviest(const Mixture& mixture, std::uint64_t label);
  /// The label that a blob of the scan bears.
  [[nodiscard]] std::uint64_t birthKey(std::size_t blob) const { return birthKeys_[blob]; }
  /// What multiplies the variances of blobs of a label, by its place in TargetLabels.
  [[nodiscard]] double noise(std::size_t label) const { return noise_[label]; }
  /// p_D at a target's place: the detection probability, times how much of it is in view.
  [[nodiscard]] double detectionAt(const Eye& eye, const State& s) const;

  // The steps of update(), each on its own for tests.
  void collect(const Mixture& mixture, const Eye& eye, Scratch& scratch) const;
  void pair(const Mixture& mixture, const Eye& eye, Scratch& scratch) const;
  [[nodiscard]] double logWeight(const Mixture& mixture, const Scratch& scratch) const;
  void split(const Mixture& mixture, const Eye& eye, Scratch& scratch) const;
  void merge(Mixture& mixture, Scratch& scratch) const;
  void divide(Mixture& mixture, const Scratch& scratch) const;

 private:
  [[nodiscard]] double clutter(std::size_t blob) const;
  [[nodiscard]] bool mayMerge(const Component& heavy, const Component& light) const;
  void explain(std::vector<std::int32_t>& matches, Scratch& scratch) const;
  void bear(Mixture& mixture, const Eye& eye, std::vector<std::int32_t>& matches) const;

  const TargetSetSettings& set_;
  const Gates& gates_;
  const Motion& motion_;
  const TargetLabels& labels_;
  const BlobRays* scan_ = nullptr;
  core::FieldOfView fov_;
  std::vector<std::uint64_t> birthKeys_;
  std::vector<double> noise_;
  double rangeVar_ = 0, bearingVar_ = 0;  // the largest of the last blobs
};
}  // namespace slamot::filters::rbpf
