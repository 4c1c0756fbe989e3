#include "bakers/measure/nnao/edge_average.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nook::measure {
namespace {

// Left, right, below, above.
using Edges = std::array<float, 4>;

Edges unpacked(float packed) {
  const auto bits = std::uint32_t(packed * 255 + 0.5f);
  return {float(bits >> 6 & 3) / 3, float(bits >> 4 & 3) / 3, float(bits >> 2 & 3) / 3, float(bits & 3) / 3};
}

// The image with the nearest pixel beyond its border.
struct Clamped {
  std::span<const Vec3> vectors;
  std::span<const float> edges;
  int width, height;

  std::size_t at(int x, int y) const {
    return std::size_t(std::clamp(y, 0, height - 1)) * std::size_t(width) +
           std::size_t(std::clamp(x, 0, width - 1));
  }
  Vec3 vector(int x, int y) const { return vectors[at(x, y)]; }
  Edges edges_at(int x, int y) const { return unpacked(edges[at(x, y)]); }
};

Vec3 averaged(const Clamped& image, int x, int y, float own_weight) {
  const Edges centre = image.edges_at(x, y), left = image.edges_at(x - 1, y),
              right = image.edges_at(x + 1, y), below = image.edges_at(x, y - 1),
              above = image.edges_at(x, y + 1);
  std::array<float, 4> near{centre[0] * left[1], centre[1] * right[0], centre[2] * below[3],
                            centre[3] * above[2]};
  const float connected = near[0] + near[1] + near[2] + near[3];
  const float leak = 0.5f * std::clamp((1.5f - connected) / 1.5f, 0.0f, 1.0f);
  for (float& weight : near) weight = std::min(weight + leak, 1.0f);
  const std::array<float, 4> diagonal{
      0.425f * (near[0] * left[2] + near[2] * below[0]), 0.425f * (near[1] * right[2] + near[2] * below[1]),
      0.425f * (near[0] * left[3] + near[3] * above[0]), 0.425f * (near[1] * right[3] + near[3] * above[1])};
  return own_weight * image.vector(x, y) + near[0] * image.vector(x - 1, y) +
         near[1] * image.vector(x + 1, y) + near[2] * image.vector(x, y - 1) +
         near[3] * image.vector(x, y + 1) + diagonal[0] * image.vector(x - 1, y - 1) +
         diagonal[1] * image.vector(x + 1, y - 1) + diagonal[2] * image.vector(x - 1, y + 1) +
         diagonal[3] * image.vector(x + 1, y + 1);
}

}  // namespace

std::vector<Vec3> edge_average(std::span<const Vec3> vectors, std::span<const float> packed_edges,
                               std::uint32_t width, bool last) {
  const Clamped image{vectors, packed_edges, int(width), int(vectors.size() / width)};
  const float own_weight = last ? 1.2f : 1.2f / 5;
  std::vector<Vec3> result(vectors.size());
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      result[image.at(x, y)] = normalised(averaged(image, x, y, own_weight));
  return result;
}

}  // namespace nook::measure
