#include "bakers/import/skinning.h"

#include <algorithm>

#include "sdk/src/core/failure.h"

namespace nook::bake {

void skin_positions(const SkinnedMesh& mesh, const Pose& pose, std::vector<Vec3>& out_ws) {
  if (pose.size() != mesh.bones.size())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "wrong number of bone matrices (got %zu, need %zu)",
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
  // A sum that is only the rounding left by faces that cancel out has no direction of its own.
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
        // Equation 7 of the paper: 1/8 of each edge's square times the cotangent opposite; cot = dot /
        // |cross|.
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        area[t[i]] += (opposite[j] * at_corner[j] + opposite[k] * at_corner[k]) / (8 * twice);
      }
    }
  }
  return {area.begin(), area.end()};
}

}  // namespace nook::bake
