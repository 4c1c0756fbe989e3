// Characters: import, creation from memory, and all queries.
#include <nook/experimental/nook_trace.h>
#include <nook/nook_bake.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "bakers/api/bake_descriptors.h"
#include "bakers/api/bake_entry.h"
#include "bakers/api/bake_handles.h"
#include "bakers/character/auto_poses.h"
#include "bakers/character/pose_sets.h"
#include "bakers/import/posed_normals.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/job/caller_arrays.h"
#include "sdk/src/core/checks.h"

using namespace nook;
using namespace nook::bake;

namespace {

void hand_out(ImportedCharacter imported, MeshSelection meshes, nook_bake_character* out) {
  *out = new nook_bake_character_s{std::make_shared<const ImportedCharacter>(std::move(imported)),
                                   std::move(meshes)};
}

const ImportedCharacter& get(nook_bake_character character) {
  need(character, "character");
  return *character->character;
}

void need_index(const char* name, std::size_t index, std::size_t count) {
  if (index >= count)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is out of range (got %zu, need less than %zu)", name,
                  index, count);
}

// If a path is a pipe without a writer, opening it would wait forever without a message.
void require_regular_file(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  // Does not reject missing files and folders here, because the importer reports them with a good message.
  if (!std::filesystem::exists(status) || std::filesystem::is_directory(status) ||
      std::filesystem::is_regular_file(status))
    return;
  throw Failure(NOOK_ERROR_BAD_FILE,
                "this is not a regular file but a pipe, a socket or a device; read it yourself and pass its "
                "contents as desc.bytes");
}

ImportedCharacter import_file(const char* path, const ImportOptions& options) {
  try {
    const std::filesystem::path file(reinterpret_cast<const char8_t*>(path));
    require_regular_file(file);
    return import_gltf(file, options);
  } catch (const Failure& failure) {
    // The message of the importer may already contain the name of the file.
    if (std::string_view(failure.what()).find(path) != std::string_view::npos) throw;
    throw Failure(failure.code(), "%s: %s", path, failure.what());
  }
}

std::vector<std::string> read_patterns(const char* name, const char* const* patterns, std::uint32_t count) {
  if (count > 0) need(patterns, name);
  std::vector<std::string> out;
  for (std::uint32_t i = 0; i < count; ++i) {
    need(patterns[i], name);
    out.emplace_back(patterns[i]);
  }
  return out;
}

MeshSelection meshes_of(const nook_bake_source_desc& desc) {
  return {read_patterns("desc.meshes", desc.meshes, desc.mesh_count),
          read_patterns("desc.without", desc.without, desc.without_count)};
}

ImportedCharacter character_of(const nook_bake_source_desc& desc, const MeshSelection& meshes) {
  const bool has_arrays = desc.positions || desc.indices || desc.joints || desc.weights ||
                          desc.bone_parents || desc.bone_frames_3x4;
  const int sources = int(desc.path != nullptr) + int(desc.bytes != nullptr) + int(has_arrays);
  if (sources != 1)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc contains %s of desc.path, desc.bytes and arrays such as desc.positions; set exactly "
                  "one of them",
                  sources == 0 ? "none" : "more than one");
  if (has_arrays && !(meshes.only.empty() && meshes.without.empty()))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.meshes and desc.without choose meshes of a file, but desc contains arrays; leave "
                  "desc.meshes and desc.without NULL");
  check_switch("desc.allow_outside_files", desc.allow_outside_files);
  const LinkedFiles linked = desc.allow_outside_files ? LinkedFiles::anywhere : LinkedFiles::folder;
  if (desc.path) return import_file(desc.path, {linked, meshes});
  if (desc.bytes)
    return import_gltf(std::span(static_cast<const std::byte*>(desc.bytes), desc.byte_count), meshes);
  return character_of_arrays(desc);
}

// Copies elements of `size` bytes each to the positions that the caller chose.
class Rows {
 public:
  Rows(void* out, std::size_t count, std::size_t size, std::size_t stride)
      : at_(static_cast<std::byte*>(out)),
        size_(size),
        stride_(checked_stride("stride", stride, count, size)) {}
  void add(const void* element) {
    std::memcpy(at_, element, size_);
    at_ += stride_;
  }

 private:
  std::byte* at_;
  std::size_t size_, stride_;
};

void read_bones(const std::vector<Bone>& bones, nook_bake_array array, void* out, std::size_t stride) {
  const bool parents = array == NOOK_BAKE_ARRAY_PARENTS;
  Rows rows(out, bones.size(), parents ? sizeof(std::int32_t) : 12 * sizeof(float), stride);
  for (const Bone& bone : bones) {
    const std::int32_t parent = bone.parent;
    parents ? rows.add(&parent) : rows.add(bone.frame_rest.m);
  }
}

void read_primitives(const SkinnedMesh& mesh, void* out, std::size_t stride) {
  Rows rows(out, mesh.primitives.size(), sizeof(nook_range), stride);
  for (const Primitive& primitive : mesh.primitives) {
    const nook_range range{primitive.first_vertex, primitive.vertex_count};
    rows.add(&range);
  }
}

void read_vertices(const SkinnedMesh& mesh, nook_bake_array array, void* out, std::size_t stride) {
  Rows rows(out, mesh.file_to_welded.size(), 3 * sizeof(float), stride);
  std::vector<Vec3> normal;
  if (array == NOOK_BAKE_ARRAY_NORMALS) vertex_normals(mesh.triangle, mesh.position, normal);
  const std::vector<Vec3>& of = array == NOOK_BAKE_ARRAY_NORMALS ? normal : mesh.position;
  for (const std::uint32_t welded : mesh.file_to_welded) {
    const float xyz[] = {of[welded].x, of[welded].y, of[welded].z};
    rows.add(xyz);
  }
}

void read_triangles(const SkinnedMesh& mesh, void* out, std::size_t stride) {
  Rows rows(out, mesh.triangle.size(), 3 * sizeof(std::uint32_t), stride);
  std::vector<std::uint32_t> file_of_welded(mesh.vertex_count());
  for (std::size_t f = mesh.file_to_welded.size(); f-- > 0;)
    file_of_welded[mesh.file_to_welded[f]] = std::uint32_t(f);
  for (const auto& triangle : mesh.triangle) {
    const std::uint32_t corners[] = {file_of_welded[triangle[0]], file_of_welded[triangle[1]],
                                     file_of_welded[triangle[2]]};
    rows.add(corners);
  }
}

void read_skin(const SkinnedMesh& mesh, nook_bake_array array, void* out, std::size_t stride) {
  const bool joints = array == NOOK_BAKE_ARRAY_JOINTS;
  Rows rows(out, mesh.file_to_welded.size(), joints ? 4 * sizeof(std::uint16_t) : 4 * sizeof(float), stride);
  for (const std::uint32_t welded : mesh.file_to_welded) {
    const SkinWeights& w = mesh.weights[welded];
    const float sum = w.weight[0] + w.weight[1] + w.weight[2] + w.weight[3];
    std::uint16_t bone[4];
    float weight[4];
    for (std::size_t s = 0; s < 4; ++s) {
      bone[s] = w.bone[s];
      weight[s] = w.weight[s] / sum;
    }
    joints ? rows.add(bone) : rows.add(weight);
  }
}

// Writes the posed welded vertices in the vertex order of the file.
void write_posed(const SkinnedMesh& mesh, const Pose& pose, float* positions, float* normals) {
  std::vector<Vec3> position, normal;
  skin_positions(mesh, pose, position);
  if (positions) write_points(position, mesh.file_to_welded, positions);
  if (!normals) return;
  posed_normals(mesh, pose, position, normal);
  write_points(normal, mesh.file_to_welded, normals);
}

}  // namespace

nook_result nook_bake_character_create(const nook_bake_source_desc* desc, nook_bake_character* out) {
  return api::enter("nook_bake_character_create", [&] {
    need(out, "out");
    *out = nullptr;
    const nook_bake_source_desc source = read_descriptor(desc);
    MeshSelection meshes = meshes_of(source);
    ImportedCharacter imported = character_of(source, meshes);
    hand_out(std::move(imported), std::move(meshes), out);
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
    write_info(info, answer);
  });
}

const char* nook_bake_character_name(nook_bake_character character, nook_bake_name kind, uint32_t index) {
  if (!character) return nullptr;
  const ImportedCharacter& c = *character->character;
  switch (kind) {
    case NOOK_BAKE_NAME_BONE:
      return index < c.mesh.bones.size() ? c.mesh.bones[index].name.c_str() : nullptr;
    case NOOK_BAKE_NAME_CLIP:
      return index < c.clips.size() ? c.clips[index].name.c_str() : nullptr;
    case NOOK_BAKE_NAME_PRIMITIVE:
      return index < c.mesh.primitives.size() ? c.mesh.primitives[index].mesh_name.c_str() : nullptr;
    case NOOK_BAKE_NAME_WARNING:
      return index < c.warnings.size() ? c.warnings[index].c_str() : nullptr;
    default:
      return nullptr;
  }
}

nook_result nook_bake_character_read(nook_bake_character character, nook_bake_array array, void* out,
                                     uint32_t count, size_t stride) {
  return api::enter("nook_bake_character_read", [&] {
    const SkinnedMesh& mesh = get(character).mesh;
    need(out, "out");
    switch (array) {
      case NOOK_BAKE_ARRAY_PARENTS:
      case NOOK_BAKE_ARRAY_FRAMES:
        need_count("count", count, mesh.bones.size());
        return read_bones(mesh.bones, array, out, stride);
      case NOOK_BAKE_ARRAY_PRIMITIVES:
        need_count("count", count, mesh.primitives.size());
        return read_primitives(mesh, out, stride);
      case NOOK_BAKE_ARRAY_POSITIONS:
      case NOOK_BAKE_ARRAY_NORMALS:
        need_count("count", count, mesh.file_to_welded.size());
        return read_vertices(mesh, array, out, stride);
      case NOOK_BAKE_ARRAY_TRIANGLES:
        need_count("count", count, mesh.triangle.size());
        return read_triangles(mesh, out, stride);
      case NOOK_BAKE_ARRAY_JOINTS:
      case NOOK_BAKE_ARRAY_WEIGHTS:
        need_count("count", count, mesh.file_to_welded.size());
        return read_skin(mesh, array, out, stride);
      default:
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "array is unknown (got %d); use a NOOK_BAKE_ARRAY_ value",
                      int(array));
    }
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
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "time_s is not finite; pass a time in seconds");
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
    check_range("steps", steps, 1, 64);
    check_range("range_degrees", range_degrees, 0, 180);
    const std::vector<Pose> poses = single_joint_poses(mesh, int(steps), range_degrees * 0.0174532925f);
    if (bones_3x4) {
      need_count("*pose_count", *pose_count, poses.size());
      for (std::size_t p = 0; p < poses.size(); ++p)
        write_pose(poses[p], bones_3x4 + 12 * p * mesh.bones.size());
    }
    *pose_count = std::uint32_t(poses.size());
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
    write_posed(mesh, read_poses(bones_3x4, 1, bone_count).front(), positions, normals);
  });
}
