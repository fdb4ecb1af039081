#pragma once

#include <slamot/math/geometry.h>

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

namespace slamot::maps
{
/// One landmark of one particle: a Gaussian over its place, in map axes.
struct Landmark
{
  double x = 0;                  ///< [m]
  double y = 0;                  ///< [m]
  double cxx = 0;                ///< variance of x [m²]
  double cxy = 0;                ///< [m²]
  double cyy = 0;                ///< variance of y [m²]
  std::uint32_t sightings : 31;  ///< make landmarks by {}: C++17 gives bit fields no default
  std::uint32_t confirmed : 1;   ///< in an intensity: a feature, not only a component
  float existence = 0;           ///< log odds that it exists; in an intensity: expected number

  /// Its mean [m].
  [[nodiscard]] Point2D point() const { return {x, y}; }
  /// Its covariance [m²].
  [[nodiscard]] Matrix2 cov() const
  {
    Matrix2 c;
    c << cxx, cxy, cxy, cyy;
    return c;
  }
};

namespace detail
{
inline constexpr int kLeafBits = 3, kInnerBits = 4;
inline constexpr int kLeafSize = 1 << kLeafBits, kInnerSize = 1 << kInnerBits;

// A node may be changed in place only by the map whose token it carries; everybody else copies it
// first.  So a copy of a map is a copy of its root pointer, and no reference is ever counted: with
// counts, copying an inner node would touch all its children, in memory that threads share.
struct Node
{
  std::uint64_t owner = 0;
  std::uint32_t mark = 0;
};
struct Leaf : Node
{
  std::uint32_t present = 0;  // bit i: items[i] holds a landmark
  std::array<Landmark, kLeafSize> items;
};
struct Inner : Node
{
  std::array<Node*, kInnerSize> children;
};
}  // namespace detail

/// Memory for the nodes of all maps of one filter.  Nodes that no map reaches any more are found by
/// collect(), which the filter calls after resampling.
class LandmarkPool
{
 public:
  /// \param lanes how many threads may take nodes at a time, each its own lane.
  explicit LandmarkPool(int lanes = 1) : lanes_(static_cast<std::size_t>(lanes)) {}

  /// A token that no map had before.
  std::uint64_t newToken() { return ++lastToken_; }

  /// What all nodes take, those that are free again too [bytes].
  [[nodiscard]] std::size_t bytes() const;

 private:
  friend class LandmarkMap;
  template <class T>
  struct Slab
  {
    std::deque<std::unique_ptr<T[]>> blocks;
    std::size_t usedInLast = 0;
    std::vector<T*> free;
    T* take();
    std::size_t sweep(std::uint32_t mark);
    [[nodiscard]] std::size_t allocated() const;
  };
  struct alignas(64) Lane
  {
    Slab<detail::Leaf> leaves;
    Slab<detail::Inner> inners;
    std::size_t taken = 0;  // since the last collection
  };

  std::vector<Lane> lanes_;
  std::uint64_t lastToken_ = 0;
  std::uint32_t mark_ = 0;
  std::size_t live_ = 0;

  friend class LandmarkCollector;
};

/// The landmarks of one particle by slot number: a persistent tree, 8 landmarks a leaf, 16 children
/// an inner node.  Copies share nodes; find() and modify() cost O(log slots), a copy O(1).
/// After copying, both sides need a new token before either is modified (see detach()).
class LandmarkMap
{
 public:
  /// The landmark in a slot; null if there is none.
  [[nodiscard]] const Landmark* find(std::uint32_t slot) const
  {
    const detail::Leaf* leaf = findLeaf(slot);
    if (!leaf || !(leaf->present >> (slot & kLeafMask) & 1u)) return nullptr;
    return &leaf->items[slot & kLeafMask];
  }
  /// The landmark in a slot for writing; a default one if there was none.
  Landmark& modify(LandmarkPool& pool, int lane, std::uint32_t slot);
  /// Removes the landmark of a slot, if there is one.
  void erase(LandmarkPool& pool, int lane, std::uint32_t slot);

  /// Gives the map a token of its own: nodes shared with other maps are copied when written to.
  void detach(std::uint64_t token) { token_ = token; }

  /// How many landmarks it holds.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Visits the landmarks by rising slots.
  void visit(const std::function<void(std::uint32_t slot, const Landmark&)>& visitor) const;

 private:
  friend class LandmarkCollector;
  static constexpr std::uint32_t kLeafMask = detail::kLeafSize - 1;
  static constexpr std::uint32_t kInnerMask = detail::kInnerSize - 1;

  [[nodiscard]] const detail::Leaf* findLeaf(std::uint32_t slot) const
  {
    std::uint32_t key = slot >> detail::kLeafBits;
    if (!root_ || key >> (detail::kInnerBits * depth_)) return nullptr;
    const detail::Node* node = root_;
    for (int level = depth_ - 1; level >= 0 && node; --level)
      node = static_cast<const detail::Inner*>(node)
                 ->children[(key >> (detail::kInnerBits * level)) & kInnerMask];
    return static_cast<const detail::Leaf*>(node);
  }
  detail::Leaf* writableLeaf(LandmarkPool& pool, int lane, std::uint32_t slot);
  void growTo(LandmarkPool& pool, int lane, std::uint32_t slot);

  detail::Node* root_ = nullptr;
  std::uint64_t token_ = 0;
  std::uint32_t size_ = 0;
  std::int32_t depth_ = 0;  // levels of inner nodes above the leaves
};

/// One collection: mark() every map that lives, then sweep().
class LandmarkCollector
{
 public:
  /// Begins a collection in the maps of this pool.
  explicit LandmarkCollector(LandmarkPool& pool);
  /// Whether as many nodes were taken since the last collection as lived then, and a few more.
  [[nodiscard]] static bool isDue(const LandmarkPool& pool);
  /// Says that a map lives, and with it all nodes that it reaches.
  void mark(const LandmarkMap& map);
  /// Gives back the nodes that no marked map reaches.
  void sweep();
  /// Slots that some marked map holds, by slot.
  [[nodiscard]] const std::vector<bool>& occupied() const { return occupied_; }

 private:
  void mark(detail::Node* node, int depth, std::uint32_t key);
  LandmarkPool& pool_;
  std::vector<bool> occupied_;
};
}  // namespace slamot::maps
