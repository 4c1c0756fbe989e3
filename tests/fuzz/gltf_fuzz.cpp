// Imports bytes as a rigged character through the C ABI and queries everything that can be read from it, or
// as a static scene: nothing may crash, and every number in the answers is finite, whatever the bytes. Built
// for libFuzzer with clang; elsewhere gltf_fuzz_replay.cpp drives it.
#include <nook/experimental/nook_trace.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "bakers/import/static_scene.h"
#include "sdk/src/core/failure.h"

namespace {

void require(bool sound) {
  if (!sound) std::abort();
}

bool ok(nook_result result) {
  require(result <= NOOK_OK && result != NOOK_ERROR_INTERNAL);
  return result == NOOK_OK;
}

void require_finite(const std::vector<float>& numbers) {
  for (const float number : numbers) require(std::isfinite(number));
}

// The demands of a small file are bounded, but not worth a fuzzer's time beyond this.
bool is_small(const nook_bake_character_info& info) {
  return info.file_vertex_count <= 1 << 12 && info.bone_count <= 1 << 8 && info.clip_count <= 16 &&
         info.triangle_count <= 1 << 13;
}

void read_texts(nook_bake_character character, const nook_bake_character_info& info) {
  for (std::uint32_t i = 0; i < info.bone_count; ++i)
    require(nook_bake_character_name(character, NOOK_BAKE_NAME_BONE, i));
  for (std::uint32_t i = 0; i < info.clip_count; ++i)
    require(nook_bake_character_name(character, NOOK_BAKE_NAME_CLIP, i));
  for (std::uint32_t i = 0; i < info.primitive_count; ++i)
    require(nook_bake_character_name(character, NOOK_BAKE_NAME_PRIMITIVE, i));
  for (std::uint32_t i = 0; i < info.warning_count; ++i)
    require(nook_bake_character_name(character, NOOK_BAKE_NAME_WARNING, i));
  require(!nook_bake_character_name(character, NOOK_BAKE_NAME_BONE, info.bone_count));
}

struct Arrays {
  std::vector<std::int32_t> parents;
  std::vector<float> frames, positions, normals, weights;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint16_t> joints;
};

Arrays read_arrays(nook_bake_character character, const nook_bake_character_info& info) {
  const std::size_t bones = info.bone_count, vertices = info.file_vertex_count;
  Arrays a{std::vector<std::int32_t>(bones),
           std::vector<float>(12 * bones),
           std::vector<float>(3 * vertices),
           std::vector<float>(3 * vertices),
           std::vector<float>(4 * vertices),
           std::vector<std::uint32_t>(3 * std::size_t(info.triangle_count)),
           std::vector<std::uint16_t>(4 * vertices)};
  const auto read = [&](nook_bake_array array, void* out, std::uint32_t count) {
    if (count > 0) require(ok(nook_bake_character_read(character, array, out, count, 0)));
  };
  read(NOOK_BAKE_ARRAY_PARENTS, a.parents.data(), info.bone_count);
  read(NOOK_BAKE_ARRAY_FRAMES, a.frames.data(), info.bone_count);
  read(NOOK_BAKE_ARRAY_POSITIONS, a.positions.data(), info.file_vertex_count);
  read(NOOK_BAKE_ARRAY_NORMALS, a.normals.data(), info.file_vertex_count);
  read(NOOK_BAKE_ARRAY_TRIANGLES, a.indices.data(), info.triangle_count);
  read(NOOK_BAKE_ARRAY_JOINTS, a.joints.data(), info.file_vertex_count);
  read(NOOK_BAKE_ARRAY_WEIGHTS, a.weights.data(), info.file_vertex_count);
  std::vector<nook_range> primitives(info.primitive_count);
  read(NOOK_BAKE_ARRAY_PRIMITIVES, primitives.data(), info.primitive_count);
  for (const auto* numbers : {&a.frames, &a.positions, &a.normals, &a.weights}) require_finite(*numbers);
  for (const std::uint32_t index : a.indices) require(index < info.file_vertex_count);
  for (const std::uint16_t joint : a.joints) require(joint < info.bone_count);
  std::uint32_t next = 0;
  for (const nook_range& primitive : primitives) {
    require(primitive.first == next);
    next += primitive.count;
  }
  return a;
}

void skin(nook_bake_character character, const nook_bake_character_info& info, const float* pose) {
  std::vector<float> positions(3 * std::size_t(info.file_vertex_count)), normals(positions.size());
  if (!ok(nook_bake_character_skin(character, pose, info.bone_count, positions.data(), normals.data(),
                                   info.file_vertex_count)))
    return;
  require_finite(normals);
}

void sample_clips(nook_bake_character character, const nook_bake_character_info& info) {
  std::vector<float> pose(12 * std::size_t(info.bone_count));
  for (std::uint32_t clip = 0; clip < info.clip_count; ++clip) {
    float seconds = 0;
    require(ok(nook_bake_character_clip_duration(character, clip, &seconds)) && std::isfinite(seconds) &&
            seconds >= 0);
    for (const float time_s : {0.0f, 0.3f * seconds, seconds, -1.0f}) {
      require(ok(nook_bake_character_sample_clip(character, clip, time_s, pose.data(), info.bone_count)));
      require_finite(pose);
    }
    skin(character, info, pose.data());
  }
}

void make_poses(nook_bake_character character, const nook_bake_character_info& info) {
  std::vector<float> poses(2 * 12 * std::size_t(info.bone_count));
  require(ok(nook_bake_character_auto_poses(character, 7, 2, poses.data(), info.bone_count)));
  require_finite(poses);
  skin(character, info, poses.data());
  std::uint32_t count = 0;
  if (!ok(nook_bake_character_single_joint_poses(character, 2, 30, &count, nullptr, info.bone_count)) ||
      count > 64)
    return;
  poses.resize(12 * std::size_t(count) * info.bone_count);
  require(
      ok(nook_bake_character_single_joint_poses(character, 2, 30, &count, poses.data(), info.bone_count)));
  require_finite(poses);
}

// The same character again, from its arrays.
void create(const Arrays& a, const nook_bake_character_info& info) {
  nook_bake_source_desc desc;
  require(ok(nook_bake_source_desc_init(&desc)));
  desc.positions = a.positions.data();
  desc.indices = a.indices.data();
  desc.joints = a.joints.data();
  desc.weights = a.weights.data();
  desc.vertex_count = info.file_vertex_count;
  desc.index_count = std::uint32_t(a.indices.size());
  desc.bone_count = info.bone_count;
  desc.bone_parents = a.parents.data();
  desc.bone_frames_3x4 = a.frames.data();
  nook_bake_character again = nullptr;
  ok(nook_bake_character_create(&desc, &again));
  nook_bake_character_destroy(&again);
}

void import_character(const std::uint8_t* data, std::size_t size) {
  const std::uint8_t none = 0;
  nook_bake_source_desc desc;
  require(ok(nook_bake_source_desc_init(&desc)));
  desc.bytes = size > 0 ? data : &none;
  desc.byte_count = size;
  nook_bake_character character = nullptr;
  if (!ok(nook_bake_character_create(&desc, &character))) {
    require(character == nullptr && nook_bake_last_message()[0] != 0);
    return;
  }
  nook_bake_character_info info{};
  info.struct_size = sizeof info;
  require(ok(nook_bake_character_describe(character, &info)));
  if (is_small(info)) {
    read_texts(character, info);
    const Arrays arrays = read_arrays(character, info);
    sample_clips(character, info);
    make_poses(character, info);
    create(arrays, info);
  }
  nook_bake_character_destroy(&character);
}

void import_scene(const std::uint8_t* data, std::size_t size) {
  using namespace nook::bake;
  try {
    const StaticScene scene = import_static_scene(std::as_bytes(std::span(data, size)), SceneTextures::read);
    for (const auto& triangle : scene.triangle)
      for (const std::uint32_t vertex : triangle) require(vertex < scene.position.size());
    for (const std::uint32_t surface : scene.triangle_surface) require(surface < scene.surface.size());
    for (const nook::Vec3 p : scene.position) require(std::isfinite(p.x + p.y + p.z));
  } catch (const nook::Failure&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // Either import parses the document, which is most of its time: the sum of the bytes chooses one.
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < size; ++i) sum += data[i];
  sum % 3 == 2 ? import_scene(data, size) : import_character(data, size);
  return 0;
}
