#include "samples/crowd/hero.h"

#include <algorithm>
#include <cctype>

#include "platform/file_bytes.h"
#include "bakers/mannequin/mannequin.h"

namespace crowd {
namespace {

constexpr std::uint32_t kRestPose = ~0u;

// FNV-1a of 64 bits.
std::uint64_t hash_of(std::span<const unsigned char> bytes) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211ULL;
  return hash;
}

// T-poses and A-poses show nothing, and a character that sits needs a chair, which this sample does not have.
bool is_unfit(std::string name) {
  std::erase_if(name, [](unsigned char c) { return !std::isalnum(c); });
  for (char& c : name) c = char(std::tolower(static_cast<unsigned char>(c)));
  return name.find("tpose") != std::string::npos || name.find("apose") != std::string::npos ||
         name.starts_with("sit");
}

}  // namespace

void check_bake(nook_result result) {
  if (result != NOOK_OK) throw BakeError(result, nook_bake_last_message());
}

Hero::Hero(std::span<const unsigned char> glb_bytes) : source_hash_(hash_of(glb_bytes)) {
  nook_bake_source_desc desc;
  check_bake(nook_bake_source_desc_init(&desc));
  desc.bytes = glb_bytes.data();
  desc.byte_count = glb_bytes.size();
  nook_bake_character handle = nullptr;
  check_bake(nook_bake_character_create(&desc, &handle));
  character_.reset(handle);
  read();
}

Hero::Hero(const std::filesystem::path& path) : source_hash_(hash_of(platform::read_file(path))) {
  nook_bake_source_desc desc;
  check_bake(nook_bake_source_desc_init(&desc));
  desc.path = path.c_str();
  nook_bake_character handle = nullptr;
  check_bake(nook_bake_character_create(&desc, &handle));
  character_.reset(handle);
  read();
}

void Hero::read() {
  info_.struct_size = sizeof info_;
  check_bake(nook_bake_character_describe(handle(), &info_));
  const std::uint32_t n = vertex_count();
  positions_m.resize(3 * n);
  normals.resize(3 * n);
  joints.resize(4 * n);
  weights.resize(4 * n);
  triangles.resize(3 * info_.triangle_count);
  const auto read_array = [&](nook_bake_array array, void* out, std::uint32_t count) {
    check_bake(nook_bake_character_read(handle(), array, out, count, 0));
  };
  read_array(NOOK_BAKE_ARRAY_POSITIONS, positions_m.data(), n);
  read_array(NOOK_BAKE_ARRAY_NORMALS, normals.data(), n);
  read_array(NOOK_BAKE_ARRAY_JOINTS, joints.data(), n);
  read_array(NOOK_BAKE_ARRAY_WEIGHTS, weights.data(), n);
  read_array(NOOK_BAKE_ARRAY_TRIANGLES, triangles.data(), info_.triangle_count);
  for (std::uint32_t i = 0; i < info_.clip_count; ++i) {
    Clip clip{i, nook_bake_character_name(handle(), NOOK_BAKE_NAME_CLIP, i), 0};
    check_bake(nook_bake_character_clip_duration(handle(), i, &clip.duration_s));
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
    check_bake(
        nook_bake_character_sample_clip(handle(), c.index, phase * c.duration_s, bones.data(), bone_count()));
  }
  return bones;
}

void Hero::skin(const Bones& bones, std::vector<float>& positions_ws, std::vector<float>& normals_ws) const {
  positions_ws.resize(3 * std::size_t(vertex_count()));
  normals_ws.resize(positions_ws.size());
  check_bake(nook_bake_character_skin(handle(), bones.data(), bone_count(), positions_ws.data(),
                                      normals_ws.data(), vertex_count()));
}

std::vector<unsigned char> built_in_glb(const std::filesystem::path& cache) {
  std::vector<unsigned char> bytes = nook::bake::mannequin::make_mannequin_glb();
  platform::write_file(cache / "mannequin.glb", bytes.data(), bytes.size());
  return bytes;
}

}  // namespace crowd
