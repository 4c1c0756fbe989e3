#include "tests/bakers/lab/crowd/plates.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace plates {

Character make_character() {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t z = 0; z < kSide; ++z)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      positions.insert(positions.end(), {0.5f * float(x) - 1, 0, 0.5f * float(z) - 1});
      if (x + 1 == kSide || z + 1 == kSide) continue;
      const std::uint32_t a = z * kSide + x, b = a + kSide;
      indices.insert(indices.end(), {a, b, a + 1, a + 1, b, b + 1});
    }
  positions.insert(positions.end(), {0.1f, 0, 0.1f});
  const std::vector<std::uint16_t> joints(kVertices, 0);
  const std::vector<float> weights(kVertices, 1.0f);
  const std::int32_t parent = -1;
  const float frame[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  nook_bake_source_desc desc;
  nook_bake_source_desc_init(&desc);
  desc.positions = positions.data();
  desc.indices = indices.data();
  desc.joints = joints.data();
  desc.weights = weights.data();
  desc.vertex_count = kVertices;
  desc.index_count = std::uint32_t(indices.size());
  desc.influences = 1;
  desc.bone_count = 1;
  desc.bone_parents = &parent;
  desc.bone_frames_3x4 = frame;
  nook_bake_character character = nullptr;
  if (nook_bake_character_create(&desc, &character) != NOOK_OK)
    throw std::runtime_error(nook_bake_last_message());
  return Character(character);
}

nook::lab::crowd::Bones pose(float x_m, float y_m, float z_m, float turns) {
  const float angle = 2 * std::numbers::pi_v<float> * turns, c = std::cos(angle), s = std::sin(angle);
  return {1, 0, 0, x_m, 0, c, -s, y_m, 0, s, c, z_m};
}

// Four times the form factor from a point to a rectangle whose corner lies straight before it.
float covered_share(float distance_m) {
  const float x = 1 / distance_m, root = std::sqrt(1 + x * x);
  return 4 * (x / root * std::atan(x / root)) / std::numbers::pi_v<float>;
}

}  // namespace plates
