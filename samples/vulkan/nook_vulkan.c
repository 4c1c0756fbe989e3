#include "samples/vulkan/nook_vulkan.h"

#include <stdlib.h>
#include <string.h>

#include "samples/vulkan/spirv.h"

/* Bindings as in nook_stages.h, and the offsets of both blocks in one buffer: 1024 is a multiple of the
 * alignment of every device. */
enum { first_image = 2, bindings = first_image + NOOK_NNAO_STAGE_MAX_INPUTS, network_offset = 1024 };

static VkResult from_nook(nook_result result) {
  return result ? VK_ERROR_UNKNOWN : VK_SUCCESS;
}

/* Returns an allowed memory type, if possible a device-local one. */
static uint32_t memory_type(VkPhysicalDevice physical, uint32_t allowed) {
  VkPhysicalDeviceMemoryProperties memory;
  uint32_t any = 0;
  vkGetPhysicalDeviceMemoryProperties(physical, &memory);
  for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
    if (!(allowed >> i & 1)) continue;
    if (memory.memoryTypes[i].propertyFlags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) return i;
    any = i;
  }
  return any;
}

static VkResult allocate(const nook_vulkan* v, const VkMemoryRequirements* needs, VkDeviceMemory* out) {
  const VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                     .allocationSize = needs->size,
                                     .memoryTypeIndex = memory_type(v->physical, needs->memoryTypeBits)};
  return vkAllocateMemory(v->device, &info, NULL, out);
}

static VkFormat vulkan_format(nook_nnao_format format) {
  switch (format) {
    case NOOK_NNAO_FORMAT_R8_UNORM:
      return VK_FORMAT_R8_UNORM;
    case NOOK_NNAO_FORMAT_R8G8_UNORM:
      return VK_FORMAT_R8G8_UNORM;
    case NOOK_NNAO_FORMAT_R8G8B8A8_UNORM:
      return VK_FORMAT_R8G8B8A8_UNORM;
    case NOOK_NNAO_FORMAT_R32_UINT:
      return VK_FORMAT_R32_UINT;
    case NOOK_NNAO_FORMAT_R32G32_UINT:
      return VK_FORMAT_R32G32_UINT;
    default:
      return VK_FORMAT_UNDEFINED;
  }
}

static VkResult describe_image(const nook_vulkan* v, nook_nnao_image which, nook_nnao_image_info* info) {
  info->struct_size = sizeof *info;
  return from_nook(nook_nnao_stages_describe_image(v->stages, which, info));
}

/* Stages write each image as a colour attachment and read it as a texture. */
static VkResult make_image(nook_vulkan* v, nook_nnao_image which) {
  nook_vulkan_image* const to = &v->images[which];
  nook_nnao_image_info info;
  VkMemoryRequirements needs;
  VkResult r = describe_image(v, which, &info);
  if (r || info.format == NOOK_NNAO_FORMAT_NONE) return r;
  to->size = (VkExtent2D){(uint32_t)info.width, (uint32_t)info.height};
  const VkImageCreateInfo image = {
      .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
      .imageType = VK_IMAGE_TYPE_2D,
      .format = vulkan_format(info.format),
      .extent = {to->size.width, to->size.height, 1},
      .mipLevels = 1,
      .arrayLayers = 1,
      .samples = VK_SAMPLE_COUNT_1_BIT,
      .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
               (which == NOOK_NNAO_IMAGE_TARGET ? VK_IMAGE_USAGE_TRANSFER_SRC_BIT : 0)};
  r = vkCreateImage(v->device, &image, NULL, &to->image);
  if (r) return r;
  vkGetImageMemoryRequirements(v->device, to->image, &needs);
  r = allocate(v, &needs, &to->memory);
  if (!r) r = vkBindImageMemory(v->device, to->image, to->memory, 0);
  const VkImageViewCreateInfo view = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                      .image = to->image,
                                      .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                      .format = image.format,
                                      .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
  return r ? r : vkCreateImageView(v->device, &view, NULL, &to->view);
}

/* Images that keep their contents for the next frame are swapped in every second frame. */
static const nook_vulkan_image* image_of(const nook_vulkan* v, nook_nnao_image which, int odd) {
  const int swaps = odd && v->images[NOOK_NNAO_IMAGE_HISTORY_AO].image;
  if (swaps && (which == NOOK_NNAO_IMAGE_DEPTH || which == NOOK_NNAO_IMAGE_HISTORY_DEPTH))
    which = NOOK_NNAO_IMAGE_DEPTH + NOOK_NNAO_IMAGE_HISTORY_DEPTH - which;
  else if (swaps && (which == NOOK_NNAO_IMAGE_ACCUMULATED_AO || which == NOOK_NNAO_IMAGE_HISTORY_AO))
    which = NOOK_NNAO_IMAGE_ACCUMULATED_AO + NOOK_NNAO_IMAGE_HISTORY_AO - which;
  return &v->images[which];
}

static VkResult make_uniforms(nook_vulkan* v) {
  const VkBufferCreateInfo info = {
      .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
      .size = network_offset + v->info.network_bytes,
      .usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT};
  VkMemoryRequirements needs;
  VkResult r = vkCreateBuffer(v->device, &info, NULL, &v->uniforms);
  if (r) return r;
  vkGetBufferMemoryRequirements(v->device, v->uniforms, &needs);
  r = allocate(v, &needs, &v->uniform_memory);
  return r ? r : vkBindBufferMemory(v->device, v->uniforms, v->uniform_memory, 0);
}

/* All stages share one layout: two uniform buffers, then the largest number of images of any stage. */
static VkResult make_layouts(nook_vulkan* v) {
  VkDescriptorSetLayoutBinding binding[bindings];
  const VkSamplerCreateInfo nearest = {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                       .addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                       .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                       .addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE};
  VkResult r = vkCreateSampler(v->device, &nearest, NULL, &v->sampler);
  for (uint32_t i = 0; i < bindings; ++i)
    binding[i] = (VkDescriptorSetLayoutBinding){
        .binding = i,
        .descriptorType =
            i < first_image ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
        .descriptorCount = 1,
        .stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT};
  const VkDescriptorSetLayoutCreateInfo set = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                               .bindingCount = bindings,
                                               .pBindings = binding};
  if (!r) r = vkCreateDescriptorSetLayout(v->device, &set, NULL, &v->set_layout);
  const VkPipelineLayoutCreateInfo layout = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                             .setLayoutCount = 1,
                                             .pSetLayouts = &v->set_layout};
  if (!r) r = vkCreatePipelineLayout(v->device, &layout, NULL, &v->pipeline_layout);
  const uint32_t sets = 2 * v->info.stage_count;
  const VkDescriptorPoolSize sizes[2] = {
      {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 2 * sets},
      {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, NOOK_NNAO_STAGE_MAX_INPUTS * sets}};
  const VkDescriptorPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                           .maxSets = sets,
                                           .poolSizeCount = 2,
                                           .pPoolSizes = sizes};
  return r ? r : vkCreateDescriptorPool(v->device, &pool, NULL, &v->descriptor_pool);
}

/* The dependencies of the render pass are the barriers between stages: a stage waits for earlier commands
 * that read or wrote its output, and later shaders see what it wrote. */
static VkResult make_render_pass(nook_vulkan* v, nook_vulkan_stage* stage) {
  const VkImageLayout read = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  nook_nnao_image_info image;
  VkResult r = describe_image(v, stage->info.output, &image);
  const VkAttachmentDescription attachment = {.format = vulkan_format(image.format),
                                              .samples = VK_SAMPLE_COUNT_1_BIT,
                                              .loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                              .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                              .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                              .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                              .initialLayout = read,
                                              .finalLayout = read};
  const VkAttachmentReference colour = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  const VkSubpassDescription subpass = {.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                        .colorAttachmentCount = 1,
                                        .pColorAttachments = &colour};
  const VkPipelineStageFlags output = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                             shader = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
  const VkSubpassDependency dependencies[2] = {
      {.srcSubpass = VK_SUBPASS_EXTERNAL,
       .dstSubpass = 0,
       .srcStageMask = output | shader | VK_PIPELINE_STAGE_TRANSFER_BIT,
       .dstStageMask = output,
       .srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
       .dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT},
      {.srcSubpass = 0,
       .dstSubpass = VK_SUBPASS_EXTERNAL,
       .srcStageMask = output,
       .dstStageMask = shader,
       .srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
       .dstAccessMask = VK_ACCESS_SHADER_READ_BIT}};
  const VkRenderPassCreateInfo info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                       .attachmentCount = 1,
                                       .pAttachments = &attachment,
                                       .subpassCount = 1,
                                       .pSubpasses = &subpass,
                                       .dependencyCount = 2,
                                       .pDependencies = dependencies};
  return r ? r : vkCreateRenderPass(v->device, &info, NULL, &stage->render_pass);
}

static VkResult make_pipeline(nook_vulkan* v, nook_vulkan_stage* stage) {
  const VkDynamicState states[2] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  const VkPipelineDynamicStateCreateInfo dynamic = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
      .dynamicStateCount = 2,
      .pDynamicStates = states};
  const VkPipelineVertexInputStateCreateInfo vertices = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  const VkPipelineInputAssemblyStateCreateInfo triangles = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
      .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
  const VkPipelineViewportStateCreateInfo viewport = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1, .scissorCount = 1};
  const VkPipelineRasterizationStateCreateInfo raster = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .lineWidth = 1};
  const VkPipelineMultisampleStateCreateInfo samples = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
      .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
  const VkPipelineColorBlendAttachmentState write = {.colorWriteMask = 15};
  const VkPipelineColorBlendStateCreateInfo blend = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
      .attachmentCount = 1,
      .pAttachments = &write};
  VkPipelineShaderStageCreateInfo shaders[2] = {{.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                                 .stage = VK_SHADER_STAGE_VERTEX_BIT,
                                                 .module = v->vertex_shader,
                                                 .pName = "main"}};
  shaders[1] = shaders[0];
  shaders[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
  VkResult r =
      spirv_module(v->device, VK_SHADER_STAGE_FRAGMENT_BIT, stage->info.fragment_shader, &shaders[1].module);
  const VkGraphicsPipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                             .stageCount = 2,
                                             .pStages = shaders,
                                             .pVertexInputState = &vertices,
                                             .pInputAssemblyState = &triangles,
                                             .pViewportState = &viewport,
                                             .pRasterizationState = &raster,
                                             .pMultisampleState = &samples,
                                             .pColorBlendState = &blend,
                                             .pDynamicState = &dynamic,
                                             .layout = v->pipeline_layout,
                                             .renderPass = stage->render_pass};
  if (r) return r;
  r = vkCreateGraphicsPipelines(v->device, VK_NULL_HANDLE, 1, &info, NULL, &stage->pipeline);
  vkDestroyShaderModule(v->device, shaders[1].module, NULL);
  return r;
}

/* Returns the view of an image of the engine or of Nook. */
static VkImageView view_of(const nook_vulkan* v, const nook_vulkan_inputs* inputs, nook_nnao_image which,
                           int odd) {
  const VkImageView host[4] = {inputs->depth, inputs->normal, inputs->layer, inputs->motion};
  if (which >= NOOK_NNAO_IMAGE_DEPTH) return image_of(v, which, odd)->view;
  return host[which] ? host[which] : inputs->depth;
}

static VkResult make_set(nook_vulkan* v, nook_vulkan_stage* stage, const nook_vulkan_inputs* inputs,
                         int odd) {
  const VkDescriptorSetAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                            .descriptorPool = v->descriptor_pool,
                                            .descriptorSetCount = 1,
                                            .pSetLayouts = &v->set_layout};
  const VkDescriptorBufferInfo blocks[2] = {{v->uniforms, 0, NOOK_NNAO_STAGE_CONSTANTS * sizeof(float)},
                                            {v->uniforms, network_offset, v->info.network_bytes}};
  VkDescriptorImageInfo images[NOOK_NNAO_STAGE_MAX_INPUTS];
  VkWriteDescriptorSet writes[bindings];
  const VkResult r = vkAllocateDescriptorSets(v->device, &info, &stage->sets[odd]);
  for (uint32_t i = 0; !r && i < bindings; ++i) {
    writes[i] = (VkWriteDescriptorSet){.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                       .dstSet = stage->sets[odd],
                                       .dstBinding = i,
                                       .descriptorCount = 1};
    if (i < first_image) {
      writes[i].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
      writes[i].pBufferInfo = &blocks[i];
    } else {
      /* Bindings without an input get the depth image, because some drivers read every descriptor of a set.
       */
      const uint32_t input = i - first_image;
      const nook_nnao_image which =
          input < stage->info.input_count ? stage->info.inputs[input] : NOOK_NNAO_IMAGE_HOST_DEPTH;
      VkDescriptorImageInfo* const image = &images[input];
      *image = (VkDescriptorImageInfo){v->sampler, view_of(v, inputs, which, odd),
                                       VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
      writes[i].descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
      writes[i].pImageInfo = image;
    }
  }
  if (!r) vkUpdateDescriptorSets(v->device, bindings, writes, 0, NULL);
  return r;
}

static VkResult make_stage(nook_vulkan* v, uint32_t index, const nook_vulkan_inputs* inputs) {
  nook_vulkan_stage* const stage = &v->stage[index];
  stage->info.struct_size = sizeof stage->info;
  VkResult r = from_nook(nook_nnao_stages_describe_stage(v->stages, index, &stage->info));
  if (!r) r = make_render_pass(v, stage);
  if (!r) r = make_pipeline(v, stage);
  for (int odd = 0; !r && odd < 2; ++odd) {
    const nook_vulkan_image* const output = image_of(v, stage->info.output, odd);
    const VkFramebufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                          .renderPass = stage->render_pass,
                                          .attachmentCount = 1,
                                          .pAttachments = &output->view,
                                          .width = output->size.width,
                                          .height = output->size.height,
                                          .layers = 1};
    r = vkCreateFramebuffer(v->device, &info, NULL, &stage->framebuffers[odd]);
    if (!r) r = make_set(v, stage, inputs, odd);
  }
  return r;
}

VkResult nook_vulkan_create(VkPhysicalDevice physical, VkDevice device, nook_context context,
                            const nook_nnao_desc* desc, const nook_vulkan_inputs* inputs, nook_vulkan* pass) {
  memset(pass, 0, sizeof *pass);
  pass->physical = physical;
  pass->device = device;
  pass->info.struct_size = sizeof pass->info;
  VkResult r = from_nook(nook_nnao_stages_create(context, desc, &pass->stages));
  if (!r) r = from_nook(nook_nnao_stages_describe(pass->stages, &pass->info));
  if (!r) pass->stage = calloc(pass->info.stage_count, sizeof *pass->stage);
  if (!r && !pass->stage) r = VK_ERROR_OUT_OF_HOST_MEMORY;
  for (nook_nnao_image image = 0; !r && image < NOOK_NNAO_IMAGE_COUNT; ++image) r = make_image(pass, image);
  if (!r) r = make_uniforms(pass);
  if (!r) r = make_layouts(pass);
  if (!r)
    r = spirv_module(device, VK_SHADER_STAGE_VERTEX_BIT, pass->info.vertex_shader, &pass->vertex_shader);
  for (uint32_t i = 0; !r && i < pass->info.stage_count; ++i) r = make_stage(pass, i, inputs);
  if (r) nook_vulkan_destroy(pass);
  return r;
}

/* Changes every image once to the layout that stages expect. */
static void record_first_layouts(const nook_vulkan* v, VkCommandBuffer commands) {
  for (int i = 0; i < NOOK_NNAO_IMAGE_COUNT; ++i) {
    const VkImageMemoryBarrier barrier = {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
                                          .dstAccessMask = VK_ACCESS_SHADER_READ_BIT,
                                          .oldLayout = VK_IMAGE_LAYOUT_UNDEFINED,
                                          .newLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                          .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                          .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                          .image = v->images[i].image,
                                          .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
    if (barrier.image)
      vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
                           0, 0, NULL, 0, NULL, 1, &barrier);
  }
}

/* The constants of the frame are written to the buffer in order with the draws, after the previous frame has
 * read its constants. */
static void record_uniforms(const nook_vulkan* v, VkCommandBuffer commands, const float* constants) {
  const VkMemoryBarrier written = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                   .srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                                   .dstAccessMask = VK_ACCESS_UNIFORM_READ_BIT};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0,
                       NULL, 0, NULL, 0, NULL);
  vkCmdUpdateBuffer(commands, v->uniforms, 0, NOOK_NNAO_STAGE_CONSTANTS * sizeof(float), constants);
  if (v->frames == 0)
    vkCmdUpdateBuffer(commands, v->uniforms, network_offset, v->info.network_bytes, v->info.network);
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0, 1,
                       &written, 0, NULL, 0, NULL);
}

static void record_stage(const nook_vulkan* v, const nook_vulkan_stage* stage, VkCommandBuffer commands,
                         const nook_nnao_frame_values* values) {
  const int odd = (int)(v->frames & 1);
  const int* const box = values->viewport;
  const VkRect2D area =
      stage->info.draws_viewport
          ? (VkRect2D){{box[0], box[1]}, {(uint32_t)box[2], (uint32_t)box[3]}}
          : (VkRect2D){{0, 0}, {(uint32_t)values->surface_width, (uint32_t)values->surface_height}};
  const VkViewport viewport = {
      (float)area.offset.x, (float)area.offset.y, (float)area.extent.width, (float)area.extent.height, 0, 1};
  const VkRenderPassBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                       .renderPass = stage->render_pass,
                                       .framebuffer = stage->framebuffers[odd],
                                       .renderArea = area};
  vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, stage->pipeline);
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, v->pipeline_layout, 0, 1,
                          &stage->sets[odd], 0, NULL);
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &area);
  vkCmdDraw(commands, 3, 1, 0, 0);
  vkCmdEndRenderPass(commands);
}

VkResult nook_vulkan_record(nook_vulkan* pass, VkCommandBuffer commands, const nook_gl_frame_desc* frame,
                            const nook_nnao_frame_desc* desc) {
  nook_nnao_frame_values values;
  values.struct_size = sizeof values;
  if (nook_nnao_stages_frame(pass->stages, frame, desc, pass->frames ? &pass->earlier : NULL, pass->frames, 0,
                             &values))
    return VK_ERROR_UNKNOWN;
  if (pass->frames == 0) record_first_layouts(pass, commands);
  record_uniforms(pass, commands, values.constants);
  for (uint32_t i = 0; i < pass->info.stage_count; ++i)
    if (values.drawn_stages >> i & 1) record_stage(pass, &pass->stage[i], commands, &values);
  pass->earlier = *frame;
  ++pass->frames;
  return VK_SUCCESS;
}

void nook_vulkan_destroy(nook_vulkan* pass) {
  const VkDevice device = pass->device;
  for (uint32_t i = 0; pass->stage && i < pass->info.stage_count; ++i) {
    for (int odd = 0; odd < 2; ++odd) vkDestroyFramebuffer(device, pass->stage[i].framebuffers[odd], NULL);
    vkDestroyPipeline(device, pass->stage[i].pipeline, NULL);
    vkDestroyRenderPass(device, pass->stage[i].render_pass, NULL);
  }
  for (int i = 0; device && i < NOOK_NNAO_IMAGE_COUNT; ++i) {
    vkDestroyImageView(device, pass->images[i].view, NULL);
    vkDestroyImage(device, pass->images[i].image, NULL);
    vkFreeMemory(device, pass->images[i].memory, NULL);
  }
  if (device) {
    vkDestroyShaderModule(device, pass->vertex_shader, NULL);
    vkDestroyDescriptorPool(device, pass->descriptor_pool, NULL);
    vkDestroyPipelineLayout(device, pass->pipeline_layout, NULL);
    vkDestroyDescriptorSetLayout(device, pass->set_layout, NULL);
    vkDestroySampler(device, pass->sampler, NULL);
    vkDestroyBuffer(device, pass->uniforms, NULL);
    vkFreeMemory(device, pass->uniform_memory, NULL);
  }
  free(pass->stage);
  nook_nnao_stages_destroy(&pass->stages);
  memset(pass, 0, sizeof *pass);
}
