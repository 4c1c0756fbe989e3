// Baked radiance transfer in the paper's form, as plain data. Each vertex has a matrix that maps lobes to the
// light modes of one material. The matrices are compressed by CTA (Y.-T. Tsai, Z.-C. Shih: K-Clustered Tensor
// Approximation, 2012, section 6.3.4). A vertex p of cluster g has the matrix
//   T_p[j, i] = sum over k < lobe_rank and q < vertex_rank of U_g[j, k] Z_g[i, q, k] u_p[q],
// with i = channel * light_modes + mode, and the vector r_p[c, a] = sum_j l_j[c] T_p[j, c light_modes + a].
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/parallel.h"

namespace nook::transfer {

inline constexpr std::uint32_t max_clusters = 256, max_lobe_rank = 256, max_vertex_rank = 64;
// The maximum number of light modes of one channel. The number must be a multiple of 4.
inline constexpr std::uint32_t max_light_modes = 1024;

// The maximum scale of cores. With this limit, and with bases and coefficients of magnitude 1 at most,
// vectors stay finite for amplitudes up to 1e22.
inline constexpr float max_core_scale = 1000;

struct PaperTransfer {
  explicit PaperTransfer(Memory* memory = default_memory())
      : lobe_basis(memory), cores(memory), cluster(memory), coefficients(memory) {}

  std::uint32_t light_modes = 0;  // number of light modes of one channel; 0: the transfer does not have the
                                  // paper's form
  std::uint32_t clusters = 0, lobe_rank = 0, vertex_rank = 0;
  std::uint64_t light_hash = 0;  // MaterialTables::light_hash of the material
  float scale = 1;               // scale of the cores

  // Half floats; bases and coefficients are between -1 and 1.
  Vector<std::uint16_t> lobe_basis;  // clusters x lobes x lobe_rank
  Vector<std::uint16_t> cores;       // clusters x 3 light_modes x vertex_rank x lobe_rank, in units of scale
  Vector<std::uint8_t> cluster;      // cluster of each vertex
  Vector<std::uint16_t> coefficients;  // vertices x vertex_rank

  bool is_used() const { return light_modes > 0; }
};

// Returns the size of the four arrays in bytes, counted as in Table II of the paper: two bytes for each half
// float, and one byte for each vertex's cluster.
constexpr std::uint64_t paper_bytes(std::uint64_t vertices, std::uint64_t clusters, std::uint64_t lobes,
                                    std::uint64_t light_modes, std::uint64_t lobe_rank,
                                    std::uint64_t vertex_rank) {
  return clusters * (lobe_rank * lobes + lobe_rank * 3 * light_modes * vertex_rank) * 2 +
         vertices * (2 * vertex_rank + 1);
}

// Applies a light to the matrices of all clusters. The result has 3 light_modes x vertex_rank values for each
// cluster. `amplitudes` has an RGB value for each lobe.
Vector<float> paper_light(const PaperTransfer& paper, std::span<const float> amplitudes,
                          const Parallel& parallel, Memory* memory);
// Writes the vector of a vertex, which has 3 light_modes values. `lit` is the result of paper_light.
void paper_vector(const PaperTransfer& paper, std::span<const float> lit, std::size_t vertex,
                  float* vector) noexcept;

}  // namespace nook::transfer
