// Helpers that the C functions for scenes on the GPU share.
#pragma once

#include <utility>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/handle.h"
#include "sdk/src/core/descriptors.h"

namespace nook::api {

// Runs `body` if both handles are valid and the OpenGL context is not lost. Otherwise throws Failure.
template <class Body>
nook_result with_gl_scene(const char* function, nook_gl gl, nook_scene scene, Body&& body) noexcept {
  return enter(function, [&] {
    need(gl, "gl");
    need(scene, "scene");
    gl->device.need_alive();
    std::forward<Body>(body)();
  });
}

inline gl::SceneHandle handle_of(nook_scene scene) {
  return {Ref<const RefCounted>(Ref<nook_scene_s>::share(scene)), &scene->destroyed, &scene->scene};
}

}  // namespace nook::api
