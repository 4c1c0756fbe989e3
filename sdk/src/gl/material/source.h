// The GLSL of a material: constants and samplers for its sizes, then shaders/material/host.glsl, or that of
// neural ones.
#pragma once

#include <string>

#include "sdk/src/core/containers.h"
#include "sdk/src/material/tables.h"

namespace nook::gl {

// max_layers is the maximum for one texture array.
inline std::uint32_t array_count(const material::TensorTables& tables, std::uint32_t max_layers) {
  return (tables.layers() + max_layers - 1) / max_layers;
}

String material_source(const material::MaterialTables& tables, std::uint32_t max_layers, Memory* memory);

}  // namespace nook::gl
