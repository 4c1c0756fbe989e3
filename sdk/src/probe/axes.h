// Directions of basis functions. Lobes are distributed evenly; ambient dice use the vertices of an
// icosahedron.
#pragma once

#include <array>
#include <concepts>
#include <numbers>
#include <span>

#include "sdk/src/core/vec.h"

namespace nook::probe {

// Both functions fill `axes` with H. Vogel's spiral. The azimuths of successive points differ by the golden
// angle. Each point is at the middle height of a zone, and all zones have equal area. vogel_sphere covers the
// whole sphere around +z. vogel_hemisphere covers the hemisphere around `up`.
void vogel_sphere(std::span<Vec3> axes);
void vogel_hemisphere(Vec3 up, std::span<Vec3> axes);

// Two unit vectors that complete a given unit vector z to a right-handed frame.
struct Frame {
  Vec3 x, y, z;
};
Frame frame_round(Vec3 z);

// Ambient dice (M. Iwanicki & P.-P. Sloan 2017) have one basis function for each vertex of an icosahedron.

// The components of the vertices, which are (0, +-1, +-golden ratio) and its cyclic permutations, normalised.
inline constexpr float dice_short = 0.525731112f, dice_long = 0.850650808f;
inline constexpr std::array<Vec3, 12> dice_axes{{{0, dice_short, dice_long},
                                                 {0, -dice_short, dice_long},
                                                 {0, dice_short, -dice_long},
                                                 {0, -dice_short, -dice_long},
                                                 {dice_long, 0, dice_short},
                                                 {-dice_long, 0, dice_short},
                                                 {dice_long, 0, -dice_short},
                                                 {-dice_long, 0, -dice_short},
                                                 {dice_short, dice_long, 0},
                                                 {-dice_short, dice_long, 0},
                                                 {dice_short, -dice_long, 0},
                                                 {-dice_short, -dice_long, 0}}};

// Returns the value of the basis function in the direction s, where c = max(dot(vertex, s), 0).
template <std::floating_point T>
constexpr T dice_radiance(T c) {
  return c * c * (T(0.35) + T(0.25) * c * c);
}

// Returns the irradiance that the basis function causes on a surface. c, in [-1, 1], is the cosine between
// the surface's normal and the vertex. The result is exact. Only bands 0, 1, 2 and 4 of the clamped cosine
// contribute to it.
template <std::floating_point T>
constexpr T dice_irradiance(T c) {
  return std::numbers::pi_v<T> *
         (T(0.059375) + T(31.0 / 240) * c + T(0.075) * c * c - T(1.0 / 192) * c * c * c * c);
}

}  // namespace nook::probe
