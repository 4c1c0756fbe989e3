/* Nook's screen-space pass in a Vulkan 1.1 host: images, pipelines and commands made of what
 * nook_stages.h hands out. Copy this header, nook_vulkan.c, and spirv.h with its source or your own
 * compiler of GLSL. */
#ifndef NOOK_VULKAN_H
#define NOOK_VULKAN_H

#include <nook/experimental/nook_stages.h>
#include <vulkan/vulkan.h>

/* Images of the host, of the size of its frames, which shaders may read without a filter. They are in
 * VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL when the pass runs. Images that the frames never use may be
 * VK_NULL_HANDLE: depth is bound in their place. */
typedef struct nook_vulkan_inputs {
  VkImageView depth; /* the aspect of depth alone; required */
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
  /* One each for even and odd frames, because they swap the images of earlier frames. */
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

/* Makes the objects of a pass. desc has no views; it and the context may go afterwards. Returns
 * VK_ERROR_UNKNOWN where Nook refuses, with the reason in nook_last_message(). On failure *pass is all 0. */
VkResult nook_vulkan_create(VkPhysicalDevice physical, VkDevice device, nook_context context,
                            const nook_nnao_desc* desc, const nook_vulkan_inputs* inputs, nook_vulkan* pass);

/* Records the draws of a frame, outside of render passes. Frames follow each other on one queue. The host's
 * barriers stand before: the inputs are written, and visible to fragment shaders. Afterwards fragment shaders
 * may read images[NOOK_NNAO_IMAGE_TARGET], which is in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL; outside of
 * the frame's viewport it keeps what it had. frame->normal_texture and desc->motion_vectors are 1 where
 * the frame has these images. */
VkResult nook_vulkan_record(nook_vulkan* pass, VkCommandBuffer commands, const nook_gl_frame_desc* frame,
                            const nook_nnao_frame_desc* desc);

/* Destroys what nook_vulkan_create made. No command of it may be running. */
void nook_vulkan_destroy(nook_vulkan* pass);

#endif
