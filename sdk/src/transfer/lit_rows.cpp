#include "sdk/src/transfer/lit_rows.h"

#include <algorithm>
#include <numbers>

#include "sdk/src/core/floats.h"

namespace nook::transfer {

ReflectedBands reflected_light(const Response& response, std::span<const float> amplitudes,
                               std::uint32_t bounces, Memory* memory) {
  ReflectedBands out{};
  if (bounces == 0) return out;
  Vector<Vec3> axes(response.lobes, Vec3{}, memory);
  lobe_axes(axes);
  const auto light = bands_of_lobes(axes, sharpness_of(response.lobes), amplitudes);
  const Vec3 share = response.reflectance;
  Vec3 reflected = share * (1 / std::numbers::pi_v<float>);
  for (std::uint32_t b = 0; b < bounces; ++b) {
    for (std::uint32_t k = 0; k < band_count; ++k)
      out[b * band_count + k] = {light[k].x * reflected.x, light[k].y * reflected.y,
                                 light[k].z * reflected.z};
    reflected = {reflected.x * share.x, reflected.y * share.y, reflected.z * share.z};
  }
  return out;
}

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
