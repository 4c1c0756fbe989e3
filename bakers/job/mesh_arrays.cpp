#include "bakers/job/mesh_arrays.h"

#include <algorithm>
#include <span>

#include "bakers/import/weld.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/hash.h"

namespace nook::bake {
namespace {

std::vector<Vec3> points(const float* xyz, std::size_t count) {
  std::vector<Vec3> result(count);
  for (std::size_t i = 0; i < count; ++i) result[i] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
  return result;
}

std::vector<Bone> bones_of(const nook_bake_source_desc& desc) {
  std::vector<Bone> bones(desc.bone_count);
  for (std::size_t b = 0; b < bones.size(); ++b) {
    const char* name = desc.bone_names ? desc.bone_names[b] : nullptr;
    bones[b].name = name ? name : "bone_" + std::to_string(b);
    bones[b].parent = desc.bone_parents[b];
    std::copy_n(desc.bone_frames_3x4 + 12 * b, 12, bones[b].frame_rest.m);
  }
  return bones;
}

}  // namespace

ImportedCharacter character_of_arrays(const nook_bake_source_desc& desc) {
  need(desc.positions, "desc.positions");
  need(desc.indices, "desc.indices");
  need(desc.joints, "desc.joints");
  need(desc.weights, "desc.weights");
  need(desc.bone_parents, "desc.bone_parents");
  need(desc.bone_frames_3x4, "desc.bone_frames_3x4");
  check_range("desc.influences", desc.influences, 1, 64);
  if (desc.primitive_count > 0) need(desc.primitives, "desc.primitives");
  const std::vector<Vec3> position = points(desc.positions, desc.vertex_count);
  const std::size_t pairs = std::size_t(desc.influences) * desc.vertex_count;

  MeshArrays arrays;
  arrays.bones = bones_of(desc);
  arrays.position = position;
  arrays.index = {desc.indices, desc.index_count};
  arrays.influences = desc.influences;
  arrays.joint = {desc.joints, pairs};
  arrays.weight = {desc.weights, pairs};
  for (std::uint32_t p = 0; p < desc.primitive_count; ++p)
    arrays.primitives.push_back(
        {"primitive_" + std::to_string(p), desc.primitives[p].first, desc.primitives[p].count});

  ImportedCharacter character;
  character.mesh = weld(to_file_mesh(arrays, NOOK_ERROR_INVALID_ARGUMENT), character.warnings,
                        NOOK_ERROR_INVALID_ARGUMENT);
  std::uint64_t hash = hash64(std::as_bytes(std::span(position)));
  hash = hash64(std::as_bytes(arrays.index), hash);
  character.source_hash = hash64(std::as_bytes(arrays.weight), hash);
  return character;
}

}  // namespace nook::bake
