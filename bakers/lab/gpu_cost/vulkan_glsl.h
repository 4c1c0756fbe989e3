// Translates OpenGL GLSL to Vulkan GLSL. Default uniforms become members of one std140 block, as in OpenGL
// drivers. Samplers and images get a set and a binding. Stage inputs and outputs get a location.
#pragma once

#include <string>
#include <vector>

namespace nook::lab {

// Descriptor sets. Storage blocks are in set 0 and keep the bindings of the OpenGL text.
inline constexpr unsigned storage_block_set = 0, sampler_set = 1, uniform_set = 2, image_set = 3;

struct StageVariable {
  std::string type, name;
  bool flat = false;
  int elements = 0;  // array size; 0 for a single value

  int locations() const { return elements > 0 ? elements : 1; }
};

struct VulkanGlsl {
  std::string text;
  std::vector<StageVariable> inputs, outputs;  // consecutive locations, in this order
  std::vector<std::string> samplers;           // types, by binding
  std::vector<std::string> uniforms;           // names of the uniform block's members, in order
};

// The text must be preprocessed, so that it has no conditions, macros or comments.
VulkanGlsl to_vulkan_glsl(const std::string& preprocessed);

}  // namespace nook::lab
