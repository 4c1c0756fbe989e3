// Tangent frames of vertices. x points in the direction of increasing u, and z along the normal. y =
// handedness * cross(z, x) points in the direction of increasing v. The handedness is -1 if the texture
// coordinates are mirrored, otherwise 1.
#pragma once

#include <cstdint>

#include "sdk/src/core/vec.h"

namespace nook::transfer {

struct Frame {
  Vec3 normal{0, 0, 1};
  Vec3 tangent{1, 0, 0};
  float handedness = 1;

  Vec3 bitangent() const { return cross(normal, tangent) * handedness; }
};

// Returns a frame whose tangent has unit length and is perpendicular to the normal. If the given tangent is
// zero or parallel to the normal, it is replaced by the x axis of T. Duff et al.: Building an Orthonormal
// Basis, Revisited, 2017.
Frame orthonormal_frame(Vec3 normal, Vec3 tangent, float handedness);

// A frame in six bytes. The normal is encoded on an octahedron, with 16 bits for each of two coordinates (Z.
// Cigolle et al.: A Survey of Efficient Representations for Independent Unit Vectors, 2014). The angle
// between the tangent and the x axis of Duff et al. takes 15 bits. The handedness takes one bit. The error is
// at most 1e-4 radians.
struct PackedFrame {
  std::uint16_t u = 0, v = 0, angle = 0;
  bool operator==(const PackedFrame&) const = default;
};
PackedFrame pack(const Frame& frame);
Frame unpack(PackedFrame packed);

}  // namespace nook::transfer
