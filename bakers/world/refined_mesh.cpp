#include "bakers/world/refined_mesh.h"

#include <algorithm>

namespace nook::bake {
namespace {

// Meshes that would exceed this keep some longer edges.
constexpr std::size_t most_vertices = 40000;

float diagonal_of(const std::vector<Vec3>& position) {
  if (position.empty()) return 0;
  Vec3 low = position[0], high = position[0];
  for (const Vec3 p : position) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return length(high - low);
}

}  // namespace

SkinnedMesh refined(const SkinnedMesh& mesh) {
  SkinnedMesh out;
  out.bones = mesh.bones;
  out.position = mesh.position;
  out.weights = mesh.weights;
  const float longest = diagonal_of(mesh.position) / 40;
  std::vector<std::array<std::uint32_t, 3>> left = mesh.triangle;
  while (!left.empty()) {
    const std::array<std::uint32_t, 3> t = left.back();
    left.pop_back();
    std::size_t edge = 0;
    float size = -1;
    for (std::size_t i = 0; i < 3; ++i) {
      const float own = length(out.position[t[(i + 1) % 3]] - out.position[t[i]]);
      if (own > size) {
        size = own;
        edge = i;
      }
    }
    // Also where a position is not finite.
    if (!(size > longest) || out.position.size() >= most_vertices) {
      out.triangle.push_back(t);
      continue;
    }
    const std::uint32_t a = t[edge], b = t[(edge + 1) % 3], c = t[(edge + 2) % 3];
    const auto middle = static_cast<std::uint32_t>(out.position.size());
    out.position.push_back(0.5f * (out.position[a] + out.position[b]));
    out.weights.push_back(out.weights[a]);
    left.push_back({a, middle, c});
    left.push_back({middle, b, c});
  }
  return out;
}

}  // namespace nook::bake
