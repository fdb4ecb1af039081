#include <slamot/maps/LandmarkMap.h>

namespace slamot::maps
{
using detail::Inner;
using detail::kInnerBits;
using detail::kInnerSize;
using detail::kLeafBits;
using detail::kLeafSize;
using detail::Leaf;
using detail::Node;

namespace
{
constexpr std::size_t kBlock = 256;             // nodes allocated at once
constexpr std::size_t kSmallestHarvest = 4096;  // nodes worth a collection
}  // namespace

template <class T>
T* LandmarkPool::Slab<T>::take()
{
  if (!free.empty())
  {
    T* node = free.back();
    free.pop_back();
    return node;
  }
  if (blocks.empty() || usedInLast == kBlock)
  {
    blocks.push_back(std::make_unique<T[]>(kBlock));
    usedInLast = 0;
  }
  return &blocks.back()[usedInLast++];
}

template <class T>
std::size_t LandmarkPool::Slab<T>::sweep(std::uint32_t mark)
{
  free.clear();
  std::size_t live = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const std::size_t used = b + 1 == blocks.size() ? usedInLast : kBlock;
    for (std::size_t i = 0; i < used; ++i)
      if (blocks[b][i].mark == mark)
        ++live;
      else
        free.push_back(&blocks[b][i]);
  }
  return live;
}

template <class T>
std::size_t LandmarkPool::Slab<T>::allocated() const
{
  return blocks.size() * kBlock * sizeof(T) + free.capacity() * sizeof(T*);
}

std::size_t LandmarkPool::bytes() const
{
  std::size_t sum = 0;
  for (const Lane& lane : lanes_) sum += lane.leaves.allocated() + lane.inners.allocated();
  return sum;
}

void LandmarkMap::growTo(LandmarkPool& pool, int lane, std::uint32_t slot)
{
  const std::uint32_t key = slot >> kLeafBits;
  while (!root_ || key >> (kInnerBits * depth_))
  {
    auto& l = pool.lanes_[static_cast<std::size_t>(lane)];
    ++l.taken;
    Inner* top = l.inners.take();
    top->children.fill(nullptr);
    top->children[0] = root_;
    top->owner = token_;
    root_ = top;
    ++depth_;
  }
}

Leaf* LandmarkMap::writableLeaf(LandmarkPool& pool, int lane, std::uint32_t slot)
{
  growTo(pool, lane, slot);
  auto& l = pool.lanes_[static_cast<std::size_t>(lane)];
  const std::uint32_t key = slot >> kLeafBits;
  Node** link = &root_;
  for (int level = depth_ - 1; level >= 0; --level)
  {
    auto* node = static_cast<Inner*>(*link);
    if (!node || node->owner != token_)
    {
      Inner* copy = l.inners.take();
      ++l.taken;
      if (node)
        *copy = *node;
      else
        copy->children.fill(nullptr);
      copy->owner = token_;
      *link = node = copy;
    }
    link = &node->children[(key >> (kInnerBits * level)) & kInnerMask];
  }
  auto* leaf = static_cast<Leaf*>(*link);
  if (leaf && leaf->owner == token_) return leaf;
  Leaf* copy = l.leaves.take();
  ++l.taken;
  if (leaf)
    *copy = *leaf;
  else
    copy->present = 0;
  copy->owner = token_;
  *link = copy;
  return copy;
}

Landmark& LandmarkMap::modify(LandmarkPool& pool, int lane, std::uint32_t slot)
{
  Leaf* leaf = writableLeaf(pool, lane, slot);
  const std::uint32_t i = slot & kLeafMask, bit = 1u << i;
  if (!(leaf->present & bit))
  {
    leaf->present |= bit;
    leaf->items[i] = Landmark{};
    ++size_;
  }
  return leaf->items[i];
}

void LandmarkMap::erase(LandmarkPool& pool, int lane, std::uint32_t slot)
{
  if (!find(slot)) return;
  writableLeaf(pool, lane, slot)->present &= ~(1u << (slot & kLeafMask));
  --size_;
}

namespace
{
void visitNode(const Node* node, int depth, std::uint32_t key,
               const std::function<void(std::uint32_t, const Landmark&)>& visitor)
{
  if (!node) return;
  if (depth > 0)
  {
    const auto& children = static_cast<const Inner*>(node)->children;
    for (std::uint32_t i = 0; i < kInnerSize; ++i)
      visitNode(children[i], depth - 1, (key << kInnerBits) | i, visitor);
    return;
  }
  const auto* leaf = static_cast<const Leaf*>(node);
  for (std::uint32_t i = 0; i < kLeafSize; ++i)
    if (leaf->present >> i & 1u) visitor((key << kLeafBits) | i, leaf->items[i]);
}
}  // namespace

void LandmarkMap::visit(const std::function<void(std::uint32_t, const Landmark&)>& visitor) const
{
  visitNode(root_, depth_, 0, visitor);
}

LandmarkCollector::LandmarkCollector(LandmarkPool& pool) : pool_(pool)
{
  ++pool_.mark_;
}

bool LandmarkCollector::isDue(const LandmarkPool& pool)
{
  std::size_t taken = 0;
  for (const auto& lane : pool.lanes_) taken += lane.taken;
  return taken > pool.live_ + kSmallestHarvest;
}

void LandmarkCollector::mark(const LandmarkMap& map)
{
  mark(map.root_, map.depth_, 0);
}

void LandmarkCollector::mark(Node* node, int depth, std::uint32_t key)
{
  if (!node || node->mark == pool_.mark_) return;
  node->mark = pool_.mark_;
  if (depth > 0)
  {
    const auto& children = static_cast<Inner*>(node)->children;
    for (std::uint32_t i = 0; i < kInnerSize; ++i)
      mark(children[i], depth - 1, (key << kInnerBits) | i);
    return;
  }
  const auto* leaf = static_cast<Leaf*>(node);
  const std::size_t end = (static_cast<std::size_t>(key) + 1) << kLeafBits;
  if (occupied_.size() < end) occupied_.resize(end, false);
  for (std::uint32_t i = 0; i < kLeafSize; ++i)
    if (leaf->present >> i & 1u) occupied_[(key << kLeafBits) | i] = true;
}

void LandmarkCollector::sweep()
{
  pool_.live_ = 0;
  for (auto& lane : pool_.lanes_)
  {
    pool_.live_ += lane.leaves.sweep(pool_.mark_) + lane.inners.sweep(pool_.mark_);
    lane.taken = 0;
  }
}
}  // namespace slamot::maps
