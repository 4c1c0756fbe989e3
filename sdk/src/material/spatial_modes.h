// The expanded spatial modes of the core tensors. With a < R_l and b < R_v,
//   S_c[a, b](x, y) = sum_{p, q} Z_c[a, b, p, q] X_c[x, p] Y_c[y, q]
// are images that texture units can filter. Decoding is linear in these images. So if filtered texels are
// decoded, the result is the mean of the decoded texels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/containers.h"
#include "sdk/src/material/material.h"

namespace nook::material {

// Expands the modes of one cluster.
class ModeExpansion {
 public:
  ModeExpansion(const ClusteredTensor& tensor, std::uint32_t cluster, Memory* memory);

  // Returns the number of floats that expand needs as scratch memory.
  std::size_t scratch_size() const;
  // Writes S_c[a, b] to `image`, width x height values, row by row. Several threads may call it at the same
  // time.
  void expand(std::uint32_t a, std::uint32_t b, std::span<float> scratch, std::span<float> image) const;
  // Returns an upper bound of the magnitude of all texels in all modes of the cluster: |S| <= |X_x| |Z_ab|
  // |Y_y|.
  float bound() const;

 private:
  const float* core(std::uint32_t a, std::uint32_t b) const;

  const ClusteredTensor& tensor_;
  std::uint32_t cluster_;
  Vector<float> x_rows_, y_rows_;  // transposed bases, R_x x I_x and R_y x I_y; empty at full rank
};

// Returns the size of a mipmap level along one axis. As in OpenGL, each level has half the size of the
// previous one, rounded down, but at least 1.
std::uint32_t level_size(std::uint32_t size, std::uint32_t level);
std::uint32_t level_count(std::uint32_t width, std::uint32_t height);
// Computes the next smaller level. Every texel is the mean over its area, including fractions of larger
// texels, so that the mean of the whole image does not change.
void halve(std::span<const float> image, std::uint32_t width, std::uint32_t height, std::span<float> smaller);

}  // namespace nook::material
