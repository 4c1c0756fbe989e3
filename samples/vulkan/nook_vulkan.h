/* Nook's screen-space pass for an engine with Vulkan 1.1. It makes images, pipelines and commands from the
 * data of nook_stages.h. Copy this header, nook_vulkan.c, and spirv.h with its source or your own GLSL
 * compiler. */
#ifndef NOOK_VULKAN_H
#define NOOK_VULKAN_H

#include <nook/experimental/nook_stages.h>
#include <vulkan/vulkan.h>

/* Your images, of the same size as your frames. Shaders read them without filtering. They must be in
 * VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL when the pass runs. If your frames never use an image, it may be
 * VK_NULL_HANDLE; depth is bound in its place. */
typedef struct nook_vulkan_inputs {
  VkImageView depth; /* only the aspect of depth; required */
  VkImageView normal, layer, motion;
} nook_vulkan_inputs;

typedef struct nook_vulkan_image {
  VkImage image;
  VkDeviceMemory memory;
  VkImageView view;
  VkExtent2D size;
} nook_vulkan_image;

typedef struct nook_vulkan_stage {
  nook_nnao_stage_info info;
  VkRenderPass render_pass;
  VkPipeline pipeline;
  /* Even and odd frames need different framebuffers, because frames swap the history images. */
  VkFramebuffer framebuffers[2];
  VkDescriptorSet sets[2];
} nook_vulkan_stage;

typedef struct nook_vulkan {
  VkPhysicalDevice physical;
  VkDevice device;
  nook_nnao_stages stages;
  nook_nnao_stages_info info;
  nook_vulkan_stage* stage; /* info.stage_count of them */
  nook_vulkan_image images[NOOK_NNAO_IMAGE_COUNT];
  VkBuffer uniforms;
  VkDeviceMemory uniform_memory;
  VkSampler sampler;
  VkDescriptorSetLayout set_layout;
  VkPipelineLayout pipeline_layout;
  VkDescriptorPool descriptor_pool;
  VkShaderModule vertex_shader;
  nook_gl_frame_desc earlier;
  uint32_t frames;
} nook_vulkan;

/* Makes the objects of a pass. `desc` must not have views. You may destroy `desc` and the context afterwards.
 * Returns VK_ERROR_UNKNOWN if a call of Nook fails; nook_last_message() has the reason. On failure *pass is
 * all 0. */
VkResult nook_vulkan_create(VkPhysicalDevice physical, VkDevice device, nook_context context,
                            const nook_nnao_desc* desc, const nook_vulkan_inputs* inputs, nook_vulkan* pass);

/* Records the draws of a frame. Call it outside of render passes, and submit all frames to one queue. Before,
 * record barriers that make the inputs visible to fragment shaders. Afterwards fragment shaders may read
 * images[NOOK_NNAO_IMAGE_TARGET], which is in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL; outside of the
 * frame's viewport its contents do not change. Set frame->normal_texture and desc->motion_vectors to 1 if the
 * frame has these images. */
VkResult nook_vulkan_record(nook_vulkan* pass, VkCommandBuffer commands, const nook_gl_frame_desc* frame,
                            const nook_nnao_frame_desc* desc);

/* Destroys the pass. None of its commands may be running. */
void nook_vulkan_destroy(nook_vulkan* pass);

#endif
