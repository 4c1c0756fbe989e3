#include "bakers/job/caller_arrays.h"

#include <algorithm>
#include <cmath>

#include "bakers/import/content_hash.h"
#include "bakers/import/weld.h"
#include "bakers/raytrace/worker_arena.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"

namespace nook::bake {

std::vector<Pose> read_poses(const float* bones_3x4, std::size_t poses, std::size_t bones) {
  std::vector<Pose> result(poses, Pose(bones));
  for (std::size_t p = 0; p < poses; ++p)
    for (std::size_t b = 0; b < bones; ++b) {
      const float* m = bones_3x4 + 12 * (p * bones + b);
      std::copy_n(m, 12, result[p][b].m);
      if (!is_pose_matrix(result[p][b]))
        throw Failure(
            NOOK_ERROR_INVALID_ARGUMENT,
            "the matrix of bone %zu in pose %zu is not finite or far too large; give 12 finite floats, "
            "places up to 1e9 m and scales up to 1e6",
            b, p);
    }
  return result;
}

void write_pose(const Pose& pose, float* bones_3x4) {
  for (const Mat3x4& bone : pose) bones_3x4 = std::copy_n(bone.m, 12, bones_3x4);
}

void write_points(std::span<const Vec3> welded, std::span<const std::uint32_t> file_to_welded, float* xyz) {
  for (std::uint32_t w : file_to_welded) {
    *xyz++ = welded[w].x;
    *xyz++ = welded[w].y;
    *xyz++ = welded[w].z;
  }
}

void need_count(const char* name, std::size_t got, std::size_t needed) {
  if (got != needed)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is wrong (got %zu, need %zu)", name, got, needed);
}

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
  character.source_hash = short_hash(content_hash(character));
  return character;
}

namespace {

constexpr std::uint32_t most_rays = 65536;

}  // namespace

void add_mesh(const nook_bake_occluder_mesh& mesh, std::uint32_t number, TriangleSoup& soup) {
  if (mesh.index_count == 0) return;
  need(mesh.positions, "desc.meshes[i].positions");
  need(mesh.indices, "desc.meshes[i].indices");
  if (mesh.index_count % 3)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.meshes[%u].index_count is not a multiple of 3 (got %u)",
                  number, mesh.index_count);
  const auto base = std::uint32_t(soup.position.size());
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
    soup.position.push_back({mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]});
    const Vec3 p = soup.position.back();
    if (!is_place(p))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.meshes[%u] has vertex %u out of range (got %g %g %g, need finite metres up to 1e6)",
                    number, v, double(p.x), double(p.y), double(p.z));
  }
  for (std::uint32_t i = 0; i < mesh.index_count; i += 3) {
    for (std::uint32_t c = 0; c < 3; ++c)
      if (mesh.indices[i + c] >= mesh.vertex_count)
        throw Failure(
            NOOK_ERROR_INVALID_ARGUMENT,
            "desc.meshes[%u] has an index out of range (got %u, need less than the number of vertices, %u)",
            number, mesh.indices[i + c], mesh.vertex_count);
    soup.triangle.push_back({base + mesh.indices[i], base + mesh.indices[i + 1], base + mesh.indices[i + 2]});
  }
}

std::vector<Vec3> read_points(const char* name, const float* xyz, std::uint32_t count) {
  std::vector<Vec3> points(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    points[i] = {xyz[3 * std::size_t(i)], xyz[3 * std::size_t(i) + 1], xyz[3 * std::size_t(i) + 2]};
    if (!is_place(points[i]))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "%s is out of range at point %u (got %g %g %g, need finite numbers up to 1e6)", name, i,
                    double(points[i].x), double(points[i].y), double(points[i].z));
  }
  return points;
}

std::vector<Vec3> read_normals(const char* name, const float* xyz, std::uint32_t count) {
  std::vector<Vec3> normals = read_points(name, xyz, count);
  for (std::uint32_t i = 0; i < count; ++i)
    if (std::abs(length(normals[i]) - 1) > 1e-3f)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "%s is not of unit length at point %u (got %g); normalise it", name, i,
                    double(length(normals[i])));
  return normals;
}

void need_trace_settings(std::uint32_t rays, std::uint32_t threads, float origin_offset) {
  check_range("desc.rays", rays, 1, most_rays);
  need_threads(threads);
  check_fits("desc.origin_offset", origin_offset, origin_offset >= 0 && origin_offset <= max_metres,
             "0 to 1e6 metres");
}

}  // namespace nook::bake
