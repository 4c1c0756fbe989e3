#include "hero.h"

#include <algorithm>
#include <cctype>

namespace crowd {
namespace {

constexpr std::uint32_t kRestPose = ~0u;

// T- and A-poses show nothing, and who sits needs a chair that this sample does not have.
bool is_unfit(std::string name) {
  std::erase_if(name, [](unsigned char c) { return !std::isalnum(c); });
  for (char& c : name) c = char(std::tolower(static_cast<unsigned char>(c)));
  return name.find("tpose") != std::string::npos || name.find("apose") != std::string::npos ||
         name.starts_with("sit");
}

}  // namespace

void bake_check(nook_result result) {
  if (result != NOOK_OK) throw BakeError(result, nook_bake_last_message());
}

Hero::Hero(std::span<const unsigned char> glb_bytes) {
  nook_bake_character handle = nullptr;
  bake_check(nook_bake_import_gltf_bytes(glb_bytes.data(), glb_bytes.size(), &handle));
  character_.reset(handle);
  read();
}

Hero::Hero(const std::string& path) {
  nook_bake_character handle = nullptr;
  bake_check(nook_bake_import_gltf(path.c_str(), &handle));
  character_.reset(handle);
  read();
}

void Hero::read() {
  info_.struct_size = sizeof info_;
  bake_check(nook_bake_character_describe(handle(), &info_));
  const std::uint32_t n = vertex_count();
  positions_m.resize(3 * n);
  normals.resize(3 * n);
  joints.resize(4 * n);
  weights.resize(4 * n);
  triangles.resize(3 * info_.triangle_count);
  bake_check(nook_bake_character_read_vertices(handle(), positions_m.data(), normals.data(), n));
  bake_check(nook_bake_character_read_skin(handle(), joints.data(), weights.data(), n));
  bake_check(nook_bake_character_read_triangles(handle(), triangles.data(), std::uint32_t(triangles.size())));
  for (std::uint32_t i = 0; i < info_.clip_count; ++i) {
    Clip clip{i, nook_bake_character_clip_name(handle(), i), 0};
    bake_check(nook_bake_character_clip_duration(handle(), i, &clip.duration_s));
    if (!is_unfit(clip.name)) clips_.push_back(clip);
  }
  if (clips_.empty()) clips_.push_back({kRestPose, "rest pose", 1.0f});
}

Bones Hero::pose(std::size_t clip, float phase) const {
  Bones bones(12 * std::size_t(bone_count()), 0.0f);
  const Clip& c = clips_.at(clip);
  if (c.index == kRestPose) {
    for (std::size_t b = 0; b < bone_count(); ++b)
      bones[12 * b] = bones[12 * b + 5] = bones[12 * b + 10] = 1.0f;
  } else {
    bake_check(
        nook_bake_character_sample_clip(handle(), c.index, phase * c.duration_s, bones.data(), bone_count()));
  }
  return bones;
}

void Hero::skin(const Bones& bones, std::vector<float>& positions_ws, std::vector<float>& normals_ws) const {
  positions_ws.resize(3 * std::size_t(vertex_count()));
  normals_ws.resize(positions_ws.size());
  bake_check(nook_bake_character_skin(handle(), bones.data(), bone_count(), positions_ws.data(),
                                      normals_ws.data(), vertex_count()));
}

}  // namespace crowd
