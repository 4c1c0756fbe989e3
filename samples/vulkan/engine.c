#include "samples/vulkan/engine.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "samples/nnao/room.h"
#include "samples/vulkan/engine_device.h"
#include "samples/vulkan/spirv.h"

enum { max_texel_bytes = 16 };
static const VkFormat depth_format = VK_FORMAT_D32_SFLOAT, normal_format = VK_FORMAT_R32G32B32A32_SFLOAT,
                      colour_format = VK_FORMAT_R8G8B8A8_UNORM;

/* The push constants, which the shaders read in each draw. */
typedef struct engine_push {
  float clip_from_world[16];
  int use_ao;
} engine_push;

static const char vertex_text[] =
    "#version 450\n"
    "layout(location = 0) in vec3 position; layout(location = 1) in vec3 normal; layout(location = 2) in "
    "vec3 albedo;\n"
    "layout(push_constant) uniform push { mat4 clip_from_world; int use_ao; };\n"
    "layout(location = 0) out vec3 normal_ws; layout(location = 1) out vec3 colour;\n"
    "invariant gl_Position;\n"
    "void main() { normal_ws = normal; colour = albedo; gl_Position = clip_from_world * vec4(position, 1.0); "
    "}\n";
static const char normal_text[] =
    "#version 450\n"
    "layout(location = 0) in vec3 normal_ws; layout(location = 0) out vec4 pixel;\n"
    "void main() { pixel = vec4(normalize(normal_ws), 0.0); }\n";
/* Ambient light comes from everywhere and is multiplied by AO. AO does not touch the one lamp. */
static const char fragment_text[] =
    "#version 450\n"
    "layout(location = 0) in vec3 normal_ws; layout(location = 1) in vec3 colour;\n"
    "layout(push_constant) uniform push { mat4 clip_from_world; int use_ao; };\n"
    "layout(binding = 0) uniform sampler2D ao; layout(location = 0) out vec4 pixel;\n"
    "void main() {\n"
    "  float open = use_ao != 0 ? texelFetch(ao, ivec2(gl_FragCoord.xy), 0).r : 1.0;\n"
    "  float lamp = max(dot(normalize(normal_ws), normalize(vec3(0.5, 0.8, 0.6))), 0.0);\n"
    "  pixel = vec4(pow(colour * (0.75 * open + 0.25 * lamp), vec3(1.0 / 2.2)), 1.0);\n"
    "}\n";

/* Clip y points down and depth goes from 0 to 1. */
static void place_camera(engine* e) {
  const float near_m = 0.1F, far_m = 50.0F, scale = 1.0F / tanf(0.5F * 1.05F);
  room_view(e->view);
  memset(e->projection, 0, sizeof e->projection);
  e->projection[0] = scale * (float)e->height / (float)e->width;
  e->projection[5] = -scale;
  e->projection[10] = e->reversed ? near_m / (far_m - near_m) : far_m / (near_m - far_m);
  e->projection[11] = -1;
  e->projection[14] = (e->reversed ? 1.0F : -1.0F) * far_m * near_m / (far_m - near_m);
}

static VkResult make_image(engine* e, VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect,
                           engine_image* out) {
  const VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                  .imageType = VK_IMAGE_TYPE_2D,
                                  .format = format,
                                  .extent = {(uint32_t)e->width, (uint32_t)e->height, 1},
                                  .mipLevels = 1,
                                  .arrayLayers = 1,
                                  .samples = VK_SAMPLE_COUNT_1_BIT,
                                  .usage = usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT};
  VkMemoryRequirements needs;
  VkResult r = vkCreateImage(e->device, &info, NULL, &out->image);
  if (r) return r;
  vkGetImageMemoryRequirements(e->device, out->image, &needs);
  r = engine_allocate(e, &needs, 0, &out->memory);
  if (!r) r = vkBindImageMemory(e->device, out->image, out->memory, 0);
  const VkImageViewCreateInfo view = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                      .image = out->image,
                                      .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                      .format = format,
                                      .subresourceRange = {aspect, 0, 1, 0, 1}};
  return r ? r : vkCreateImageView(e->device, &view, NULL, &out->view);
}

/* Makes a buffer that the CPU writes or reads. */
static VkResult make_buffer(engine* e, VkDeviceSize size, VkBufferUsageFlags usage, VkBuffer* buffer,
                            VkDeviceMemory* memory) {
  const VkBufferCreateInfo info = {
      .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = size, .usage = usage};
  VkMemoryRequirements needs;
  VkResult r = vkCreateBuffer(e->device, &info, NULL, buffer);
  if (r) return r;
  vkGetBufferMemoryRequirements(e->device, *buffer, &needs);
  r = engine_allocate(e, &needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                      memory);
  return r ? r : vkBindBufferMemory(e->device, *buffer, *memory, 0);
}

static VkResult upload_room(engine* e) {
  int count = 0;
  room_vertex* const vertices = room_make(&count);
  const size_t bytes = (size_t)count * sizeof *vertices;
  void* mapped = NULL;
  VkResult r = vertices ? VK_SUCCESS : VK_ERROR_OUT_OF_HOST_MEMORY;
  if (!r) r = make_buffer(e, bytes, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, &e->vertices, &e->vertex_memory);
  if (!r) r = vkMapMemory(e->device, e->vertex_memory, 0, VK_WHOLE_SIZE, 0, &mapped);
  if (!r) memcpy(mapped, vertices, bytes);
  e->vertex_count = (uint32_t)count;
  free(vertices);
  return r;
}

/* Pass 0 clears depth, pass 1 compares with it. Afterwards shaders may read the images of both. Both wait for
 * earlier commands that use their images. */
static VkResult make_pass(engine* e, int which) {
  const VkImageLayout read = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  const VkAttachmentDescription attachments[2] = {
      {.format = depth_format,
       .samples = VK_SAMPLE_COUNT_1_BIT,
       .loadOp = which == 0 ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD,
       .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
       .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
       .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
       .initialLayout = which == 0 ? VK_IMAGE_LAYOUT_UNDEFINED : read,
       .finalLayout = read},
      {.format = which == 0 ? normal_format : colour_format,
       .samples = VK_SAMPLE_COUNT_1_BIT,
       .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
       .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
       .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
       .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
       .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
       .finalLayout = read}};
  const VkAttachmentReference depth = {0, which == 0 ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
                                                     : VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL},
                              colour = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  const VkSubpassDescription subpass = {.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                        .colorAttachmentCount = 1,
                                        .pColorAttachments = &colour,
                                        .pDepthStencilAttachment = &depth};
  const VkPipelineStageFlags tests =
      VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
  const VkPipelineStageFlags draws = tests | VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  const VkPipelineStageFlags reads = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
  const VkAccessFlags writes =
      VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
  const VkSubpassDependency dependencies[2] = {
      {.srcSubpass = VK_SUBPASS_EXTERNAL,
       .srcStageMask = draws | reads,
       .dstStageMask = draws,
       .srcAccessMask = writes,
       .dstAccessMask = writes | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT},
      {.dstSubpass = VK_SUBPASS_EXTERNAL,
       .srcStageMask = draws,
       .dstStageMask = reads,
       .srcAccessMask = writes,
       .dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT}};
  const VkRenderPassCreateInfo info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                       .attachmentCount = 2,
                                       .pAttachments = attachments,
                                       .subpassCount = 1,
                                       .pSubpasses = &subpass,
                                       .dependencyCount = 2,
                                       .pDependencies = dependencies};
  return vkCreateRenderPass(e->device, &info, NULL, &e->passes[which]);
}

static VkResult make_framebuffer(engine* e, int which) {
  const VkImageView views[2] = {e->depth.view, which == 0 ? e->normal.view : e->colour.view};
  const VkFramebufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                        .renderPass = e->passes[which],
                                        .attachmentCount = 2,
                                        .pAttachments = views,
                                        .width = (uint32_t)e->width,
                                        .height = (uint32_t)e->height,
                                        .layers = 1};
  return vkCreateFramebuffer(e->device, &info, NULL, &e->framebuffers[which]);
}

/* The descriptor set holds the AO texture. */
static VkResult make_layouts(engine* e) {
  const VkSamplerCreateInfo nearest = {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  VkResult r = vkCreateSampler(e->device, &nearest, NULL, &e->sampler);
  const VkDescriptorSetLayoutBinding binding = {.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                                .descriptorCount = 1,
                                                .stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT};
  const VkDescriptorSetLayoutCreateInfo set = {
      .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, .bindingCount = 1, .pBindings = &binding};
  if (!r) r = vkCreateDescriptorSetLayout(e->device, &set, NULL, &e->set_layout);
  const VkPushConstantRange push = {VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                                    sizeof(engine_push)};
  const VkPipelineLayoutCreateInfo layout = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                             .setLayoutCount = 1,
                                             .pSetLayouts = &e->set_layout,
                                             .pushConstantRangeCount = 1,
                                             .pPushConstantRanges = &push};
  if (!r) r = vkCreatePipelineLayout(e->device, &layout, NULL, &e->layout);
  const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
  const VkDescriptorPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                           .maxSets = 1,
                                           .poolSizeCount = 1,
                                           .pPoolSizes = &size};
  if (!r) r = vkCreateDescriptorPool(e->device, &pool, NULL, &e->descriptor_pool);
  if (r) return r;
  const VkDescriptorSetAllocateInfo one = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = e->descriptor_pool,
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &e->set_layout};
  return vkAllocateDescriptorSets(e->device, &one, &e->set);
}

static const VkVertexInputBindingDescription vertex_binding = {0, sizeof(room_vertex),
                                                               VK_VERTEX_INPUT_RATE_VERTEX};
static const VkVertexInputAttributeDescription vertex_attributes[3] = {
    {0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(room_vertex, position)},
    {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(room_vertex, normal)},
    {2, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(room_vertex, albedo)}};

static VkResult make_pipeline(engine* e, int which, VkShaderModule vertex, VkShaderModule fragment) {
  const VkPipelineVertexInputStateCreateInfo vertices = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
      .vertexBindingDescriptionCount = 1,
      .pVertexBindingDescriptions = &vertex_binding,
      .vertexAttributeDescriptionCount = 3,
      .pVertexAttributeDescriptions = vertex_attributes};
  const VkPipelineInputAssemblyStateCreateInfo triangles = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
      .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
  const VkViewport box = {0, 0, (float)e->width, (float)e->height, 0, 1};
  const VkRect2D scissor = {{0, 0}, {(uint32_t)e->width, (uint32_t)e->height}};
  const VkPipelineViewportStateCreateInfo viewport = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
      .viewportCount = 1,
      .pViewports = &box,
      .scissorCount = 1,
      .pScissors = &scissor};
  const VkPipelineRasterizationStateCreateInfo raster = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .lineWidth = 1};
  const VkPipelineMultisampleStateCreateInfo samples = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
      .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
  const VkPipelineDepthStencilStateCreateInfo depth = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
      .depthTestEnable = VK_TRUE,
      .depthWriteEnable = which == 0,
      .depthCompareOp = e->reversed ? VK_COMPARE_OP_GREATER_OR_EQUAL : VK_COMPARE_OP_LESS_OR_EQUAL};
  const VkPipelineColorBlendAttachmentState write = {.colorWriteMask = 15};
  const VkPipelineColorBlendStateCreateInfo blend = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
      .attachmentCount = 1,
      .pAttachments = &write};
  const VkPipelineShaderStageCreateInfo shaders[2] = {
      {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
       .stage = VK_SHADER_STAGE_VERTEX_BIT,
       .module = vertex,
       .pName = "main"},
      {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
       .stage = VK_SHADER_STAGE_FRAGMENT_BIT,
       .module = fragment,
       .pName = "main"}};
  const VkGraphicsPipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                             .stageCount = 2,
                                             .pStages = shaders,
                                             .pVertexInputState = &vertices,
                                             .pInputAssemblyState = &triangles,
                                             .pViewportState = &viewport,
                                             .pRasterizationState = &raster,
                                             .pMultisampleState = &samples,
                                             .pDepthStencilState = &depth,
                                             .pColorBlendState = &blend,
                                             .layout = e->layout,
                                             .renderPass = e->passes[which]};
  return vkCreateGraphicsPipelines(e->device, VK_NULL_HANDLE, 1, &info, NULL, &e->pipelines[which]);
}

static VkResult make_pipelines(engine* e) {
  const char* const fragment_texts[2] = {normal_text, fragment_text};
  VkShaderModule vertex = VK_NULL_HANDLE;
  VkResult r = spirv_module(e->device, VK_SHADER_STAGE_VERTEX_BIT, vertex_text, &vertex);
  for (int which = 0; !r && which < 2; ++which) {
    VkShaderModule fragment = VK_NULL_HANDLE;
    r = make_pass(e, which);
    if (!r) r = make_framebuffer(e, which);
    if (!r) r = spirv_module(e->device, VK_SHADER_STAGE_FRAGMENT_BIT, fragment_texts[which], &fragment);
    if (!r) r = make_pipeline(e, which, vertex, fragment);
    vkDestroyShaderModule(e->device, fragment, NULL);
  }
  vkDestroyShaderModule(e->device, vertex, NULL);
  return r;
}

VkResult engine_start(engine* e, int width, int height, int reversed) {
  memset(e, 0, sizeof *e);
  e->width = width;
  e->height = height;
  e->reversed = reversed;
  place_camera(e);
  VkResult r = engine_make_device(e);
  const VkImageUsageFlags drawn = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                          tested = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  if (!r) r = make_image(e, depth_format, tested, VK_IMAGE_ASPECT_DEPTH_BIT, &e->depth);
  if (!r) r = make_image(e, normal_format, drawn, VK_IMAGE_ASPECT_COLOR_BIT, &e->normal);
  if (!r) r = make_image(e, colour_format, drawn, VK_IMAGE_ASPECT_COLOR_BIT, &e->colour);
  if (!r)
    r = make_buffer(e, (VkDeviceSize)width * (VkDeviceSize)height * max_texel_bytes,
                    VK_BUFFER_USAGE_TRANSFER_DST_BIT, &e->readback, &e->readback_memory);
  if (!r) r = upload_room(e);
  if (!r) r = make_layouts(e);
  return r ? r : make_pipelines(e);
}

static void multiply(const float a[16], const float b[16], float out[16]) {
  for (int i = 0; i < 16; ++i) {
    out[i] = 0;
    for (int k = 0; k < 4; ++k) out[i] += a[4 * k + i % 4] * b[i / 4 * 4 + k];
  }
}

static void draw(engine* e, int which, int use_ao) {
  const VkClearValue clear[2] = {{.depthStencil = {e->reversed ? 0.0F : 1.0F, 0}},
                                 {.color = {{0.55F, 0.65F, 0.8F, 1}}}}; /* of the sky */
  const VkRenderPassBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                       .renderPass = e->passes[which],
                                       .framebuffer = e->framebuffers[which],
                                       .renderArea = {{0, 0}, {(uint32_t)e->width, (uint32_t)e->height}},
                                       .clearValueCount = 2,
                                       .pClearValues = clear};
  const VkDeviceSize offset = 0;
  engine_push push;
  multiply(e->projection, e->view, push.clip_from_world);
  push.use_ao = use_ao;
  vkCmdBeginRenderPass(e->commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
  vkCmdBindPipeline(e->commands, VK_PIPELINE_BIND_POINT_GRAPHICS, e->pipelines[which]);
  if (which == 1)
    vkCmdBindDescriptorSets(e->commands, VK_PIPELINE_BIND_POINT_GRAPHICS, e->layout, 0, 1, &e->set, 0, NULL);
  vkCmdPushConstants(e->commands, e->layout, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                     sizeof push, &push);
  vkCmdBindVertexBuffers(e->commands, 0, 1, &e->vertices, &offset);
  vkCmdDraw(e->commands, e->vertex_count, 1, 0, 0);
  vkCmdEndRenderPass(e->commands);
}

void engine_draw_depth(engine* e) {
  draw(e, 0, 0);
}

void engine_draw_colour(engine* e, int use_ao) {
  draw(e, 1, use_ao);
}

void engine_set_ao(engine* e, VkImageView ao) {
  const VkDescriptorImageInfo image = {e->sampler, ao, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                      .dstSet = e->set,
                                      .descriptorCount = 1,
                                      .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                      .pImageInfo = &image};
  vkUpdateDescriptorSets(e->device, 1, &write, 0, NULL);
}

VkResult engine_read(engine* e, VkImage image, VkImageAspectFlags aspect, int texel_bytes, void* out) {
  VkImageMemoryBarrier barrier = {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
                                  .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
                                  .dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT,
                                  .oldLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                  .newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                  .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                  .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                  .image = image,
                                  .subresourceRange = {aspect, 0, 1, 0, 1}};
  const VkBufferImageCopy copy = {.imageSubresource = {aspect, 0, 0, 1},
                                  .imageExtent = {(uint32_t)e->width, (uint32_t)e->height, 1}};
  const VkMemoryBarrier to_host = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                   .srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                                   .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
  void* mapped = NULL;
  VkResult r = engine_begin(e);
  if (r) return r;
  vkCmdPipelineBarrier(e->commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0,
                       NULL, 0, NULL, 1, &barrier);
  vkCmdCopyImageToBuffer(e->commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, e->readback, 1, &copy);
  barrier.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  barrier.newLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  barrier.srcAccessMask = 0;
  barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
  vkCmdPipelineBarrier(e->commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0,
                       NULL, 0, NULL, 1, &barrier);
  vkCmdPipelineBarrier(e->commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                       &to_host, 0, NULL, 0, NULL);
  r = engine_finish(e);
  if (!r) r = vkMapMemory(e->device, e->readback_memory, 0, VK_WHOLE_SIZE, 0, &mapped);
  if (!r) {
    memcpy(out, mapped, (size_t)e->width * (size_t)e->height * (size_t)texel_bytes);
    vkUnmapMemory(e->device, e->readback_memory);
  }
  return r;
}

static void destroy_image(engine* e, engine_image* image) {
  vkDestroyImageView(e->device, image->view, NULL);
  vkDestroyImage(e->device, image->image, NULL);
  vkFreeMemory(e->device, image->memory, NULL);
}

void engine_stop(engine* e) {
  if (e->device) {
    for (int which = 0; which < 2; ++which) {
      vkDestroyPipeline(e->device, e->pipelines[which], NULL);
      vkDestroyFramebuffer(e->device, e->framebuffers[which], NULL);
      vkDestroyRenderPass(e->device, e->passes[which], NULL);
    }
    vkDestroyDescriptorPool(e->device, e->descriptor_pool, NULL);
    vkDestroyPipelineLayout(e->device, e->layout, NULL);
    vkDestroyDescriptorSetLayout(e->device, e->set_layout, NULL);
    vkDestroySampler(e->device, e->sampler, NULL);
    vkDestroyBuffer(e->device, e->vertices, NULL);
    vkFreeMemory(e->device, e->vertex_memory, NULL);
    vkDestroyBuffer(e->device, e->readback, NULL);
    vkFreeMemory(e->device, e->readback_memory, NULL);
    destroy_image(e, &e->depth);
    destroy_image(e, &e->normal);
    destroy_image(e, &e->colour);
  }
  engine_destroy_device(e);
}
