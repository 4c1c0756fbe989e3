// Writes the table of casters that shaders/world/casters.glsl reads.
#pragma once

#include <cstdint>

#include "sdk/src/gl/world/world_frame.h"

namespace nook::gl {

// Transforms from world to view space by a rotation and a translation, column-major.
Vec3 viewed(const float* view, Vec3 p);

// Transforms a direction.
Vec3 turned(const float* view, Vec3 direction);

std::uint64_t texels_of(const ReachingGroup& group);

// Returns the number of texels of a group that casts the shadow of a cone.
std::uint64_t shade_texels_of(const ReachingGroup& group);

class CasterTexels {
 public:
  // table: four floats for each texel of all bodies.
  CasterTexels(float* table, const float* view, std::uint32_t bodies);

  // Call it for bodies in the order of their numbers.
  void put(std::uint32_t body, const ReachingGroup& group, float level_error);

  // Begins the bodies that cast the shadow of a cone, at a texel after all others. Pass them in the order of
  // their numbers.
  void begin_shades(std::uint64_t first, std::uint32_t bodies);
  void put_shade(std::uint32_t body, const ReachingGroup& group);

 private:
  void put(std::uint64_t texel, float x, float y, float z, float w);
  void put_place(std::uint64_t texel, Vec3 place, float w);
  void put_capsule(std::uint64_t texel, const Capsule& capsule, float scale);
  void put_parts(const ReachingGroup& group, const world::CasterParts& parts, float level_error);

  float* table_;
  const float* view_;
  std::uint64_t next_;  // texel of the next body's parts, or of its casters
  std::uint64_t shades_ = 0;
};

}  // namespace nook::gl
