#include "sdk/src/transfer/paper.h"

#include <algorithm>
#include <array>

#include "sdk/src/core/half.h"

namespace nook::transfer {

Vector<float> paper_light(const PaperTransfer& paper, std::span<const float> amplitudes,
                          const Parallel& parallel, Memory* memory) {
  const std::size_t rank = paper.lobe_rank, lobes = amplitudes.size() / 3;
  const std::size_t modes = paper.light_modes, entries = 3 * modes * paper.vertex_rank;
  Vector<float> lit(paper.clusters * entries, 0.0f, memory);
  const auto body = [&](std::uint32_t cluster) noexcept {
    // The light in the cluster's lobe basis.
    std::array<std::array<float, max_lobe_rank>, 3> light{};
    const std::uint16_t* basis = &paper.lobe_basis[cluster * lobes * rank];
    for (std::size_t j = 0; j < lobes; ++j, basis += rank)
      for (std::size_t k = 0; k < rank; ++k) {
        const float value = from_half(basis[k]);
        for (std::size_t c = 0; c < 3; ++c) light[c][k] += value * amplitudes[3 * j + c];
      }
    const std::uint16_t* core = &paper.cores[cluster * entries * rank];
    float* const out = &lit[cluster * entries];
    for (std::size_t i = 0; i < entries; ++i, core += rank) {
      const float* const channel = light[i / (modes * paper.vertex_rank)].data();
      float sum = 0;
      for (std::size_t k = 0; k < rank; ++k) sum += from_half(core[k]) * channel[k];
      out[i] = sum * paper.scale;
    }
  };
  parallel_for(parallel, paper.clusters, body);
  return lit;
}

void paper_vector(const PaperTransfer& paper, std::span<const float> lit, std::size_t vertex,
                  float* vector) noexcept {
  const std::size_t rank = paper.vertex_rank, numbers = 3 * std::size_t(paper.light_modes);
  const std::uint16_t* const halves = &paper.coefficients[vertex * rank];
  std::array<float, max_vertex_rank> coefficient;
  for (std::size_t q = 0; q < rank; ++q) coefficient[q] = from_half(halves[q]);
  const float* row = &lit[paper.cluster[vertex] * numbers * rank];
  for (std::size_t i = 0; i < numbers; ++i, row += rank) {
    float sum = 0;
    for (std::size_t q = 0; q < rank; ++q) sum += row[q] * coefficient[q];
    vector[i] = sum;
  }
}

}  // namespace nook::transfer
