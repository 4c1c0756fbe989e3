// Directions for the functions of bases: evenly spread for lobes, the vertices of an icosahedron for dice.
#pragma once

#include <array>
#include <concepts>
#include <numbers>
#include <span>

#include "sdk/src/core/vec.h"

namespace nook::probe {

// H. Vogel's spiral: azimuths differ by the golden angle, and heights are at the centres of equal areas. The
// spiral covers the whole sphere around +z, or the hemisphere around `up`.
void vogel_sphere(std::span<Vec3> axes);
void vogel_hemisphere(Vec3 up, std::span<Vec3> axes);

// Two unit vectors perpendicular to a unit vector, right-handed with it as the third axis.
struct Frame {
  Vec3 x, y, z;
};
Frame frame_round(Vec3 z);

// Ambient dice (M. Iwanicki & P.-P. Sloan 2017) have one value at each vertex of an icosahedron.

// (0, +-1, +-golden ratio) and its cyclic permutations, at unit length.
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

// c = max(dot(vertex, s), 0).
template <std::floating_point T>
constexpr T dice_radiance(T c) {
  return c * c * (T(0.35) + T(0.25) * c * c);
}

// Returns the irradiance of that function on a normal whose cosine to the vertex is c, in [-1, 1]. It is
// exact: only bands 0, 1, 2 and 4 of the clamped cosine contribute.
template <std::floating_point T>
constexpr T dice_irradiance(T c) {
  return std::numbers::pi_v<T> *
         (T(0.059375) + T(31.0 / 240) * c + T(0.075) * c * c - T(1.0 / 192) * c * c * c * c);
}

}  // namespace nook::probe
