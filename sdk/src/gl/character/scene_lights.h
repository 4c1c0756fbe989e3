// The lights of a scene's instances in one texture buffer, for the passes of tier 43 and for the host's
// shaders.
#pragma once

#include "sdk/src/gl/character/scene_buffers.h"

namespace nook::gl {

// Makes the buffers of directional occlusion that instances with a light need. Throws Failure.
void make_light_buffers(Device& device, SceneBuffers& buffers, const Scene& scene);

// Before it is decided who is due: an instance that got a light since the last update is.
void notice_lights(SceneBuffers& buffers, const Scene& scene) noexcept;

// After that: sends all lights, and notes where each lies. Throws Failure if OpenGL gives no memory or a
// texture buffer of it cannot hold them.
void upload_lights(const Device& device, SceneBuffers& buffers, const Scene& scene);

// What hosts put into their shaders: shaders/character/host.glsl with all that it includes.
const char* scene_light_glsl();

}  // namespace nook::gl
