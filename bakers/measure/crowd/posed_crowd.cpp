#include "bakers/measure/crowd/posed_crowd.h"

#include <stdexcept>

namespace nook::measure::crowd {

void check_bake(nook_result result) {
  if (result != NOOK_OK) throw std::runtime_error(nook_bake_last_message());
}

PosedCrowd::PosedCrowd(nook_bake_character character, std::span<const Bones> poses)
    : character_(character), poses_(poses) {
  nook_bake_character_info info{};
  info.struct_size = sizeof info;
  check_bake(nook_bake_character_describe(character, &info));
  vertex_count_ = info.file_vertex_count;
  triangles_.resize(3 * std::size_t(info.triangle_count));
  check_bake(nook_bake_character_read(character, NOOK_BAKE_ARRAY_TRIANGLES, triangles_.data(),
                                      info.triangle_count, 0));
}

Body PosedCrowd::body(std::size_t character) const {
  const Bones& bones = poses_[character];
  Body body;
  body.positions.resize(3 * std::size_t(vertex_count_));
  body.normals.resize(body.positions.size());
  check_bake(nook_bake_character_skin(character_, bones.data(), std::uint32_t(bones.size() / 12),
                                      body.positions.data(), body.normals.data(), vertex_count_));
  return body;
}

glm::vec2 PosedCrowd::ground_position_m(std::size_t character) const {
  return {poses_[character][3], poses_[character][11]};
}

}  // namespace nook::measure::crowd
