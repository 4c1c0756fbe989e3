// Finds the k nearest points of a set. A balanced tree adapts to any distribution of the points, so that a
// query costs as much in a pile of coincident points as on an even field: O(n log n) for the set, O(log n +
// k) for a query.
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
  // The box of a range of `entries`. Node i halves its range between nodes 2 i + 1 and 2 i + 2; all leaves
  // lie at the same depth.
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

// Makes room for `count` points, so that building allocates nothing.
void reserve_tree(NeighbourTree& tree, std::size_t count);

// Starts a new set, takes its points one by one, then sorts them for queries.
void clear_tree(NeighbourTree& tree) noexcept;
void add_to_tree(NeighbourTree& tree, std::uint32_t slot, Vec3 place) noexcept;
void build_tree(NeighbourTree& tree) noexcept;

// Finds the k <= max_nearest points nearest to `place` within max_distance, without `slot` itself, and
// returns their number. The nearest come first; at equal distances, the lower slot does.
std::uint32_t find_nearest(const NeighbourTree& tree, std::uint32_t slot, Vec3 place, std::uint32_t k,
                           float max_distance, std::span<Neighbour, max_nearest> found) noexcept;

}  // namespace nook
