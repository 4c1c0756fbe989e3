// The k nearest of a set of points, by a hashed grid whose cost grows linearly with their number.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "sdk/src/core/vec.h"

namespace nook {

struct NeighbourGrid {
  explicit NeighbourGrid(std::pmr::memory_resource* memory)
      : bucket_begin(memory), entries(memory), scratch(memory) {}

  struct Entry {
    Vec3 place;
    std::uint32_t slot = 0;
    std::array<std::int32_t, 3> cell{};
  };

  float cell_size = 1;  // metres
  std::uint32_t bucket_mask = 0;
  std::pmr::vector<std::uint32_t> bucket_begin;  // of each hash bucket in `entries`, and one past the end
  std::pmr::vector<Entry> entries;               // grouped by bucket
  std::pmr::vector<Entry> scratch;
};

inline constexpr std::uint32_t max_nearest = 16;

struct Neighbour {
  float distance_squared = 0;
  std::uint32_t slot = 0;
};

// Makes room for `count` points, so that building allocates nothing.
void reserve_grid(NeighbourGrid& grid, std::size_t count);

// Starts a new set, takes its points one by one, then sorts them for queries of k neighbours within
// max_distance.
void clear_grid(NeighbourGrid& grid) noexcept;
void add_to_grid(NeighbourGrid& grid, std::uint32_t slot, Vec3 place) noexcept;
void finish_grid(NeighbourGrid& grid, std::uint32_t k, float max_distance) noexcept;

// The k <= max_nearest points nearest to `place` within max_distance, nearest first and by slot where equally
// near, without `slot` itself. Returns how many there are.
std::uint32_t find_nearest(const NeighbourGrid& grid, std::uint32_t slot, Vec3 place, std::uint32_t k,
                           float max_distance, std::span<Neighbour, max_nearest> found) noexcept;

}  // namespace nook
