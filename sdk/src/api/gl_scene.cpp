#include "api/entry.h"
#include "api/gl_handle.h"
#include "core/descriptors.h"

using namespace nook;

namespace {

constexpr std::size_t first_ao_view = offsetof(nook_gl_ao_view, count) + sizeof(std::uint32_t);

// Runs body on both objects, whose OpenGL context lives.
template <class Body>
nook_result with_scene(const char* function, nook_gl gl, nook_scene scene, Body&& body) noexcept {
  return api::enter(function, [&] {
    need(gl, "gl");
    need(scene, "scene");
    gl->device.need_alive();
    body();
  });
}

gl::SceneHandle handle_of(nook_scene scene) {
  return {Ref<const RefCounted>(Ref<nook_scene_s>::share(scene)), &scene->destroyed, &scene->scene};
}

}  // namespace

nook_result nook_gl_scene_prepare(nook_gl gl, nook_scene scene) {
  return with_scene("nook_gl_scene_prepare", gl, scene,
                    [&] { gl->guarded([&] { gl->characters->prepare(handle_of(scene)); }); });
}

nook_result nook_gl_scene_update(nook_gl gl, nook_scene scene) {
  return with_scene("nook_gl_scene_update", gl, scene,
                    [&] { gl->guarded([&] { gl->characters->update(handle_of(scene)); }); });
}

nook_result nook_gl_scene_ao_buffer(nook_gl gl, nook_scene scene, nook_instance_id instance,
                                    nook_gl_ao_view* view) {
  return with_scene("nook_gl_scene_ao_buffer", gl, scene, [&] {
    const gl::AoPlace place = gl->characters->ao_place(scene->scene, instance);
    nook_gl_ao_view known{};
    known.buffer = place.buffer;
    known.offset = place.offset;
    known.stride = sizeof(float);
    known.count = place.count;
    write_info(view, first_ao_view, known);
  });
}

nook_result nook_gl_scene_read_ao(nook_gl gl, nook_scene scene, nook_instance_id instance, float* out,
                                  uint32_t count) {
  return with_scene("nook_gl_scene_read_ao", gl, scene, [&] {
    need(out, "out");
    const gl::AoPlace place = gl->characters->ao_place(scene->scene, instance);
    if (count != place.count)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "count is not the model's file_vertex_count (got %u, need %u)", count, place.count);
    gl->guarded([&] {
      gl->device.report_host_errors();
      const gl::Functions& functions = gl->device.gl;
      functions.BindBuffer(GL_ARRAY_BUFFER, place.buffer);
      functions.GetBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(place.offset),
                                 static_cast<GLsizeiptr>(count * sizeof(float)), out);
      gl->device.check("reading AO");
    });
  });
}

nook_result nook_gl_scene_release(nook_gl gl, nook_scene scene) {
  return with_scene("nook_gl_scene_release", gl, scene, [&] { gl->characters->release(scene->scene); });
}
