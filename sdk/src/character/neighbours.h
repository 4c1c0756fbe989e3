// Finds the k nearest points of a set. The points are stored in a balanced tree. Its depth does not depend on
// how the points are distributed. A query therefore costs the same for coincident points as for evenly spaced
// points. Building the tree costs O(n log n), and a query O(log n + k).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/vec.h"

namespace nook {

struct NeighbourTree {
  explicit NeighbourTree(Memory* memory) : entries(memory), nodes(memory) {}

  struct Entry {
    Vec3 place;
    std::uint32_t slot = 0;
  };
  // The box of a range of `entries`. The two halves of the range of node i are nodes 2 i + 1 and 2 i + 2. All
  // leaves have the same depth.
  struct Node {
    Vec3 low, high;
    std::uint32_t min_slot = 0;
  };

  Vector<Entry> entries;
  Vector<Node> nodes;
};

inline constexpr std::uint32_t max_nearest = 16;

struct Neighbour {
  float distance_squared = 0;
  std::uint32_t slot = 0;
};

// Reserves memory for `count` points, so that building the tree does not allocate.
void reserve_tree(NeighbourTree& tree, std::size_t count);

// To build a tree, call clear_tree, then add the points one by one, then sort them.
void clear_tree(NeighbourTree& tree) noexcept;
void add_to_tree(NeighbourTree& tree, std::uint32_t slot, Vec3 place) noexcept;
void build_tree(NeighbourTree& tree) noexcept;

// Finds the k points that are nearest to `place` and at most max_distance away. Ignores the point `slot`. k
// must be at most max_nearest. Returns how many points it found. Points are sorted by distance; at equal
// distances, the lower slot comes first.
std::uint32_t find_nearest(const NeighbourTree& tree, std::uint32_t slot, Vec3 place, std::uint32_t k,
                           float max_distance, std::span<Neighbour, max_nearest> found) noexcept;

}  // namespace nook
