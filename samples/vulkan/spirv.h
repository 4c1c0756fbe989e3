/* Compiles GLSL to Vulkan shader modules, with glslang. */
#ifndef SPIRV_H
#define SPIRV_H

#include <vulkan/vulkan.h>

/* `stage` is VK_SHADER_STAGE_VERTEX_BIT or VK_SHADER_STAGE_FRAGMENT_BIT. If the text does not compile,
 * returns VK_ERROR_INVALID_SHADER_NV and prints the compiler's message to stderr. One call at a time. */
VkResult spirv_module(VkDevice device, VkShaderStageFlagBits stage, const char* text, VkShaderModule* out);

#endif
