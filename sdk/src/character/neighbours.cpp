#include "sdk/src/character/neighbours.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

namespace nook {
namespace {

using Cell = std::array<std::int32_t, 3>;

Cell cell_of(Vec3 place, float cell_size) {
  return {static_cast<std::int32_t>(std::floor(place.x / cell_size)),
          static_cast<std::int32_t>(std::floor(place.y / cell_size)),
          static_cast<std::int32_t>(std::floor(place.z / cell_size))};
}

// Teschner et al. 2003, "Optimized spatial hashing for collision detection of deformable objects", with a
// final mix.
std::uint32_t hash(const Cell& cell) {
  std::uint32_t h = std::uint32_t(cell[0]) * 73856093u ^ std::uint32_t(cell[1]) * 19349663u ^
                    std::uint32_t(cell[2]) * 83492791u;
  h ^= h >> 15;
  h *= 0x2c1b3c6du;
  return h ^ (h >> 13);
}

struct Best {
  std::span<Neighbour, max_nearest> found;
  std::uint32_t k = 0;
  std::uint32_t count = 0;
  float limit = 0;  // squared; what is farther is of no use

  void offer(const NeighbourGrid::Entry& entry, std::uint32_t self, Vec3 place) {
    const Vec3 d = entry.place - place;
    const Neighbour candidate{dot(d, d), entry.slot};
    if (entry.slot == self || candidate.distance_squared > limit) return;
    const auto nearer = [](const Neighbour& a, const Neighbour& b) {
      return a.distance_squared != b.distance_squared ? a.distance_squared < b.distance_squared
                                                      : a.slot < b.slot;
    };
    if (count == k && !nearer(candidate, found[k - 1])) return;
    std::uint32_t at = count < k ? count++ : k - 1;
    for (; at > 0 && nearer(candidate, found[at - 1]); --at) found[at] = found[at - 1];
    found[at] = candidate;
  }
};

// A cell about as wide as the k-th neighbour is far, by the median of a few points: queries then end after a
// ring or two.
float choose_cell_size(std::span<const NeighbourGrid::Entry> points, std::uint32_t k, float max_distance) {
  constexpr std::size_t samples = 16;
  std::array<float, samples> distance{};
  std::size_t count = 0;
  float largest = 0;
  for (const NeighbourGrid::Entry& point : points)
    largest = std::max({largest, std::abs(point.place.x), std::abs(point.place.y), std::abs(point.place.z)});
  const std::size_t step = points.size() / samples + 1;
  for (std::size_t i = step / 2; i < points.size(); i += step) {
    std::array<Neighbour, max_nearest> found;
    Best best{found, k, 0, max_distance * max_distance};
    for (const NeighbourGrid::Entry& point : points) best.offer(point, points[i].slot, points[i].place);
    distance[count++] = best.count < k ? max_distance : std::sqrt(found[best.count - 1].distance_squared);
  }
  std::nth_element(distance.begin(), distance.begin() + count / 2, distance.begin() + count);
  // Not so small that cell numbers leave the exact range of floats.
  return std::max({distance[count / 2], largest * 1e-6f, 1e-6f});
}

void offer_cell(const NeighbourGrid& grid, const Cell& cell, std::uint32_t self, Vec3 place, Best& best) {
  const std::uint32_t bucket = hash(cell) & grid.bucket_mask;
  for (std::uint32_t i = grid.bucket_begin[bucket]; i < grid.bucket_begin[bucket + 1]; ++i)
    if (grid.entries[i].cell == cell) best.offer(grid.entries[i], self, place);
}

// Cells whose largest coordinate difference from the middle is exactly `ring`.
void offer_ring(const NeighbourGrid& grid, const Cell& middle, std::int32_t ring, std::uint32_t self,
                Vec3 place, Best& best) {
  for (std::int32_t x = -ring; x <= ring; ++x)
    for (std::int32_t y = -ring; y <= ring; ++y) {
      const bool edge = std::abs(x) == ring || std::abs(y) == ring;
      for (std::int32_t z = -ring; z <= ring; z += edge || ring == 0 ? 1 : 2 * ring)
        offer_cell(grid, {middle[0] + x, middle[1] + y, middle[2] + z}, self, place, best);
    }
}

}  // namespace

void reserve_grid(NeighbourGrid& grid, std::size_t count) {
  grid.entries.reserve(count);
  grid.scratch.reserve(count);
  grid.bucket_begin.reserve(std::bit_ceil(count) * 2 + 1);
}

void clear_grid(NeighbourGrid& grid) noexcept {
  grid.scratch.clear();
}

void add_to_grid(NeighbourGrid& grid, std::uint32_t slot, Vec3 place) noexcept {
  grid.scratch.push_back({place, slot, {}});
}

void finish_grid(NeighbourGrid& grid, std::uint32_t k, float max_distance) noexcept {
  grid.entries.clear();
  if (grid.scratch.empty()) return;
  grid.cell_size = choose_cell_size(grid.scratch, k, max_distance);
  const std::size_t buckets = std::bit_ceil(grid.scratch.size()) * 2;
  grid.bucket_mask = static_cast<std::uint32_t>(buckets - 1);
  grid.bucket_begin.assign(buckets + 1, 0);
  // Counting sort by bucket: count, running sum to the ends, then fill from the back.
  for (NeighbourGrid::Entry& entry : grid.scratch) {
    entry.cell = cell_of(entry.place, grid.cell_size);
    ++grid.bucket_begin[hash(entry.cell) & grid.bucket_mask];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& end : grid.bucket_begin) end = sum += end;
  grid.entries.resize(grid.scratch.size());
  for (const NeighbourGrid::Entry& entry : grid.scratch)
    grid.entries[--grid.bucket_begin[hash(entry.cell) & grid.bucket_mask]] = entry;
}

std::uint32_t find_nearest(const NeighbourGrid& grid, std::uint32_t slot, Vec3 place, std::uint32_t k,
                           float max_distance, std::span<Neighbour, max_nearest> found) noexcept {
  Best best{found, k, 0, max_distance * max_distance};
  if (k == 0 || grid.entries.empty()) return 0;
  const Cell middle = cell_of(place, grid.cell_size);
  for (std::int32_t ring = 0;; ++ring) {
    const double side = 2.0 * ring + 1;
    if (side * side * side > 64.0 + 8.0 * static_cast<double>(grid.entries.size())) {
      // More cells than points, as for one far from all others: look at the points.
      best.count = 0;
      for (const NeighbourGrid::Entry& entry : grid.entries) best.offer(entry, slot, place);
      return best.count;
    }
    offer_ring(grid, middle, ring, slot, place, best);
    // Whatever lies outside the rings so far is farther than this; the share of rounding is taken off.
    const float seen = static_cast<float>(ring) * grid.cell_size * 0.999f;
    if (seen >= max_distance) return best.count;
    if (best.count == k && best.found[k - 1].distance_squared <= seen * seen) return best.count;
  }
}

}  // namespace nook
