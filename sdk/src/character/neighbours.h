// The k nearest instances of each instance, by a hashed grid whose cost grows linearly with the crowd.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "core/vec.h"

namespace nook {

struct NeighbourGrid {
  explicit NeighbourGrid(std::pmr::memory_resource* memory)
      : bucket_begin(memory), entries(memory), entry_of(memory), sample(memory) {}

  struct Entry {
    Vec3 centre;
    std::int32_t cell[3] = {};
    std::uint32_t id = 0;
  };

  float cell_size = 1;  // metres
  std::uint32_t bucket_mask = 0;
  std::pmr::vector<std::uint32_t> bucket_begin;  // of each hash bucket in `entries`, and one past the end
  std::pmr::vector<Entry> entries;               // grouped by bucket
  std::pmr::vector<std::uint32_t> entry_of;      // scratch of the counting sort
  std::pmr::vector<float> sample;                // scratch of the choice of cell size
};

}  // namespace nook
