// Compiles shaders for a GPU that this machine does not have. RADV, Mesa's Vulkan driver for AMD, can compile
// for such a GPU and return the disassembly.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "bakers/lab/gpu_cost/vulkan_glsl.h"

namespace nook::lab {

struct CompiledShader {
  std::string disassembly;
  unsigned vector_registers = 0;
  unsigned scalar_registers = 0;
  unsigned waves = 0;  // waves that a SIMD unit can hold at once
  unsigned code_bytes = 0;
};

// Thrown if this machine has no RADV.
struct NoRadv : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class NullDevice {
 public:
  // `family` is a GPU name that RADV knows, such as navi21. Throws NoRadv.
  explicit NullDevice(const std::string& family);
  ~NullDevice();
  NullDevice(const NullDevice&) = delete;
  NullDevice& operator=(const NullDevice&) = delete;

  // Returns the name and version of the driver.
  std::string driver() const;

  // `samplers` has the sampler types of descriptor set sampler_set, by binding.
  CompiledShader compute(const std::vector<std::uint32_t>& spirv, const std::vector<std::string>& samplers);

  // A graphics pipeline. draw() returns the result of the vertex shader if `counts_vertex` is true, and
  // otherwise of the fragment shader. `attributes` has the types of the vertex shader's inputs, and `targets`
  // the types of the fragment shader's outputs, both by location.
  struct Draw {
    std::vector<std::uint32_t> vertex, fragment;
    bool counts_vertex = false;
    bool points = false;
    std::vector<StageVariable> attributes, targets;
    std::vector<std::string> samplers;
  };
  CompiledShader draw(const Draw& draw);

 private:
  struct Vulkan;
  std::unique_ptr<Vulkan> vulkan_;
};

}  // namespace nook::lab
