// Writes the table of occluders (casters) that shaders/world/casters.glsl reads.
#pragma once

#include <cstdint>

#include "sdk/src/gl/world/world_frame.h"

namespace nook::gl {

// Transforms a point from world to view space. `view` is a column-major matrix with a rotation and a
// translation.
Vec3 viewed(const float* view, Vec3 p);

// Transforms a direction from world to view space.
Vec3 turned(const float* view, Vec3 direction);

std::uint64_t texels_of(const ReachingGroup& group);

// Returns the number of texels that a group takes if it casts a shadow from a light cone.
std::uint64_t shade_texels_of(const ReachingGroup& group);

class CasterTexels {
 public:
  // `table` must have four floats for each texel of all bodies.
  CasterTexels(float* table, const float* view, std::uint32_t bodies);

  // Call put for all bodies in ascending order of `body`.
  void put(std::uint32_t body, const ReachingGroup& group, float level_error);

  // Begins the section of bodies that cast shadows from a light cone. It starts at the texel `first`, after
  // all other bodies. After that, call `put` for these bodies in ascending order.
  void begin_shades(std::uint64_t first, std::uint32_t bodies);
  void put_shade(std::uint32_t body, const ReachingGroup& group);

 private:
  void put(std::uint64_t texel, float x, float y, float z, float w);
  void put_place(std::uint64_t texel, Vec3 place, float w);
  void put_capsule(std::uint64_t texel, const Capsule& capsule, float scale);
  void put_parts(const ReachingGroup& group, const world::CasterParts& parts, float level_error);

  float* table_;
  const float* view_;
  std::uint64_t next_;  // texel at which the next body's parts or casters begin
  std::uint64_t shades_ = 0;
};

}  // namespace nook::gl
