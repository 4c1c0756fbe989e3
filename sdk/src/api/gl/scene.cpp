#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/handle.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/gl/character/scene_lights.h"

using namespace nook;

namespace {

constexpr std::size_t first_ao_view = offsetof(nook_gl_ao_view, count) + sizeof(std::uint32_t);

constexpr std::size_t first_light_view = offsetof(nook_gl_light_view, glsl) + sizeof(const char*);

// Copies `count` vertices of `channels` floats each from a buffer. Waits for the GPU.
void read_values(nook_gl_s& gl, const gl::AoPlace& place, std::uint32_t count, std::uint32_t channels,
                 float* out, const char* what) {
  if (count != place.count)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "count is not the model's file_vertex_count (got %u, need %u)",
                  count, place.count);
  gl.guarded([&] {
    gl.device.report_host_errors();
    const gl::Functions& functions = gl.device.gl;
    functions.BindBuffer(GL_ARRAY_BUFFER, place.buffer);
    functions.GetBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(place.offset),
                               static_cast<GLsizeiptr>(std::uint64_t{count} * channels * sizeof(float)), out);
    gl.device.check(what);
  });
}

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
    read_values(*gl, gl->characters->ao_place(scene->scene, instance), count, 1, out, "reading AO");
  });
}

nook_result nook_gl_scene_light(nook_gl gl, nook_scene scene, nook_instance_id instance,
                                nook_gl_light_view* view) {
  return with_scene("nook_gl_scene_light", gl, scene, [&] {
    const gl::LightPlace place = gl->characters->light_place(scene->scene, instance);
    nook_gl_light_view known{};
    known.buffer = place.directional_ao.buffer;
    known.offset = place.directional_ao.offset;
    known.stride = 3 * sizeof(float);
    known.count = place.directional_ao.count;
    known.texture = place.texture;
    known.light = static_cast<std::int32_t>(place.first_texel);
    known.glsl = gl::scene_light_glsl();
    write_info(view, first_light_view, known);
  });
}

nook_result nook_gl_scene_read_directional_ao(nook_gl gl, nook_scene scene, nook_instance_id instance,
                                              float* out_rgb, uint32_t count) {
  return with_scene("nook_gl_scene_read_directional_ao", gl, scene, [&] {
    need(out_rgb, "out_rgb");
    read_values(*gl, gl->characters->light_place(scene->scene, instance).directional_ao, count, 3, out_rgb,
                "reading directional AO");
  });
}

nook_result nook_gl_scene_release(nook_gl gl, nook_scene scene) {
  return with_scene("nook_gl_scene_release", gl, scene, [&] { gl->characters->release(scene->scene); });
}
