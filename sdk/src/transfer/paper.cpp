#include "sdk/src/transfer/paper.h"

#include <algorithm>
#include <array>

#include "sdk/src/core/floats.h"

namespace nook::transfer {
namespace {

// Sums are split into this many partial sums, so that compilers can vectorise them.
constexpr std::size_t parts = 8;

// A row of half floats that is converted to floats and padded with zeros to a multiple of `parts`.
struct alignas(32) FloatRow {
  std::array<float, max_lobe_rank> at{};
};
static_assert(max_lobe_rank % parts == 0);

// Converts a finite half float without branches.
inline float from_finite_half(std::uint16_t half) {
  const std::uint32_t magnitude = half & 0x7fffu;
  const float normal = bit_cast<float>((magnitude << 13) + (112u << 23));
  const float small = float(std::int32_t(magnitude)) * 0x1p-24f;
  const float value = magnitude >= 0x400u ? normal : small;
  return bit_cast<float>(bit_cast<std::uint32_t>(value) | std::uint32_t(half & 0x8000u) << 16);
}

void to_floats(const std::uint16_t* halves, std::size_t count, FloatRow& row) {
  for (std::size_t k = 0; k < count; ++k) row.at[k] = from_finite_half(halves[k]);
}

float dot_of(const FloatRow& a, const FloatRow& b, std::size_t padded) {
  std::array<float, parts> sums{};
  for (std::size_t k = 0; k < padded; k += parts)
    for (std::size_t i = 0; i < parts; ++i) sums[i] += a.at[k + i] * b.at[k + i];
  return ((sums[0] + sums[4]) + (sums[1] + sums[5])) + ((sums[2] + sums[6]) + (sums[3] + sums[7]));
}

}  // namespace

Vector<float> paper_light(const PaperTransfer& paper, std::span<const float> amplitudes,
                          const Parallel& parallel, Memory* memory) {
  const std::size_t rank = paper.lobe_rank, padded = (rank + parts - 1) / parts * parts;
  const std::size_t lobes = amplitudes.size() / 3, modes = paper.light_modes;
  const std::size_t entries = 3 * modes * paper.vertex_rank;
  Vector<float> lit(paper.clusters * entries, 0.0f, memory);
  const auto body = [&](std::uint32_t cluster) noexcept {
    // The amplitudes of the light, multiplied by the cluster's lobe basis.
    std::array<FloatRow, 3> light;
    FloatRow row;
    const std::uint16_t* basis = &paper.lobe_basis[cluster * lobes * rank];
    for (std::size_t j = 0; j < lobes; ++j, basis += rank) {
      to_floats(basis, rank, row);
      for (std::size_t c = 0; c < 3; ++c) {
        const float amplitude = amplitudes[3 * j + c];
        for (std::size_t k = 0; k < padded; ++k) light[c].at[k] += row.at[k] * amplitude;
      }
    }
    const std::uint16_t* core = &paper.cores[cluster * entries * rank];
    float* const out = &lit[cluster * entries];
    for (std::size_t i = 0; i < entries; ++i, core += rank) {
      to_floats(core, rank, row);
      out[i] = dot_of(row, light[i / (modes * paper.vertex_rank)], padded) * paper.scale;
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
