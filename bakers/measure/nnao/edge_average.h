// One pass of XeGTAO's edge-aware denoiser over vectors, on the CPU, with the weights of
// shaders/denoise.glsl.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/vec.h"

namespace nook::measure {

// vectors: row by row. packed_edges: those of shaders/edges.glsl, in [0, 1]. last: whether no pass follows,
// which gives the pixel itself more weight. Results have unit length, or are zero.
std::vector<Vec3> edge_average(std::span<const Vec3> vectors, std::span<const float> packed_edges,
                               std::uint32_t width, bool last);

}  // namespace nook::measure
