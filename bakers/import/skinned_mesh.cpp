#include "bakers/import/skinned_mesh.h"

#include <algorithm>
#include <cmath>

#include "bakers/import/weld.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"

namespace nook::bake {

void skin_positions(const SkinnedMesh& mesh, const Pose& pose, std::vector<Vec3>& out_ws) {
  if (pose.size() != mesh.bones.size())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the number of bone matrices is wrong (got %zu, need %zu)",
                  pose.size(), mesh.bones.size());
  out_ws.resize(mesh.vertex_count());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const SkinWeights& weights = mesh.weights[v];
    float m[12];
    const float* first = pose[weights.bone[0]].m;
    for (int i = 0; i < 12; ++i) m[i] = weights.weight[0] * first[i];
    for (int k = 1; k < SkinWeights::max_bones && weights.weight[k] > 0; ++k) {
      const float* bone = pose[weights.bone[k]].m;
      const float w = weights.weight[k];
      for (int i = 0; i < 12; ++i) m[i] += w * bone[i];
    }
    const Vec3 p = mesh.position[v];
    out_ws[v] = {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                 m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
  }
}

void vertex_normals(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const Vec3> positions,
                    std::vector<Vec3>& out) {
  const auto face_normal = [&](const std::array<std::uint32_t, 3>& t) {
    return cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]);
  };
  out.assign(positions.size(), Vec3{});
  std::vector<float> total(positions.size(), 0.0f);
  for (const auto& t : triangles) {
    const Vec3 n = face_normal(t);
    const float size = length(n);
    for (const std::uint32_t v : t) {
      out[v] += n;
      total[v] += size;
    }
  }
  // If the normals of the faces cancel out, their sum is only a rounding error and has no direction.
  const auto has_direction = [&](std::size_t v) { return length(out[v]) > 1e-6f * total[v]; };
  bool needs_face = false;
  for (std::size_t v = 0; v < out.size(); ++v) {
    if (has_direction(v)) {
      out[v] = normalised(out[v]);
      total[v] = 0;
    } else {
      out[v] = {0, 1, 0};
      needs_face = needs_face || total[v] > 0;
    }
  }
  if (!needs_face) return;
  for (const auto& t : triangles)
    for (const std::uint32_t v : t)
      if (total[v] > 0) {
        const Vec3 n = normalised(face_normal(t));
        if (n == Vec3{}) continue;
        out[v] = n;
        total[v] = 0;
      }
}

std::vector<float> vertex_areas(const SkinnedMesh& mesh, std::span<const Vec3> positions) {
  std::vector<double> area(positions.size(), 0.0);
  for (const auto& t : mesh.triangle) {
    const Vec3 p[3] = {positions[t[0]], positions[t[1]], positions[t[2]]};
    const double twice = length(cross(p[1] - p[0], p[2] - p[0]));
    if (!(twice > 0)) continue;
    double at_corner[3];  // dot product of the two edges that leave the corner: negative where obtuse
    double opposite[3];   // squared length of the edge opposite the corner
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = p[(i + 1) % 3] - p[i];
      const Vec3 b = p[(i + 2) % 3] - p[i];
      at_corner[i] = dot(a, b);
      opposite[i] = dot(p[(i + 2) % 3] - p[(i + 1) % 3], p[(i + 2) % 3] - p[(i + 1) % 3]);
    }
    const bool is_obtuse = at_corner[0] < 0 || at_corner[1] < 0 || at_corner[2] < 0;
    for (int i = 0; i < 3; ++i) {
      if (is_obtuse) {
        area[t[i]] += at_corner[i] < 0 ? twice / 4 : twice / 8;
      } else {
        // Equation 7 of the paper: 1/8 of the square of each edge times the opposite cotangent. A cotangent
        // is the dot product divided by the length of the cross product.
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        area[t[i]] += (opposite[j] * at_corner[j] + opposite[k] * at_corner[k]) / (8 * twice);
      }
    }
  }
  return {area.begin(), area.end()};
}

namespace {

// Calls fault(i) for each i below `count`. If any call returns true, throws with the first such i and their
// number.
template <typename Fault>
void refuse_any(std::size_t count, const char* what, nook_result code, Fault fault) {
  std::size_t first = 0;
  std::size_t faults = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (fault(i) && faults++ == 0) first = i;
  if (faults > 0) throw Failure(code, "%s: %zu of %zu, the first has index %zu", what, faults, count, first);
}

bool is_orthonormal(const Mat3x4& a) {
  for (const float v : a.m)
    if (!std::isfinite(v)) return false;
  const Vec3 x{a.m[0], a.m[4], a.m[8]};
  const Vec3 y{a.m[1], a.m[5], a.m[9]};
  const Vec3 z{a.m[2], a.m[6], a.m[10]};
  const Vec3 c = cross(x, y);
  const float tolerance = 1e-3f;
  return std::abs(dot(x, x) - 1) < tolerance && std::abs(dot(y, y) - 1) < tolerance &&
         std::abs(dot(x, y)) < tolerance && length(c - z) < tolerance;
}

void validate_bones(const std::vector<Bone>& bones, nook_result code) {
  if (bones.empty()) throw Failure(code, "no bones (need 1 to %zu)", max_bone_count);
  if (bones.size() > max_bone_count)
    throw Failure(code, "too many bones (got %zu, need at most %zu)", bones.size(), max_bone_count);
  for (std::size_t i = 0; i < bones.size(); ++i) {
    if (bones[i].parent < -1 || bones[i].parent >= static_cast<std::int64_t>(i))
      throw Failure(
          code, "bone %zu (\"%s\") has parent %d (need -1 or a smaller index); sort parents before children",
          i, bones[i].name.c_str(), bones[i].parent);
    if (bones[i].name.find('\0') != std::string::npos)
      throw Failure(code, "the name of bone %zu (\"%s...\") holds a NUL character; rename it", i,
                    bones[i].name.c_str());
    const float* m = bones[i].frame_rest.m;
    if (!is_place({m[3], m[7], m[11]}))
      throw Failure(
          code, "the joint of bone %zu (\"%s\") is out of range (got %g %g %g, need finite metres up to 1e6)",
          i, bones[i].name.c_str(), double(m[3]), double(m[7]), double(m[11]));
    if (!is_orthonormal(bones[i].frame_rest))
      throw Failure(code,
                    "bone %zu (\"%s\") has a rest frame that is not finite, orthonormal and right-handed", i,
                    bones[i].name.c_str());
  }
}

void validate_vertices(const std::vector<Vec3>& position, const std::vector<SkinWeights>& weights,
                       std::size_t bone_count, nook_result code) {
  if (position.size() > max_file_vertices)
    throw Failure(code, "too many vertices (got %zu, need at most %zu)", position.size(), max_file_vertices);
  if (weights.size() != position.size())
    throw Failure(code, "%zu skinning weights for %zu vertices (need the same number)", weights.size(),
                  position.size());
  refuse_any(position.size(), "vertices with a position that is not finite or beyond 1e6 m", code,
             [&](std::size_t v) { return !is_place(position[v]); });
  refuse_any(weights.size(), "vertices with weights that are not finite or negative", code,
             [&](std::size_t v) {
               for (const float w : weights[v].weight)
                 if (!(std::isfinite(w) && w >= 0)) return true;
               return false;
             });
  refuse_any(weights.size(), "vertices whose weights are all zero", code, [&](std::size_t v) {
    for (const float w : weights[v].weight)
      if (w > 0) return false;
    return true;
  });
  refuse_any(weights.size(), "vertices with a bone index out of range", code, [&](std::size_t v) {
    for (const std::uint16_t b : weights[v].bone)
      if (b >= bone_count) return true;
    return false;
  });
  refuse_any(weights.size(), "vertices whose weights are not in falling order with sum 1", code,
             [&](std::size_t v) {
               float sum = weights[v].weight[0];
               for (int k = 1; k < SkinWeights::max_bones; ++k) {
                 if (weights[v].weight[k] > weights[v].weight[k - 1]) return true;
                 sum += weights[v].weight[k];
               }
               return std::abs(sum - 1) > 1e-4f;
             });
}

void validate_triangles(const std::vector<std::array<std::uint32_t, 3>>& triangle, std::size_t vertices,
                        nook_result code) {
  if (triangle.empty()) throw Failure(code, "no triangles (need at least one)");
  refuse_any(triangle.size(), "triangles with a vertex index out of range", code, [&](std::size_t t) {
    return triangle[t][0] >= vertices || triangle[t][1] >= vertices || triangle[t][2] >= vertices;
  });
}

void validate_primitives(const std::vector<Primitive>& primitives, std::size_t file_vertices,
                         nook_result code) {
  std::size_t next = 0;
  for (std::size_t p = 0; p < primitives.size(); ++p) {
    if (primitives[p].first_vertex != next)
      throw Failure(
          code,
          "primitive %zu starts at vertex %u (need %zu, because primitives follow each other without gaps)",
          p, primitives[p].first_vertex, next);
    next += primitives[p].vertex_count;
  }
  if (next != file_vertices)
    throw Failure(code, "the primitives have %zu vertices in all, but the mesh has %zu", next, file_vertices);
}

}  // namespace

void validate(const FileMesh& mesh, nook_result code) {
  validate_bones(mesh.bones, code);
  validate_triangles(mesh.triangle, mesh.position.size(), code);
  validate_vertices(mesh.position, mesh.weights, mesh.bones.size(), code);
  validate_primitives(mesh.primitives, mesh.position.size(), code);
}

void validate(const SkinnedMesh& mesh, nook_result code) {
  validate_bones(mesh.bones, code);
  validate_triangles(mesh.triangle, mesh.position.size(), code);
  validate_vertices(mesh.position, mesh.weights, mesh.bones.size(), code);
  validate_primitives(mesh.primitives, mesh.file_to_welded.size(), code);
  refuse_any(mesh.file_to_welded.size(), "file vertices that map to no welded vertex", code,
             [&](std::size_t v) { return mesh.file_to_welded[v] >= mesh.position.size(); });
}

}  // namespace nook::bake
