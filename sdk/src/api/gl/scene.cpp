#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/handle.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/gl/character/light_texture.h"

using namespace nook;

namespace {

constexpr std::size_t first_ao_view = offsetof(nook_gl_ao_view, count) + sizeof(std::uint32_t);

constexpr std::size_t first_light_view = offsetof(nook_gl_light_view, glsl) + sizeof(const char*);

// `count` is the host's. Waits for the GPU.
void read_values(nook_gl_s& gl, const gl::VertexValues& values, std::uint32_t count, float* out) {
  if (count != values.vertices)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "count is not the model's file_vertex_count (got %u, need %u)",
                  count, values.vertices);
  gl.guarded([&] { gl.characters->read(values, out); });
}

// Runs body if both handles are valid and the OpenGL context is not lost.
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
    const gl::VertexValues ao = gl->characters->place(scene->scene, instance);
    nook_gl_ao_view known{};
    known.buffer = ao.buffer;
    known.offset = ao.offset;
    known.stride = sizeof(float);
    known.count = ao.vertices;
    write_info(view, first_ao_view, known);
  });
}

nook_result nook_gl_scene_read_ao(nook_gl gl, nook_scene scene, nook_instance_id instance, float* out,
                                  uint32_t count) {
  return with_scene("nook_gl_scene_read_ao", gl, scene, [&] {
    need(out, "out");
    read_values(*gl, gl->characters->place(scene->scene, instance), count, out);
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
    known.count = place.directional_ao.vertices;
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
    read_values(*gl, gl->characters->light_place(scene->scene, instance).directional_ao, count, out_rgb);
  });
}

nook_result nook_gl_scene_release(nook_gl gl, nook_scene scene) {
  return with_scene("nook_gl_scene_release", gl, scene, [&] { gl->characters->release(scene->scene); });
}
