/* The engine of the sample. It has a device, draws the depth, normals and colours of a room, and reads their
 * pixels. */
#ifndef ENGINE_H
#define ENGINE_H

#include <vulkan/vulkan.h>

typedef struct engine_image {
  VkImage image;
  VkDeviceMemory memory;
  VkImageView view;
} engine_image;

typedef struct engine {
  VkInstance instance;
  VkDebugUtilsMessengerEXT messenger;
  /* The number of errors and warnings of the validation layer, which the engine loads if it is installed. */
  int complaints;
  VkPhysicalDevice physical;
  char device_name[VK_MAX_PHYSICAL_DEVICE_NAME_SIZE];
  VkDevice device;
  VkQueue queue;
  VkCommandPool pool;
  VkCommandBuffer commands;
  int width, height, reversed;
  /* Column-major, as Vulkan takes them: depth from 0 to 1, y downwards. */
  float view[16], projection[16];
  VkBuffer vertices, readback;
  VkDeviceMemory vertex_memory, readback_memory;
  uint32_t vertex_count;
  engine_image depth, normal, colour;
  VkSampler sampler;
  VkDescriptorSetLayout set_layout;
  VkDescriptorPool descriptor_pool;
  VkDescriptorSet set;
  VkPipelineLayout layout;
  /* Pass 0 draws depth and normals, pass 1 draws colours. */
  VkRenderPass passes[2];
  VkFramebuffer framebuffers[2];
  VkPipeline pipelines[2];
} engine;

/* With `reversed` 1, the near plane has depth 1 and the far plane depth 0. Returns
 * VK_ERROR_INCOMPATIBLE_DRIVER if there is no device with Vulkan 1.1. The caller must stop the engine in any
 * case. */
VkResult engine_start(engine* e, int width, int height, int reversed);
void engine_stop(engine* e);

/* Sets the AO texture that engine_draw_colour reads, in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL. */
void engine_set_ao(engine* e, VkImageView ao);

/* Between engine_begin and engine_end, record into e->commands. engine_end waits for the device. */
VkResult engine_begin(engine* e);
VkResult engine_finish(engine* e);

/* Draws depth, and normals in world space as four floats. Both are left in
 * VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, visible to fragment shaders. */
void engine_draw_depth(engine* e);
/* Draws the colours; depth must be drawn before. With `use_ao` 0, draws the room without AO. */
void engine_draw_colour(engine* e, int use_ao);

/* Reads an image of the engine's size, with at most 16 bytes for each texel, that is in
 * VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL. Row 0 is the upper one. It waits for the device. */
VkResult engine_read(engine* e, VkImage image, VkImageAspectFlags aspect, int texel_bytes, void* out);

#endif
