/* The engine's instance, device, memory and command buffer. */
#ifndef ENGINE_DEVICE_H
#define ENGINE_DEVICE_H

#include "samples/vulkan/engine.h"

/* Takes the first device with Vulkan 1.1 and a queue that draws. */
VkResult engine_make_device(engine* e);
void engine_destroy_device(engine* e);

/* Allocates memory that has all of these properties. */
VkResult engine_allocate(engine* e, const VkMemoryRequirements* needs, VkMemoryPropertyFlags properties,
                         VkDeviceMemory* out);

#endif
