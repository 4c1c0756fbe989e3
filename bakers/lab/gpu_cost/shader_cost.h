// Estimates the cost of shaders on a GPU that this machine does not have.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bakers/lab/gpu_cost/instruction_count.h"
#include "bakers/lab/gpu_cost/null_device.h"
#include "bakers/lab/gpu_cost/shader_cases.h"

namespace nook::lab {

// The cost model counts the cycles of a compute unit with 64 lanes that executes a wave of 64 threads.
inline constexpr double quarter_rate_cycles = 4, fetch_cycles = 16;

struct Cycles {
  double alu = 0, texture = 0;
  double all() const { return alu + texture; }
};

struct ShaderCost {
  std::string shader;
  InstructionCounts counts;
  unsigned vector_registers = 0, scalar_registers = 0, waves = 0, code_bytes = 0;
  std::string error;  // why the shader could not be counted; empty if it was

  Cycles cycles() const {
    return {counts[InstructionClass::vector] + quarter_rate_cycles * counts[InstructionClass::quarter_rate],
            fetch_cycles * counts[InstructionClass::fetch]};
  }
};

struct SourceTree {
  std::filesystem::path root;
  std::string first_lines;  // inserted before the defines of each shader
};

// Returns a shader as Vulkan GLSL.
VulkanGlsl vulkan_glsl(const SourceTree& tree, const ShaderCase& shader);

// Compiles and disassembles a shader.
CompiledShader compile_shader(NullDevice& device, const SourceTree& tree, const ShaderCase& shader);

// If a shader cannot be counted, this does not throw. Instead, the `error` of the result is set.
ShaderCost shader_cost(NullDevice& device, const std::string& family, const SourceTree& tree,
                       const ShaderCase& shader);

}  // namespace nook::lab
