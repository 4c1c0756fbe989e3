// Characters: import, creation from memory, and all queries.
#include <nook/nook_bake_character.h>

#include <algorithm>
#include <cmath>

#include "bakers/api/entry.h"
#include "bakers/api/handles.h"
#include "bakers/api/import.h"
#include "bakers/character/auto_poses.h"
#include "bakers/character/pose_sets.h"
#include "bakers/import/skinning.h"
#include "bakers/job/mesh_arrays.h"
#include "bakers/job/pose_arrays.h"
#include "sdk/src/core/descriptors.h"

using namespace nook;
using namespace nook::bake;

namespace {

constexpr std::size_t first_mesh_desc = offsetof(nook_bake_mesh_desc, primitive_count) + sizeof(uint32_t);
constexpr std::size_t first_info = offsetof(nook_bake_character_info, bounds_max) + 3 * sizeof(float);

nook_bake_mesh_desc default_mesh_desc() {
  nook_bake_mesh_desc desc{};
  desc.struct_size = sizeof desc;
  desc.header_version = NOOK_VERSION;
  desc.influences = 4;
  return desc;
}

void hand_out(ImportedCharacter imported, nook_bake_character* out) {
  *out = new nook_bake_character_s{std::make_shared<const ImportedCharacter>(std::move(imported))};
}

const ImportedCharacter& get(nook_bake_character character) {
  need(character, "character");
  return *character->character;
}

void need_index(const char* name, std::size_t index, std::size_t count) {
  if (index >= count)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is out of range (got %zu, there are %zu)", name, index,
                  count);
}

// Writes values of welded vertices in file order.
void write_vertices(const SkinnedMesh& mesh, const std::vector<Vec3>& position, float* positions,
                    float* normals) {
  if (positions) write_points(position, mesh.file_to_welded, positions);
  if (!normals) return;
  std::vector<Vec3> normal;
  vertex_normals(mesh.triangle, position, normal);
  write_points(normal, mesh.file_to_welded, normals);
}

}  // namespace

nook_result api::import_character(const char* path, LinkedFiles linked, nook_bake_character* out) noexcept {
  return enter("nook_bake_import_gltf", [&] {
    need(out, "out");
    *out = nullptr;
    need(path, "path");
    try {
      hand_out(import_gltf(std::filesystem::path(reinterpret_cast<const char8_t*>(path)), linked), out);
    } catch (const Failure& failure) {
      // The message of the importer may already contain the name of the file.
      if (std::string_view(failure.what()).find(path) != std::string_view::npos) throw;
      throw Failure(failure.code(), "%s: %s", path, failure.what());
    }
  });
}

nook_result nook_bake_import_gltf(const char* path, nook_bake_character* out) {
  return api::import_character(path, LinkedFiles::folder, out);
}

nook_result nook_bake_import_gltf_bytes(const void* bytes, size_t size, nook_bake_character* out) {
  return api::enter("nook_bake_import_gltf_bytes", [&] {
    need(out, "out");
    *out = nullptr;
    need(bytes, "bytes");
    hand_out(import_gltf(std::span(static_cast<const std::byte*>(bytes), size)), out);
  });
}

nook_result nook_bake_mesh_desc_init(nook_bake_mesh_desc* desc, size_t size, uint32_t header_version) {
  return api::enter("nook_bake_mesh_desc_init", [&] {
    init_descriptor(desc, size, header_version, first_mesh_desc, default_mesh_desc());
  });
}

nook_result nook_bake_character_create(const nook_bake_mesh_desc* desc, nook_bake_character* out) {
  return api::enter("nook_bake_character_create", [&] {
    need(out, "out");
    *out = nullptr;
    hand_out(character_of_arrays(
                 read_descriptor(desc, "nook_bake_mesh_desc_init", first_mesh_desc, default_mesh_desc())),
             out);
  });
}

void nook_bake_character_destroy(nook_bake_character* character) {
  if (!character) return;
  delete *character;
  *character = nullptr;
}

nook_result nook_bake_character_describe(nook_bake_character character, nook_bake_character_info* info) {
  return api::enter("nook_bake_character_describe", [&] {
    const ImportedCharacter& c = get(character);
    nook_bake_character_info answer{};
    answer.vertex_count = std::uint32_t(c.mesh.vertex_count());
    answer.file_vertex_count = std::uint32_t(c.mesh.file_to_welded.size());
    answer.triangle_count = std::uint32_t(c.mesh.triangle.size());
    answer.bone_count = std::uint32_t(c.mesh.bones.size());
    answer.clip_count = std::uint32_t(c.clips.size());
    answer.primitive_count = std::uint32_t(c.mesh.primitives.size());
    answer.warning_count = std::uint32_t(c.warnings.size());
    Vec3 low = c.mesh.position.front(), high = low;
    for (Vec3 p : c.mesh.position) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const float bounds[] = {low.x, low.y, low.z, high.x, high.y, high.z};
    std::copy_n(bounds, 3, answer.bounds_min);
    std::copy_n(bounds + 3, 3, answer.bounds_max);
    write_info(info, first_info, answer);
  });
}

const char* nook_bake_character_bone_name(nook_bake_character character, uint32_t bone) {
  if (!character || bone >= character->character->mesh.bones.size()) return nullptr;
  return character->character->mesh.bones[bone].name.c_str();
}

const char* nook_bake_character_clip_name(nook_bake_character character, uint32_t clip) {
  if (!character || clip >= character->character->clips.size()) return nullptr;
  return character->character->clips[clip].name.c_str();
}

const char* nook_bake_character_primitive_name(nook_bake_character character, uint32_t primitive) {
  if (!character || primitive >= character->character->mesh.primitives.size()) return nullptr;
  return character->character->mesh.primitives[primitive].mesh_name.c_str();
}

const char* nook_bake_character_warning(nook_bake_character character, uint32_t warning) {
  if (!character || warning >= character->character->warnings.size()) return nullptr;
  return character->character->warnings[warning].c_str();
}

nook_result nook_bake_character_read_bones(nook_bake_character character, int32_t* parents, float* frames_3x4,
                                           uint32_t bone_count) {
  return api::enter("nook_bake_character_read_bones", [&] {
    const std::vector<Bone>& bones = get(character).mesh.bones;
    need_count("bone_count", bone_count, bones.size());
    for (std::size_t b = 0; b < bones.size(); ++b) {
      if (parents) parents[b] = bones[b].parent;
      if (frames_3x4) std::copy_n(bones[b].frame_rest.m, 12, frames_3x4 + 12 * b);
    }
  });
}

nook_result nook_bake_character_describe_primitive(nook_bake_character character, uint32_t primitive,
                                                   nook_bake_primitive* out) {
  return api::enter("nook_bake_character_describe_primitive", [&] {
    const std::vector<Primitive>& primitives = get(character).mesh.primitives;
    need(out, "out");
    need_index("primitive", primitive, primitives.size());
    *out = {primitives[primitive].first_vertex, primitives[primitive].vertex_count};
  });
}

nook_result nook_bake_character_clip_duration(nook_bake_character character, uint32_t clip, float* seconds) {
  return api::enter("nook_bake_character_clip_duration", [&] {
    const ImportedCharacter& c = get(character);
    need(seconds, "seconds");
    need_index("clip", clip, c.clips.size());
    *seconds = c.clips[clip].duration_s;
  });
}

nook_result nook_bake_character_sample_clip(nook_bake_character character, uint32_t clip, float time_s,
                                            float* bones_3x4, uint32_t bone_count) {
  return api::enter("nook_bake_character_sample_clip", [&] {
    const ImportedCharacter& c = get(character);
    need(bones_3x4, "bones_3x4");
    need_index("clip", clip, c.clips.size());
    need_count("bone_count", bone_count, c.mesh.bones.size());
    if (!std::isfinite(time_s))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "time_s is not finite; give seconds");
    write_pose(sample_clip(c, clip, time_s), bones_3x4);
  });
}

nook_result nook_bake_character_auto_poses(nook_bake_character character, uint64_t seed, uint32_t pose_count,
                                           float* bones_3x4, uint32_t bone_count) {
  return api::enter("nook_bake_character_auto_poses", [&] {
    const SkinnedMesh& mesh = get(character).mesh;
    need(bones_3x4, "bones_3x4");
    need_count("bone_count", bone_count, mesh.bones.size());
    const std::vector<Pose> poses = auto_poses(mesh, vertex_areas(mesh, mesh.position), pose_count, seed);
    for (std::size_t p = 0; p < poses.size(); ++p)
      write_pose(poses[p], bones_3x4 + 12 * p * mesh.bones.size());
  });
}

nook_result nook_bake_character_single_joint_poses(nook_bake_character character, uint32_t steps,
                                                   float range_degrees, uint32_t* pose_count,
                                                   float* bones_3x4, uint32_t bone_count) {
  return api::enter("nook_bake_character_single_joint_poses", [&] {
    const SkinnedMesh& mesh = get(character).mesh;
    need(pose_count, "pose_count");
    need_count("bone_count", bone_count, mesh.bones.size());
    if (steps < 1 || steps > 64)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "steps is out of range (got %u, need 1 to 64)", steps);
    if (!(range_degrees >= 0 && range_degrees <= 180))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "range_degrees is out of range (got %g, need 0 to 180)",
                    double(range_degrees));
    const std::vector<Pose> poses = single_joint_poses(mesh, int(steps), range_degrees * 0.0174532925f);
    if (bones_3x4) {
      need_count("*pose_count", *pose_count, poses.size());
      for (std::size_t p = 0; p < poses.size(); ++p)
        write_pose(poses[p], bones_3x4 + 12 * p * mesh.bones.size());
    }
    *pose_count = std::uint32_t(poses.size());
  });
}

nook_result nook_bake_character_read_vertices(nook_bake_character character, float* positions, float* normals,
                                              uint32_t vertex_count) {
  return api::enter("nook_bake_character_read_vertices", [&] {
    const SkinnedMesh& mesh = get(character).mesh;
    need_count("vertex_count", vertex_count, mesh.file_to_welded.size());
    write_vertices(mesh, mesh.position, positions, normals);
  });
}

nook_result nook_bake_character_read_triangles(nook_bake_character character, uint32_t* indices,
                                               uint32_t index_count) {
  return api::enter("nook_bake_character_read_triangles", [&] {
    const SkinnedMesh& mesh = get(character).mesh;
    need(indices, "indices");
    need_count("index_count", index_count, 3 * mesh.triangle.size());
    std::vector<std::uint32_t> file_of_welded(mesh.vertex_count());
    for (std::size_t f = mesh.file_to_welded.size(); f-- > 0;)
      file_of_welded[mesh.file_to_welded[f]] = std::uint32_t(f);
    for (const auto& triangle : mesh.triangle)
      for (std::uint32_t corner : triangle) *indices++ = file_of_welded[corner];
  });
}

nook_result nook_bake_character_read_skin(nook_bake_character character, uint16_t* joints, float* weights,
                                          uint32_t vertex_count) {
  return api::enter("nook_bake_character_read_skin", [&] {
    const SkinnedMesh& mesh = get(character).mesh;
    need(joints, "joints");
    need(weights, "weights");
    need_count("vertex_count", vertex_count, mesh.file_to_welded.size());
    for (std::uint32_t welded : mesh.file_to_welded) {
      const SkinWeights& w = mesh.weights[welded];
      const float sum = w.weight[0] + w.weight[1] + w.weight[2] + w.weight[3];
      for (std::size_t s = 0; s < 4; ++s) {
        *joints++ = w.bone[s];
        *weights++ = w.weight[s] / sum;
      }
    }
  });
}

nook_result nook_bake_character_skin(nook_bake_character character, const float* bones_3x4,
                                     uint32_t bone_count, float* positions, float* normals,
                                     uint32_t vertex_count) {
  return api::enter("nook_bake_character_skin", [&] {
    const SkinnedMesh& mesh = get(character).mesh;
    need(bones_3x4, "bones_3x4");
    need_count("bone_count", bone_count, mesh.bones.size());
    need_count("vertex_count", vertex_count, mesh.file_to_welded.size());
    std::vector<Vec3> posed;
    skin_positions(mesh, read_poses(bones_3x4, 1, bone_count).front(), posed);
    write_vertices(mesh, posed, positions, normals);
  });
}
