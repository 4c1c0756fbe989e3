#include "bakers/character/torn_edges.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace nook::bake {
namespace {

float diagonal(std::span<const Vec3> points) {
  if (points.empty()) return 0;
  Vec3 low = points[0], high = low;
  for (const Vec3 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return length(high - low);
}

}  // namespace

std::vector<MeshEdge> mesh_edges(const SkinnedMesh& mesh) {
  std::vector<MeshEdge> edges;
  edges.reserve(mesh.triangle.size() * 3);
  for (const auto& t : mesh.triangle)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::size_t count_torn(const SkinnedMesh& mesh, std::span<const MeshEdge> edges,
                       std::span<const Vec3> posed) {
  const float growth = torn_growth * diagonal(mesh.position);
  return std::size_t(std::count_if(edges.begin(), edges.end(), [&](const MeshEdge& e) {
    const float rest = length(mesh.position[e[0]] - mesh.position[e[1]]);
    const float now = length(posed[e[0]] - posed[e[1]]);
    return now > torn_stretch * rest && now > rest + growth;
  }));
}

double torn_share(const SkinnedMesh& mesh, std::span<const Pose> poses) {
  const std::vector<MeshEdge> edges = mesh_edges(mesh);
  if (edges.empty() || poses.empty()) return 0;
  std::vector<std::size_t> torn(poses.size(), 0);
  tbb::parallel_for(std::size_t(0), poses.size(), [&](std::size_t p) {
    std::vector<Vec3> posed;
    skin_positions(mesh, poses[p], posed);
    torn[p] = count_torn(mesh, edges, posed);
  });
  return double(std::accumulate(torn.begin(), torn.end(), std::size_t(0))) /
         (double(edges.size()) * double(poses.size()));
}

}  // namespace nook::bake
