#include "samples/mannequin/triangle_mesh.h"

namespace nook_samples::mannequin {

std::vector<Vec3> area_weighted_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.positions_m.size(), Vec3(0.0));
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.positions_m[t[0]];
    const Vec3 twice_area = glm::cross(mesh.positions_m[t[1]] - a, mesh.positions_m[t[2]] - a);
    for (std::uint32_t v : t) {
      normals[v] += twice_area;
    }
  }
  for (Vec3& n : normals) {
    n = glm::normalize(n);
  }
  return normals;
}

std::vector<std::vector<std::uint32_t>> vertex_neighbours(const TriangleMesh& mesh) {
  // On a closed mesh every edge is some triangle's outgoing edge at each of its ends, so one direction is
  // enough.
  std::vector<std::vector<std::uint32_t>> neighbours(mesh.positions_m.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      neighbours[t[k]].push_back(t[(k + 1) % 3]);
    }
  }
  return neighbours;
}

}  // namespace nook_samples::mannequin
