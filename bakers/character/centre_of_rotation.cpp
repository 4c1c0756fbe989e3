#include <tbb/parallel_for.h>

#include <cmath>

#include "bakers/character/initialise.h"

namespace nook::bake {

std::vector<Vec3> centre_of_rotation_normals(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                             std::span<const Vec3> mesh_normal) {
  const std::size_t vertices = mesh.vertex_count();
  std::vector<float> squared(vertices);
  for (std::size_t i = 0; i < vertices; ++i)
    for (float w : mesh.weights[i].weight) squared[i] += w * w;
  // Width of the Gaussian on the distance of weight vectors, whose largest value is sqrt(2).
  constexpr float inverse_width2 = 1 / 0.1f;
  std::vector<Vec3> normal(vertices);
  constexpr std::size_t block = 64;
  tbb::parallel_for(std::size_t(0), (vertices + block - 1) / block, [&](std::size_t b) {
    std::vector<float> dense(mesh.bones.size(), 0.0f);
    for (std::size_t i = b * block; i < std::min(vertices, (b + 1) * block); ++i) {
      const SkinWeights& own = mesh.weights[i];
      for (int s = 0; s < SkinWeights::max_bones; ++s) dense[own.bone[s]] += own.weight[s];
      Vec3 sum;
      float total = 0;
      for (std::size_t j = 0; j < vertices; ++j) {
        float shared = 0;
        for (int s = 0; s < SkinWeights::max_bones && mesh.weights[j].weight[s] > 0; ++s)
          shared += dense[mesh.weights[j].bone[s]] * mesh.weights[j].weight[s];
        if (shared == 0) continue;  // no common bone: the Gaussian is nothing there
        const float distance2 = std::max(0.0f, squared[i] + squared[j] - 2 * shared);
        const float similarity = vertex_area[j] * std::exp(-distance2 * inverse_width2);
        sum += similarity * mesh.position[j];
        total += similarity;
      }
      for (int s = 0; s < SkinWeights::max_bones; ++s) dense[own.bone[s]] = 0;
      const Vec3 n = total > 0 ? normalised(mesh.position[i] - sum * (1 / total)) : Vec3{};
      normal[i] = dot(n, n) > 0 ? n : mesh_normal[i];
    }
  });
  return normal;
}

}  // namespace nook::bake
