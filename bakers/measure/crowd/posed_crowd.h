// A crowd in the poses of one moment: many instances of one imported character.
#pragma once

#include <nook/nook_bake.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace nook::measure::crowd {

// The skinning matrices of one character: 12 floats for each bone, the three rows of a matrix that takes the
// rest pose to world space.
using Bones = std::vector<float>;

// Values at the vertices of several characters, one array for each character. A vertex has one float or, for
// light, three.
using VertexValues = std::vector<std::vector<float>>;

// A character in a pose: three floats for each vertex, in world space, positions in metres.
struct Body {
  std::vector<float> positions, normals;
};

// Throws std::runtime_error with the last message of the bakers' library if a call of it failed.
void check_bake(nook_result result);

class PosedCrowd {
 public:
  // The character and the poses must outlive this object.
  PosedCrowd(nook_bake_character character, std::span<const Bones> poses);

  std::size_t size() const { return poses_.size(); }
  std::uint32_t vertex_count() const { return vertex_count_; }
  const std::vector<std::uint32_t>& triangles() const { return triangles_; }  // three indices each

  Body body(std::size_t character) const;
  // The x and z of the first bone, which is precise enough to find the bodies that are far apart.
  glm::vec2 ground_position_m(std::size_t character) const;

 private:
  nook_bake_character character_;
  std::span<const Bones> poses_;
  std::uint32_t vertex_count_ = 0;
  std::vector<std::uint32_t> triangles_;
};

}  // namespace nook::measure::crowd
