// GLSL through the reference compiler.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bakers/lab/gpu_cost/source_text.h"

namespace nook::lab {

// Resolves macros, conditions and comments of a text with a version line.
std::string preprocess(Stage stage, const std::string& text);

// Compiles Vulkan GLSL. what names the shader in messages.
std::vector<std::uint32_t> compile_spirv(Stage stage, const std::string& text, const std::string& what);

}  // namespace nook::lab
