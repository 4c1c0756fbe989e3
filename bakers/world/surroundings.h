// Makes points on the surfaces that a body darkens: the floor, a wall and another body. The points are
// distributed evenly by area.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/vec.h"

namespace nook::bake {

using Triangle = std::array<std::uint32_t, 3>;

struct SurfacePoints {
  std::vector<Vec3> position, normal;
  std::vector<float> weight;  // proportional to the area that a point represents

  std::size_t size() const { return position.size(); }
  void add(Vec3 at, Vec3 facing, float area) {
    position.push_back(at);
    normal.push_back(facing);
    weight.push_back(area);
  }
};

// World space, metres, +y up.
struct PosedBody {
  std::vector<Vec3> position;
  std::span<const Triangle> triangle;
};

inline constexpr float grid_step_m = 0.02f;     // of floor and wall
inline constexpr float floor_size_m = 6;        // a square below the middle of the body
inline constexpr float contact_m = 0.15f;       // maximum distance of the contact ring from the body
inline constexpr float wall_distance_m = 0.3f;  // distance of the wall from the nearest vertex
inline constexpr float wall_width_m = 3, wall_height_m = 2.5f;
inline constexpr float neighbour_gap_m = 0.3f;  // between both bodies, in the direction of the bearing

// Returns the height of the floor: the height of the body's lowest vertex.
float floor_height(std::span<const Vec3> body);

// Returns `count` grid points of the floor. Three quarters of them are within 1.2 m of its middle.
SurfacePoints floor_points(std::span<const Vec3> body, std::size_t count, std::uint64_t seed);
// Returns at most `count` grid points of the contact ring.
SurfacePoints contact_points(const PosedBody& body, std::size_t count, std::uint64_t seed);
// Returns `count` grid points of a vertical wall that stands on the floor. bearing_radians is measured from
// +z towards +x.
SurfacePoints wall_points(std::span<const Vec3> body, float bearing_radians, std::size_t count,
                          std::uint64_t seed);
// Returns `count` points on the surface of another body that stands on the same floor.
SurfacePoints neighbour_points(std::span<const Vec3> body, const PosedBody& other, float bearing_radians,
                               std::size_t count, std::uint64_t seed);

}  // namespace nook::bake
