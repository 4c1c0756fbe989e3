#include "samples/vulkan/spirv.h"

#include <glslang/Include/glslang_c_interface.h>
#include <glslang/Public/resource_limits_c.h>
#include <stdio.h>

static VkResult make_module(VkDevice device, glslang_program_t* program, glslang_stage_t stage,
                            VkShaderModule* out) {
  VkShaderModuleCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  glslang_program_SPIRV_generate(program, stage);
  info.codeSize = glslang_program_SPIRV_get_size(program) * sizeof(uint32_t);
  info.pCode = glslang_program_SPIRV_get_ptr(program);
  return vkCreateShaderModule(device, &info, NULL, out);
}

VkResult spirv_module(VkDevice device, VkShaderStageFlagBits stage, const char* text, VkShaderModule* out) {
  const glslang_input_t input = {
      .language = GLSLANG_SOURCE_GLSL,
      .stage = stage == VK_SHADER_STAGE_VERTEX_BIT ? GLSLANG_STAGE_VERTEX : GLSLANG_STAGE_FRAGMENT,
      .client = GLSLANG_CLIENT_VULKAN,
      .client_version = GLSLANG_TARGET_VULKAN_1_1,
      .target_language = GLSLANG_TARGET_SPV,
      .target_language_version = GLSLANG_TARGET_SPV_1_3,
      .code = text,
      .default_version = 450,
      .default_profile = GLSLANG_CORE_PROFILE,
      .messages = GLSLANG_MSG_SPV_RULES_BIT | GLSLANG_MSG_VULKAN_RULES_BIT,
      .resource = (const glslang_resource_t*)glslang_default_resource()};
  VkResult r = VK_ERROR_INVALID_SHADER_NV;
  /* glslang stays initialised until the program ends, because initialising it takes longer than compiling a
   * shader. */
  static int started;
  if (!started) started = glslang_initialize_process();
  glslang_shader_t* const shader = glslang_shader_create(&input);
  glslang_program_t* const program = glslang_program_create();
  if (!glslang_shader_preprocess(shader, &input) || !glslang_shader_parse(shader, &input)) {
    fprintf(stderr, "a shader does not compile: %s\n", glslang_shader_get_info_log(shader));
  } else {
    glslang_program_add_shader(program, shader);
    if (glslang_program_link(program, (int)input.messages))
      r = make_module(device, program, input.stage, out);
    else
      fprintf(stderr, "a shader does not link: %s\n", glslang_program_get_info_log(program));
  }
  glslang_program_delete(program);
  glslang_shader_delete(shader);
  return r;
}
