#include "samples/vulkan/engine_device.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char validation_layer[] = "VK_LAYER_KHRONOS_validation";

static VKAPI_ATTR VkBool32 VKAPI_CALL complain(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                               VkDebugUtilsMessageTypeFlagsEXT types,
                                               const VkDebugUtilsMessengerCallbackDataEXT* message,
                                               void* user) {
  (void)severity;
  (void)types;
  ++((engine*)user)->complaints;
  fprintf(stderr, "vulkan: %s\n", message->pMessage);
  return VK_FALSE;
}

static int has_validation(void) {
  VkLayerProperties* layers;
  uint32_t count = 0;
  int found = 0;
  if (vkEnumerateInstanceLayerProperties(&count, NULL) || count == 0) return 0;
  layers = calloc(count, sizeof *layers);
  if (layers && vkEnumerateInstanceLayerProperties(&count, layers) == VK_SUCCESS)
    for (uint32_t i = 0; i < count; ++i) found |= strcmp(layers[i].layerName, validation_layer) == 0;
  free(layers);
  return found;
}

static VkResult make_instance(engine* e) {
  const char* const layers[1] = {validation_layer};
  const char* const extensions[1] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
  const uint32_t validates = has_validation() ? 1 : 0;
  const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                         .pApplicationName = "Nook in Vulkan",
                                         .apiVersion = VK_API_VERSION_1_1};
  const VkDebugUtilsMessengerCreateInfoEXT messenger = {
      .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
      .messageSeverity =
          VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
      .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT, /* not its hints on performance */
      .pfnUserCallback = complain,
      .pUserData = e};
  const VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                     .pNext = validates ? &messenger : NULL,
                                     .pApplicationInfo = &application,
                                     .enabledLayerCount = validates,
                                     .ppEnabledLayerNames = layers,
                                     .enabledExtensionCount = validates,
                                     .ppEnabledExtensionNames = extensions};
  const VkResult r = vkCreateInstance(&info, NULL, &e->instance);
  if (r || !validates) return r;
  const PFN_vkCreateDebugUtilsMessengerEXT create = (PFN_vkCreateDebugUtilsMessengerEXT)vkGetInstanceProcAddr(
      e->instance, "vkCreateDebugUtilsMessengerEXT");
  return create ? create(e->instance, &messenger, NULL, &e->messenger) : VK_SUCCESS;
}

/* Returns the first queue family that can draw, or -1. */
static int drawing_family(VkPhysicalDevice physical) {
  VkQueueFamilyProperties families[16];
  uint32_t count = 16;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
  for (uint32_t i = 0; i < count; ++i)
    if (families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT) return (int)i;
  return -1;
}

static VkResult choose_device(engine* e, int* family) {
  VkPhysicalDevice devices[16];
  uint32_t count = 16;
  const VkResult r = vkEnumeratePhysicalDevices(e->instance, &count, devices);
  if (r < 0) return r;
  for (uint32_t i = 0; i < count; ++i) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(devices[i], &properties);
    *family = drawing_family(devices[i]);
    if (*family < 0 || properties.apiVersion < VK_API_VERSION_1_1) continue;
    e->physical = devices[i];
    memcpy(e->device_name, properties.deviceName, sizeof e->device_name);
    return VK_SUCCESS;
  }
  return VK_ERROR_INCOMPATIBLE_DRIVER;
}

VkResult engine_make_device(engine* e) {
  const float priority = 1;
  int family = -1;
  VkResult r = make_instance(e);
  if (!r) r = choose_device(e, &family);
  const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                         .queueFamilyIndex = (uint32_t)family,
                                         .queueCount = 1,
                                         .pQueuePriorities = &priority};
  const VkDeviceCreateInfo info = {
      .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, .queueCreateInfoCount = 1, .pQueueCreateInfos = &queue};
  if (!r) r = vkCreateDevice(e->physical, &info, NULL, &e->device);
  if (r) return r;
  vkGetDeviceQueue(e->device, queue.queueFamilyIndex, 0, &e->queue);
  const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                        .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                        .queueFamilyIndex = queue.queueFamilyIndex};
  r = vkCreateCommandPool(e->device, &pool, NULL, &e->pool);
  const VkCommandBufferAllocateInfo one = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                           .commandPool = e->pool,
                                           .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                           .commandBufferCount = 1};
  return r ? r : vkAllocateCommandBuffers(e->device, &one, &e->commands);
}

void engine_destroy_device(engine* e) {
  if (e->device) {
    vkDestroyCommandPool(e->device, e->pool, NULL);
    vkDestroyDevice(e->device, NULL);
  }
  if (e->messenger) {
    const PFN_vkDestroyDebugUtilsMessengerEXT destroy =
        (PFN_vkDestroyDebugUtilsMessengerEXT)vkGetInstanceProcAddr(e->instance,
                                                                   "vkDestroyDebugUtilsMessengerEXT");
    if (destroy) destroy(e->instance, e->messenger, NULL);
  }
  if (e->instance) vkDestroyInstance(e->instance, NULL);
}

VkResult engine_allocate(engine* e, const VkMemoryRequirements* needs, VkMemoryPropertyFlags properties,
                         VkDeviceMemory* out) {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(e->physical, &memory);
  for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
    const VkMemoryAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needs->size, .memoryTypeIndex = i};
    if ((needs->memoryTypeBits >> i & 1) && (memory.memoryTypes[i].propertyFlags & properties) == properties)
      return vkAllocateMemory(e->device, &info, NULL, out);
  }
  return VK_ERROR_OUT_OF_DEVICE_MEMORY;
}

VkResult engine_begin(engine* e) {
  const VkCommandBufferBeginInfo info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                         .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
  return vkBeginCommandBuffer(e->commands, &info);
}

VkResult engine_finish(engine* e) {
  const VkSubmitInfo info = {
      .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &e->commands};
  VkResult r = vkEndCommandBuffer(e->commands);
  if (!r) r = vkQueueSubmit(e->queue, 1, &info, VK_NULL_HANDLE);
  return r ? r : vkQueueWaitIdle(e->queue);
}
