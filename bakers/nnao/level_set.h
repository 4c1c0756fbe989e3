// Shapes as functions of space. Makes seeded noise, and surfaces of smooth bodies.
#pragma once

#include <cstdint>
#include <functional>

#include "bakers/nnao/solids.h"
#include "sdk/src/core/vec.h"

namespace nook::bake::nnao {

// Seeded noise in space, for surfaces that are not smooth.

// Returns value noise in [-1, 1] on the lattice of whole numbers, with a smooth fade.
float value_noise(std::uint64_t seed, Vec3 p);

// Adds octaves. Each has half the amplitude and twice the frequency of the one before.
float fractal_noise(std::uint64_t seed, Vec3 p, int octaves);

// Returns the approximate distance from the surface in metres; negative inside.
using DistanceField = std::function<float(Vec3)>;

// Adds the surface where the function is 0, inside the box from low to high of the frame, by marching
// tetrahedra on cubes (Doi and Koide 1991). cell is the size of a cube.
void add_level_set(TriangleSoup& soup, const Mat3x4& frame, Vec3 low, Vec3 high, float cell,
                   const DistanceField& distance);

// Joins two bodies with a seam that is rounded over a width (the quadratic minimum of Quilez 2013).
inline float round_union(float a, float b, float width) {
  const float overlap = std::fmax(width - std::abs(a - b), 0.0f) / width;
  return std::fmin(a, b) - 0.25f * width * overlap * overlap;
}

// Returns the distance from a rod with round ends, whose radius changes along it.
inline float distance_to_limb(Vec3 p, Vec3 from, Vec3 to, float radius_from, float radius_to) {
  const Vec3 along = to - from;
  const float t = std::fmin(std::fmax(dot(p - from, along) / dot(along, along), 0.0f), 1.0f);
  return length(p - from - t * along) - radius_from - t * (radius_to - radius_from);
}

}  // namespace nook::bake::nnao
