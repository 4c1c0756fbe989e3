// Generates the GLSL of a material: constants and samplers that depend on its sizes, followed by
// shaders/material/host.glsl, or by neural/host.glsl for a neural material.
#pragma once

#include <cstdint>

#include "sdk/src/core/containers.h"
#include "sdk/src/material/tables.h"

namespace nook::gl {

// Returns the number of texture arrays that the spatial modes need. max_layers is the maximum number of
// layers in one array. If a mode is stored in blocks, both of its layers must be in the same array.
inline std::uint32_t array_count(const material::TensorTables& tables, std::uint32_t max_layers) {
  return (tables.layers() + max_layers - 1) / max_layers;
}
constexpr std::uint32_t most_block_layers(std::uint32_t max_layers) {
  return max_layers < 2 ? 2 : max_layers / 2 * 2;
}
inline std::uint32_t block_array_count(const material::TensorTables& tables, std::uint32_t max_layers) {
  const std::uint32_t most = most_block_layers(max_layers);
  return (tables.block_size().layers + most - 1) / most;
}

String material_source(const material::MaterialTables& tables, std::uint32_t max_layers, Memory* memory);

}  // namespace nook::gl
