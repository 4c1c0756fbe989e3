#include "bakers/lab/gpu_cost/null_device.h"

#include <vulkan/vulkan.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <stdexcept>

namespace nook::lab {
namespace {

// The maximum numbers of storage blocks and images that a shader can bind.
constexpr std::size_t storage_blocks = 16, images = 5;
constexpr std::uint32_t wave_lanes = 64;

void check(VkResult result, const char* call) {
  if (result < 0)
    throw std::runtime_error(std::string("nook_gpu_cost: ") + call + " failed (got VkResult " +
                             std::to_string(result) + ")");
}

// Sets the environment variables that the Vulkan loader reads when it creates an instance.
void choose_driver(const std::string& family) {
  setenv("RADV_FORCE_FAMILY", family.c_str(), 1);
  // Disables NGG (primitive shaders), because OpenGL does not use it for transform feedback.
  setenv("RADV_DEBUG", "nongg,nocache", 1);
  for (const char* option : {"RADV_PERFTEST", "ACO_DEBUG", "RADV_FORCE_VRS"}) unsetenv(option);
  if (std::getenv("VK_ICD_FILENAMES") || std::getenv("VK_DRIVER_FILES")) return;
  const std::filesystem::path folder = "/usr/share/vulkan/icd.d";
  std::error_code missing;
  for (const auto& file : std::filesystem::directory_iterator(folder, missing))
    if (file.path().filename().string().starts_with("radeon_icd"))
      setenv("VK_ICD_FILENAMES", file.path().c_str(), 1);
}

VkFormat format_of(const std::map<std::string, VkFormat>& formats, const std::string& type) {
  const auto found = formats.find(type);
  if (found == formats.end())
    throw std::runtime_error("nook_gpu_cost: no format is known for an input or output of type " + type);
  return found->second;
}

VkFormat attribute_format(const std::string& type) {
  static const std::map<std::string, VkFormat> formats = {
      {"float", VK_FORMAT_R32_SFLOAT},      {"vec2", VK_FORMAT_R32G32_SFLOAT},
      {"vec3", VK_FORMAT_R32G32B32_SFLOAT}, {"vec4", VK_FORMAT_R32G32B32A32_SFLOAT},
      {"int", VK_FORMAT_R32_SINT},          {"uvec4", VK_FORMAT_R16G16B16A16_UINT}};
  return format_of(formats, type);
}

VkFormat target_format(const std::string& type) {
  static const std::map<std::string, VkFormat> formats = {
      {"float", VK_FORMAT_R8_UNORM},          {"vec2", VK_FORMAT_R16G16_UNORM},
      {"vec4", VK_FORMAT_R8G8B8A8_UNORM},     {"uint", VK_FORMAT_R32_UINT},
      {"uvec4", VK_FORMAT_R32G32B32A32_UINT}, {"uvec2", VK_FORMAT_R32G32_UINT}};
  return format_of(formats, type);
}

VkDescriptorType sampler_descriptor(const std::string& type) {
  return type.ends_with("Buffer") ? VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER
                                  : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
}

}  // namespace

struct NullDevice::Vulkan {
  VkInstance instance = nullptr;
  VkPhysicalDevice physical = nullptr;
  VkDevice device = nullptr;
  PFN_vkGetPipelineExecutablePropertiesKHR executable_properties = nullptr;
  PFN_vkGetPipelineExecutableStatisticsKHR executable_statistics = nullptr;
  PFN_vkGetPipelineExecutableInternalRepresentationsKHR executable_texts = nullptr;

  VkShaderModule module(const std::vector<std::uint32_t>& spirv) const {
    VkShaderModuleCreateInfo info = {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0,
                                     spirv.size() * 4, spirv.data()};
    VkShaderModule module = nullptr;
    check(vkCreateShaderModule(device, &info, nullptr, &module), "vkCreateShaderModule");
    return module;
  }

  VkDescriptorSetLayout set_layout(const std::vector<VkDescriptorType>& types) const {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const VkDescriptorType type : types)
      bindings.push_back({std::uint32_t(bindings.size()), type, 1, VK_SHADER_STAGE_ALL, nullptr});
    const VkDescriptorSetLayoutCreateInfo info = {VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                  nullptr, 0, std::uint32_t(bindings.size()),
                                                  bindings.data()};
    VkDescriptorSetLayout layout = nullptr;
    check(vkCreateDescriptorSetLayout(device, &info, nullptr, &layout), "vkCreateDescriptorSetLayout");
    return layout;
  }

  // Returns the layouts of the descriptor sets in vulkan_glsl.h, by set number.
  std::vector<VkDescriptorSetLayout> set_layouts(const std::vector<std::string>& samplers) const {
    std::vector<VkDescriptorType> sampler_types;
    for (const std::string& sampler : samplers) sampler_types.push_back(sampler_descriptor(sampler));
    return {set_layout(std::vector(storage_blocks, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER)),
            set_layout(sampler_types), set_layout({VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER}),
            set_layout(std::vector(images, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE))};
  }

  CompiledShader result(VkPipeline pipeline, VkShaderStageFlags stage) const;
  CompiledShader executable(const VkPipelineExecutableInfoKHR& which) const;
};

namespace {

struct Layout {
  Layout(VkDevice vulkan_device, std::vector<VkDescriptorSetLayout> layouts)
      : device(vulkan_device), sets(std::move(layouts)) {
    const VkPipelineLayoutCreateInfo info = {VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                             nullptr,
                                             0,
                                             std::uint32_t(sets.size()),
                                             sets.data(),
                                             0,
                                             nullptr};
    check(vkCreatePipelineLayout(device, &info, nullptr, &layout), "vkCreatePipelineLayout");
  }
  ~Layout() {
    vkDestroyPipelineLayout(device, layout, nullptr);
    for (const VkDescriptorSetLayout set : sets) vkDestroyDescriptorSetLayout(device, set, nullptr);
  }
  Layout(const Layout&) = delete;
  Layout& operator=(const Layout&) = delete;

  VkDevice device;
  std::vector<VkDescriptorSetLayout> sets;
  VkPipelineLayout layout = nullptr;
};

VkPipelineShaderStageCreateInfo stage_info(VkShaderStageFlagBits stage, VkShaderModule module) {
  return {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, stage, module, "main", nullptr};
}

constexpr VkPipelineCreateFlags capture = VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR |
                                          VK_PIPELINE_CREATE_CAPTURE_INTERNAL_REPRESENTATIONS_BIT_KHR;

VkRenderPass make_render_pass(VkDevice device, const std::vector<StageVariable>& targets) {
  std::vector<VkAttachmentDescription> attachments;
  std::vector<VkAttachmentReference> references;
  for (const StageVariable& target : targets) {
    VkAttachmentDescription attachment = {};
    attachment.format = target_format(target.type);
    attachment.samples = VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    references.push_back({std::uint32_t(attachments.size()), VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL});
    attachments.push_back(attachment);
  }
  VkSubpassDescription subpass = {};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = std::uint32_t(references.size());
  subpass.pColorAttachments = references.data();
  VkRenderPassCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
  info.attachmentCount = std::uint32_t(attachments.size());
  info.pAttachments = attachments.data();
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  VkRenderPass pass = nullptr;
  check(vkCreateRenderPass(device, &info, nullptr, &pass), "vkCreateRenderPass");
  return pass;
}

}  // namespace

NullDevice::NullDevice(const std::string& family) : vulkan_(std::make_unique<Vulkan>()) {
  choose_driver(family);
  VkApplicationInfo application = {};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.apiVersion = VK_API_VERSION_1_2;
  VkInstanceCreateInfo instance_info = {};
  instance_info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  instance_info.pApplicationInfo = &application;
  const std::string missing = "nook_gpu_cost: no RADV device of the family " + family +
                              " (need mesa-vulkan-drivers, and a family that it knows)";
  if (vkCreateInstance(&instance_info, nullptr, &vulkan_->instance) < 0) throw NoRadv(missing);
  std::uint32_t count = 1;
  const VkResult found = vkEnumeratePhysicalDevices(vulkan_->instance, &count, &vulkan_->physical);
  if (found < 0 || count == 0 || !driver().starts_with("radv")) {
    vkDestroyInstance(vulkan_->instance, nullptr);
    throw NoRadv(missing);
  }

  VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR executables = {};
  executables.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
  executables.pipelineExecutableInfo = VK_TRUE;
  VkPhysicalDeviceFeatures features = {};
  features.shaderStorageImageExtendedFormats = VK_TRUE;
  features.vertexPipelineStoresAndAtomics = VK_TRUE;
  const float priority = 1;
  VkDeviceQueueCreateInfo queue = {};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  const char* const extension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
  VkDeviceCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &executables;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = 1;
  info.ppEnabledExtensionNames = &extension;
  info.pEnabledFeatures = &features;
  check(vkCreateDevice(vulkan_->physical, &info, nullptr, &vulkan_->device), "vkCreateDevice");
  const auto load = [&](const char* name) { return vkGetDeviceProcAddr(vulkan_->device, name); };
  vulkan_->executable_properties = reinterpret_cast<PFN_vkGetPipelineExecutablePropertiesKHR>(
      load("vkGetPipelineExecutablePropertiesKHR"));
  vulkan_->executable_statistics = reinterpret_cast<PFN_vkGetPipelineExecutableStatisticsKHR>(
      load("vkGetPipelineExecutableStatisticsKHR"));
  vulkan_->executable_texts = reinterpret_cast<PFN_vkGetPipelineExecutableInternalRepresentationsKHR>(
      load("vkGetPipelineExecutableInternalRepresentationsKHR"));
}

NullDevice::~NullDevice() {
  if (vulkan_->device) vkDestroyDevice(vulkan_->device, nullptr);
  if (vulkan_->instance) vkDestroyInstance(vulkan_->instance, nullptr);
}

std::string NullDevice::driver() const {
  VkPhysicalDeviceDriverProperties driver = {};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 properties = {};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &driver;
  vkGetPhysicalDeviceProperties2(vulkan_->physical, &properties);
  return std::string(driver.driverName) + ", " + driver.driverInfo;
}

CompiledShader NullDevice::Vulkan::executable(const VkPipelineExecutableInfoKHR& which) const {
  std::uint32_t count = 0;
  check(executable_statistics(device, &which, &count, nullptr), "vkGetPipelineExecutableStatisticsKHR");
  std::vector<VkPipelineExecutableStatisticKHR> statistics(count);
  for (auto& statistic : statistics) statistic.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR;
  check(executable_statistics(device, &which, &count, statistics.data()),
        "vkGetPipelineExecutableStatisticsKHR");
  std::map<std::string, unsigned> numbers;
  for (const auto& statistic : statistics) numbers[statistic.name] = unsigned(statistic.value.u64);

  CompiledShader result;
  result.vector_registers = numbers.at("VGPRs");
  result.scalar_registers = numbers.at("SGPRs");
  result.waves = numbers.at("Subgroups per SIMD");
  result.code_bytes = numbers.at("Code size");

  count = 0;
  check(executable_texts(device, &which, &count, nullptr),
        "vkGetPipelineExecutableInternalRepresentationsKHR");
  std::vector<VkPipelineExecutableInternalRepresentationKHR> texts(count);
  for (auto& text : texts) text.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INTERNAL_REPRESENTATION_KHR;
  check(executable_texts(device, &which, &count, texts.data()),
        "vkGetPipelineExecutableInternalRepresentationsKHR");
  std::vector<std::string> contents(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    contents[i].resize(texts[i].dataSize);
    texts[i].pData = contents[i].data();
  }
  check(executable_texts(device, &which, &count, texts.data()),
        "vkGetPipelineExecutableInternalRepresentationsKHR");
  for (std::uint32_t i = 0; i < count; ++i)
    if (std::strstr(texts[i].name, "ssembly")) result.disassembly = contents[i].c_str();
  if (result.disassembly.empty())
    throw std::runtime_error("nook_gpu_cost: the driver does not provide a disassembly");
  return result;
}

CompiledShader NullDevice::Vulkan::result(VkPipeline pipeline, VkShaderStageFlags stage) const {
  const VkPipelineInfoKHR info = {VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR, nullptr, pipeline};
  std::uint32_t count = 0;
  check(executable_properties(device, &info, &count, nullptr), "vkGetPipelineExecutablePropertiesKHR");
  std::vector<VkPipelineExecutablePropertiesKHR> executables(count);
  for (auto& properties : executables)
    properties.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR;
  check(executable_properties(device, &info, &count, executables.data()),
        "vkGetPipelineExecutablePropertiesKHR");
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!(executables[i].stages & stage)) continue;
    if (executables[i].subgroupSize != wave_lanes)
      throw std::runtime_error("nook_gpu_cost: the compiler made waves of " +
                               std::to_string(executables[i].subgroupSize) + " lanes (need 64)");
    return executable({VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR, nullptr, pipeline, i});
  }
  throw std::runtime_error("nook_gpu_cost: the pipeline has no executable for the stage");
}

CompiledShader NullDevice::compute(const std::vector<std::uint32_t>& spirv,
                                   const std::vector<std::string>& samplers) {
  const Vulkan& vulkan = *vulkan_;
  const Layout layout(vulkan.device, vulkan.set_layouts(samplers));
  VkComputePipelineCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.flags = capture;
  info.layout = layout.layout;
  info.stage = stage_info(VK_SHADER_STAGE_COMPUTE_BIT, vulkan.module(spirv));
  VkPipeline pipeline = nullptr;
  check(vkCreateComputePipelines(vulkan.device, nullptr, 1, &info, nullptr, &pipeline),
        "vkCreateComputePipelines");
  CompiledShader result = vulkan.result(pipeline, VK_SHADER_STAGE_COMPUTE_BIT);
  vkDestroyPipeline(vulkan.device, pipeline, nullptr);
  vkDestroyShaderModule(vulkan.device, info.stage.module, nullptr);
  return result;
}

CompiledShader NullDevice::draw(const Draw& draw) {
  const Vulkan& vulkan = *vulkan_;
  const Layout layout(vulkan.device, vulkan.set_layouts(draw.samplers));
  const VkPipelineShaderStageCreateInfo stages[2] = {
      stage_info(VK_SHADER_STAGE_VERTEX_BIT, vulkan.module(draw.vertex)),
      stage_info(VK_SHADER_STAGE_FRAGMENT_BIT, vulkan.module(draw.fragment))};

  std::vector<VkVertexInputAttributeDescription> attributes;
  for (const StageVariable& attribute : draw.attributes)
    attributes.push_back({std::uint32_t(attributes.size()), 0, attribute_format(attribute.type),
                          std::uint32_t(16 * attributes.size())});
  const VkVertexInputBindingDescription binding = {0, std::uint32_t(16 * attributes.size()),
                                                   VK_VERTEX_INPUT_RATE_VERTEX};
  VkPipelineVertexInputStateCreateInfo input = {};
  input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  input.vertexBindingDescriptionCount = attributes.empty() ? 0 : 1;
  input.pVertexBindingDescriptions = &binding;
  input.vertexAttributeDescriptionCount = std::uint32_t(attributes.size());
  input.pVertexAttributeDescriptions = attributes.data();
  VkPipelineInputAssemblyStateCreateInfo assembly = {};
  assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  assembly.topology = draw.points ? VK_PRIMITIVE_TOPOLOGY_POINT_LIST : VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  const VkViewport viewport = {0, 0, 1920, 1080, 0, 1};
  const VkRect2D scissor = {{0, 0}, {1920, 1080}};
  VkPipelineViewportStateCreateInfo view = {};
  view.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
  view.viewportCount = view.scissorCount = 1;
  view.pViewports = &viewport;
  view.pScissors = &scissor;
  VkPipelineRasterizationStateCreateInfo raster = {};
  raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  raster.lineWidth = 1;
  VkPipelineMultisampleStateCreateInfo samples = {};
  samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  VkPipelineColorBlendAttachmentState whole = {};
  whole.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                         VK_COLOR_COMPONENT_A_BIT;
  const std::vector<VkPipelineColorBlendAttachmentState> written(draw.targets.size(), whole);
  VkPipelineColorBlendStateCreateInfo blend = {};
  blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  blend.attachmentCount = std::uint32_t(written.size());
  blend.pAttachments = written.data();
  VkGraphicsPipelineCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
  info.flags = capture;
  info.stageCount = 2;
  info.pStages = stages;
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &view;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pColorBlendState = &blend;
  info.layout = layout.layout;
  info.renderPass = make_render_pass(vulkan.device, draw.targets);
  VkPipeline pipeline = nullptr;
  check(vkCreateGraphicsPipelines(vulkan.device, nullptr, 1, &info, nullptr, &pipeline),
        "vkCreateGraphicsPipelines");
  CompiledShader result =
      vulkan.result(pipeline, draw.counts_vertex ? VK_SHADER_STAGE_VERTEX_BIT : VK_SHADER_STAGE_FRAGMENT_BIT);
  vkDestroyPipeline(vulkan.device, pipeline, nullptr);
  vkDestroyRenderPass(vulkan.device, info.renderPass, nullptr);
  for (const auto& stage : stages) vkDestroyShaderModule(vulkan.device, stage.module, nullptr);
  return result;
}

}  // namespace nook::lab
