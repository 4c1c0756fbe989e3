/* GLSL to shaders of Vulkan, by glslang. */
#ifndef SPIRV_H
#define SPIRV_H

#include <vulkan/vulkan.h>

/* stage is VK_SHADER_STAGE_VERTEX_BIT or VK_SHADER_STAGE_FRAGMENT_BIT. Returns VK_ERROR_INVALID_SHADER_NV
 * where the text does not compile, and prints the compiler's message to stderr. One call at a time. */
VkResult spirv_module(VkDevice device, VkShaderStageFlagBits stage, const char* text, VkShaderModule* out);

#endif
