#include "sdk/src/character/neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nook {
namespace {

using Entry = NeighbourTree::Entry;
using Node = NeighbourTree::Node;

// A leaf holds at most this many points. Smaller leaves need fewer point tests, but the additional box tests
// take more time than this saves.
constexpr std::size_t max_leaf_points = 8;

// Returns how many times the range must be halved until each part fits into a leaf.
std::uint32_t depth_of(std::size_t points) {
  std::uint32_t depth = 0;
  while ((points - 1) >> depth >= max_leaf_points) ++depth;
  return depth;
}

std::size_t node_count(std::size_t points) {
  return points ? (std::size_t{2} << depth_of(points)) - 1 : 0;
}

Node node_of(std::span<const Entry> range) {
  Node node{range[0].place, range[0].place, range[0].slot};
  for (const Entry& entry : range.subspan(1)) {
    node.low = {std::min(node.low.x, entry.place.x), std::min(node.low.y, entry.place.y),
                std::min(node.low.z, entry.place.z)};
    node.high = {std::max(node.high.x, entry.place.x), std::max(node.high.y, entry.place.y),
                 std::max(node.high.z, entry.place.z)};
    node.min_slot = std::min(node.min_slot, entry.slot);
  }
  return node;
}

template <float Vec3::*axis>
void halve_along(std::span<Entry> range) {
  // Coincident points are ordered by slot. Queries prefer lower slots at equal distances, so they can then
  // skip whole nodes of coincident points.
  const auto before = [](const Entry& a, const Entry& b) {
    return a.place.*axis != b.place.*axis ? a.place.*axis < b.place.*axis : a.slot < b.slot;
  };
  std::nth_element(range.begin(), range.begin() + static_cast<std::ptrdiff_t>(range.size() / 2), range.end(),
                   before);
}

void halve(std::span<Entry> range, const Node& node) {
  const Vec3 extent = node.high - node.low;
  if (extent.x >= extent.y && extent.x >= extent.z)
    halve_along<&Vec3::x>(range);
  else if (extent.y >= extent.z)
    halve_along<&Vec3::y>(range);
  else
    halve_along<&Vec3::z>(range);
}

void build_node(NeighbourTree& tree, std::size_t index, std::uint32_t depth, std::span<Entry> range) {
  Node& node = tree.nodes[index];
  node = node_of(range);
  if (depth == 0) return;
  halve(range, node);
  build_node(tree, 2 * index + 1, depth - 1, range.first(range.size() / 2));
  build_node(tree, 2 * index + 2, depth - 1, range.subspan(range.size() / 2));
}

bool nearer(const Neighbour& a, const Neighbour& b) {
  return a.distance_squared != b.distance_squared ? a.distance_squared < b.distance_squared : a.slot < b.slot;
}

// Returns a lower bound of the squared distance to any point of the box, reduced to allow for rounding.
float box_distance_squared(const Node& node, Vec3 p) {
  const Vec3 d{std::max({node.low.x - p.x, p.x - node.high.x, 0.0f}),
               std::max({node.low.y - p.y, p.y - node.high.y, 0.0f}),
               std::max({node.low.z - p.z, p.z - node.high.z, 0.0f})};
  return dot(d, d) * (1 - 1e-6f);
}

struct Query {
  const NeighbourTree& tree;
  Vec3 place;
  std::uint32_t self;
  std::uint32_t k;
  float limit;  // squared distance; farther points are ignored
  std::span<Neighbour, max_nearest> found;
  std::uint32_t count = 0;

  void offer(const Entry& entry) {
    const Vec3 d = entry.place - place;
    const Neighbour candidate{dot(d, d), entry.slot};
    if (entry.slot == self || candidate.distance_squared > limit) return;
    if (count == k && !nearer(candidate, found[k - 1])) return;
    std::uint32_t at = count < k ? count++ : k - 1;
    for (; at > 0 && nearer(candidate, found[at - 1]); --at) found[at] = found[at - 1];
    found[at] = candidate;
  }

  bool may_hold_nearer(const Node& node, float distance_squared) const {
    if (distance_squared > limit) return false;
    return count < k || nearer({distance_squared, node.min_slot}, found[k - 1]);
  }

  void visit(std::size_t index, std::uint32_t depth, std::span<const Entry> range) {
    if (depth == 0) {
      for (const Entry& entry : range) offer(entry);
      return;
    }
    const std::size_t low = 2 * index + 1, high = low + 1;
    const float to_low = box_distance_squared(tree.nodes[low], place),
                to_high = box_distance_squared(tree.nodes[high], place);
    const auto visit_low = [&] {
      if (may_hold_nearer(tree.nodes[low], to_low)) visit(low, depth - 1, range.first(range.size() / 2));
    };
    const auto visit_high = [&] {
      if (may_hold_nearer(tree.nodes[high], to_high)) visit(high, depth - 1, range.subspan(range.size() / 2));
    };
    if (to_low <= to_high) {
      visit_low();
      visit_high();
    } else {
      visit_high();
      visit_low();
    }
  }
};

}  // namespace

void reserve_tree(NeighbourTree& tree, std::size_t count) {
  tree.entries.reserve(count);
  tree.nodes.reserve(node_count(count));
}

void clear_tree(NeighbourTree& tree) noexcept {
  tree.entries.clear();
}

void add_to_tree(NeighbourTree& tree, std::uint32_t slot, Vec3 place) noexcept {
  tree.entries.push_back({place, slot});
}

void build_tree(NeighbourTree& tree) noexcept {
  tree.nodes.resize(node_count(tree.entries.size()));
  if (!tree.entries.empty()) build_node(tree, 0, depth_of(tree.entries.size()), tree.entries);
}

std::uint32_t find_nearest(const NeighbourTree& tree, std::uint32_t slot, Vec3 place, std::uint32_t k,
                           float max_distance, std::span<Neighbour, max_nearest> found) noexcept {
  if (k == 0 || tree.entries.empty()) return 0;
  Query query{tree, place, slot, k, max_distance * max_distance, found};
  query.visit(0, depth_of(tree.entries.size()), tree.entries);
  return query.count;
}

}  // namespace nook
