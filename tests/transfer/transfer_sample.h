// Baked transfer of made numbers, for tests of what reads it.
#pragma once

#include <cstdint>

#include "sdk/src/core/floats.h"
#include "sdk/src/transfer/transfer.h"

namespace nook::transfer::test {

// Shares are dark, open and partly open in turn; normals lie on a spiral.
inline Transfer sample_transfer(std::uint32_t vertices = 5, std::uint32_t lobes = 19,
                                std::uint32_t bounces = 0, std::uint64_t votf_hash = 0) {
  Transfer transfer;
  transfer.lobes = lobes;
  transfer.hashes = {11, 22, 33, 44};
  std::uint32_t state = 7;
  for (std::uint32_t i = 0; i < vertices * lobes; ++i) {
    state = state * 1664525u + 1013904223u;
    const std::uint32_t kind = state >> 30;
    transfer.shares.push_back(kind == 0   ? std::uint8_t(0)
                              : kind == 1 ? std::uint8_t(255)
                                          : std::uint8_t(state >> 16));
  }
  std::vector<Vec3> axes(vertices + 2);
  lobe_axes(axes);
  for (std::uint32_t v = 0; v < vertices; ++v)
    transfer.frames.push_back(
        pack(orthonormal_frame(axes[v + 1], {0.3f, 1, 0.2f}, v % 3 == 0 ? -1.0f : 1.0f)));
  transfer.bounces = bounces;
  for (std::uint32_t i = 0; i < vertices * bounces * band_count; ++i)
    transfer.indirect.push_back(to_half(0.125f * float(i % 7) - 0.25f));
  transfer.votf_hash = votf_hash;
  transfer.recipe = "{\"form\":\"separated\"}";
  return transfer;
}

// The same in the paper's form, of small random numbers.
inline Transfer sample_paper(std::uint32_t vertices = 7, std::uint32_t lobes = 19,
                             std::uint32_t light_modes = 8, std::uint64_t light_hash = 5,
                             std::uint32_t bounces = 0) {
  Transfer transfer = sample_transfer(vertices, lobes, bounces);
  transfer.shares.clear();
  transfer.frames.clear();
  PaperTransfer& paper = transfer.paper;
  paper.light_modes = light_modes;
  paper.clusters = 3;
  paper.lobe_rank = 5;
  paper.vertex_rank = 4;
  paper.light_hash = light_hash;
  paper.scale = 0.25f;
  std::uint32_t state = 9;
  const auto fill = [&](Vector<std::uint16_t>& halves, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      state = state * 1664525u + 1013904223u;
      halves.push_back(to_half(float(state >> 16) / 32768 - 1));
    }
  };
  fill(paper.lobe_basis, std::size_t(3) * lobes * 5);
  fill(paper.cores, std::size_t(3) * 3 * light_modes * 4 * 5);
  fill(paper.coefficients, std::size_t(vertices) * 4);
  for (std::uint32_t v = 0; v < vertices; ++v) paper.cluster.push_back(std::uint8_t(v * 2 % 3));
  return transfer;
}

}  // namespace nook::transfer::test
