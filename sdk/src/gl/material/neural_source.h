// The declarations of a neural material: sizes, weights as constants, and the sampler of its features. They
// stand before shaders/material/neural/host.glsl.
#pragma once

#include "sdk/src/core/containers.h"
#include "sdk/src/material/neural_tables.h"

namespace nook::gl {

void add_neural_declarations(const material::NeuralTables& tables, String& out);

}  // namespace nook::gl
