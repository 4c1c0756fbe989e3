#include "sdk/src/transfer/lit_rows.h"

#include <algorithm>

#include "sdk/src/core/floats.h"
#include "sdk/src/transfer/reflected_light.h"

namespace nook::transfer {

std::size_t lit_row_count(const Transfer& transfer) {
  return std::size_t(transfer.paper.clusters) * transfer.paper.vertex_rank + transfer.bounces * band_count;
}

void write_lit_rows(const Response& response, std::span<const float> amplitudes, const Transfer& transfer,
                    const Parallel& parallel, Memory* memory, std::span<float> rows) {
  const PaperTransfer& paper = transfer.paper;
  const std::size_t size = std::size_t(3) * paper.light_modes, rank = paper.vertex_rank;
  const Vector<float> lit = paper_light(paper, amplitudes, parallel, memory);
  for (std::size_t cluster = 0; cluster < paper.clusters; ++cluster)
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t q = 0; q < rank; ++q)
        rows[(cluster * rank + q) * size + i] = lit[(cluster * size + i) * rank + q];
  const ReflectedBands reflected = reflected_light(response, amplitudes, transfer.bounces, memory);
  float* row = &rows[paper.clusters * rank * size];
  for (std::uint32_t k = 0; k < transfer.bounces * band_count; ++k) {
    const float channel[3] = {reflected[k].x, reflected[k].y, reflected[k].z};
    for (const float light : channel)
      for (std::uint32_t a = 0; a < paper.light_modes; ++a, ++row)
        *row = light * response.even[std::size_t(row - rows.data()) % size];
  }
}

std::size_t vertex_number_count(const Transfer& transfer) {
  return (1 + transfer.paper.vertex_rank + transfer.bounces * band_count + 3) / 4 * 4;
}

void write_vertex_numbers(const Transfer& transfer, std::size_t vertex, float* numbers) {
  const PaperTransfer& paper = transfer.paper;
  float* const end = numbers + vertex_number_count(transfer);
  *numbers++ = float(paper.cluster[vertex]);
  for (std::size_t q = 0; q < paper.vertex_rank; ++q)
    *numbers++ = from_half(paper.coefficients[vertex * paper.vertex_rank + q]);
  const std::size_t bands = transfer.bounces * band_count;
  for (std::size_t k = 0; k < bands; ++k) *numbers++ = from_half(transfer.indirect[vertex * bands + k]);
  std::fill(numbers, end, 0.0f);
}

}  // namespace nook::transfer
