// Seeded noise, and smooth bodies that are described by a distance function.
#pragma once

#include <cstdint>
#include <functional>

#include "bakers/nnao/solids.h"
#include "sdk/src/core/vec.h"

namespace nook::bake::nnao {

// Seeded 3D noise, for rough surfaces.

// Returns value noise in [-1, 1] on the integer lattice, smoothly interpolated.
float value_noise(std::uint64_t seed, Vec3 p);

// Sums octaves of value noise. Each octave has half the amplitude and twice the frequency of the previous
// one.
float fractal_noise(std::uint64_t seed, Vec3 p, int octaves);

// Returns the approximate signed distance from the surface in metres. It is negative inside.
using DistanceField = std::function<float(Vec3)>;

// Adds the surface where `distance` is 0, by marching tetrahedra on cubes (Doi and Koide 1991). Only the box
// from `low` to `high` in the frame's axes is searched. `cell` is the side of a cube.
void add_level_set(TriangleSoup& soup, const Mat3x4& frame, Vec3 low, Vec3 high, float cell,
                   const DistanceField& distance);

// Joins two bodies, and rounds the seam over the given width (the quadratic minimum of Quilez 2013).
inline float round_union(float a, float b, float width) {
  const float overlap = std::fmax(width - std::abs(a - b), 0.0f) / width;
  return std::fmin(a, b) - 0.25f * width * overlap * overlap;
}

// Returns the distance from a rod with round ends. Its radius changes linearly from end to end.
inline float distance_to_limb(Vec3 p, Vec3 from, Vec3 to, float radius_from, float radius_to) {
  const Vec3 along = to - from;
  const float t = std::fmin(std::fmax(dot(p - from, along) / dot(along, along), 0.0f), 1.0f);
  return length(p - from - t * along) - radius_from - t * (radius_to - radius_from);
}

}  // namespace nook::bake::nnao
