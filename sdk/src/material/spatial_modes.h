// The spatial modes of the core tensors, expanded: with a, b < R_l, R_v
//   S_c[a, b](x, y) = sum_{p, q} Z_c[a, b, p, q] X_c[x, p] Y_c[y, q],
// images that texture units filter. Decoding is linear in them, so the mean of a footprint's texels decodes
// to the mean of what the texels decode to.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "sdk/src/material/material.h"

namespace nook::material {

// Of one cluster.
class ModeExpansion {
 public:
  ModeExpansion(const ClusteredTensor& tensor, std::uint32_t cluster, std::pmr::memory_resource* memory);

  // Floats that expand needs as scratch memory.
  std::size_t scratch_size() const;
  // S_c[a, b] into image, width x height, row by row. Any number of threads at a time.
  void expand(std::uint32_t a, std::uint32_t b, std::span<float> scratch, std::span<float> image) const;
  // No texel of any mode of the cluster is larger: |S| <= |X_x| |Z_ab| |Y_y|.
  float bound() const;

 private:
  const float* core(std::uint32_t a, std::uint32_t b) const;

  const ClusteredTensor& tensor_;
  std::uint32_t cluster_;
  std::pmr::vector<float> x_rows_, y_rows_;  // transposed bases, R_x x I_x and R_y x I_y; empty at full rank
};

// Mipmap levels as OpenGL counts them: half the size, rounded down, to 1 x 1.
std::uint32_t level_size(std::uint32_t size, std::uint32_t level);
std::uint32_t level_count(std::uint32_t width, std::uint32_t height);
// The next smaller level: every texel the mean over its area, fractions of texels included, so that the mean
// of the image stays.
void halve(std::span<const float> image, std::uint32_t width, std::uint32_t height, std::span<float> smaller);

}  // namespace nook::material
