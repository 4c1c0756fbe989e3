#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/scene_handle.h"
#include "sdk/src/api/pose_log.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/gl/character/light_texture.h"

using namespace nook;

namespace {

gl::VertexValues place_of(nook_gl_s& gl, nook_scene_s& scene, nook_instance_id instance,
                          nook_channel channel) {
  switch (channel) {
    case NOOK_CHANNEL_AO:
      return gl.characters->place(scene.scene, instance);
    case NOOK_CHANNEL_DIRECTIONAL_AO:
      return gl.characters->light_place(scene.scene, instance).directional_ao;
    default:
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "channel is not available on the GPU (got %d, need %d or %d); read the other channels "
                    "with nook_scene_read",
                    channel, NOOK_CHANNEL_AO, NOOK_CHANNEL_DIRECTIONAL_AO);
  }
}

void check_target(const nook_gl_ao_target& target, std::uint32_t count) {
  constexpr std::size_t size = offsetof(nook_gl_ao_target, texture_width) + sizeof(std::uint32_t);
  if (target.struct_size < size)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "target.struct_size is too small (got %u, need at least %zu); set it to sizeof",
                  target.struct_size, size);
  check_known("target.format", target.format, NOOK_FORMAT_UNORM8);
  if ((target.buffer == 0) == (target.texture == 0))
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "target.buffer and target.texture are %u and %u; set exactly one of them, and leave the other 0",
        target.buffer, target.texture);
  // Upper limit for offsets. It is larger than any buffer, but so small that sums of offsets do not overflow
  // 64 bits.
  constexpr std::uint64_t max_offset = std::uint64_t{1} << 40;
  if (target.offset > max_offset || target.instance_stride > max_offset || count > (1u << 20))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "target.offset, target.instance_stride or count is out of range (got %llu, %llu and %u, "
                  "need at most 2^40 bytes, 2^40 bytes and 1048576 instances)",
                  static_cast<unsigned long long>(target.offset),
                  static_cast<unsigned long long>(target.instance_stride), count);
  const bool in_buffer = target.buffer != 0;
  if (in_buffer && (target.offset % 4 || target.instance_stride % 4 || target.stride % 4))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "target.offset, target.instance_stride and target.stride are %llu, %llu and %u; a buffer "
                  "needs multiples of 4",
                  static_cast<unsigned long long>(target.offset),
                  static_cast<unsigned long long>(target.instance_stride), target.stride);
  if (in_buffer ? target.texture_width != 0 : target.stride != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "target.stride must be 0 for a texture, and target.texture_width must be 0 for a buffer "
                  "(got %u and %u)",
                  target.stride, target.texture_width);
  if (count > 1 && target.instance_stride == 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "target.instance_stride is 0, but there are %u instances; set it to the distance from one "
                  "instance to the next",
                  count);
}

}  // namespace

nook_result nook_gl_model_memory(nook_gl gl, nook_model model, nook_gl_memory* memory) {
  return api::enter("nook_gl_model_memory", [&] {
    need(gl, "gl");
    need(model, "model");
    const gl::ModelMemory bytes = gl->characters->memory_of(*model);
    nook_gl_memory known{};
    known.model_bytes = bytes.shared;
    known.instance_bytes = bytes.instance;
    known.lit_instance_bytes = bytes.instance + bytes.light;
    write_info(memory, known);
  });
}

nook_result nook_gl_scene_prepare(nook_gl gl, nook_scene scene) {
  return api::with_gl_scene("nook_gl_scene_prepare", gl, scene,
                            [&] { gl->guarded([&] { gl->characters->prepare(api::handle_of(scene)); }); });
}

nook_result nook_gl_scene_update(nook_gl gl, nook_scene scene) {
  return api::with_gl_scene("nook_gl_scene_update", gl, scene, [&] {
    gl->guarded([&] { gl->characters->update(api::handle_of(scene)); });
    api::log_bodies(*scene);
  });
}

nook_result nook_gl_scene_view(nook_gl gl, nook_scene scene, nook_instance_id instance, nook_channel channel,
                               nook_gl_view* view) {
  return api::with_gl_scene("nook_gl_scene_view", gl, scene, [&] {
    nook_gl_view known{};
    const gl::VertexValues values = place_of(*gl, *scene, instance, channel);
    known.buffer = values.buffer;
    known.offset = values.offset;
    known.stride = values.channels * sizeof(float);
    known.count = values.vertices;
    known.glsl = gl::scene_light_glsl();
    if (channel == NOOK_CHANNEL_DIRECTIONAL_AO) {
      const gl::LightPlace place = gl->characters->light_place(scene->scene, instance);
      known.texture = place.texture;
      known.light = static_cast<std::int32_t>(place.first_texel);
    }
    write_info(view, known);
  });
}

nook_result nook_gl_scene_read(nook_gl gl, nook_scene scene, nook_instance_id instance, nook_channel channel,
                               float* out, uint32_t count) {
  return api::with_gl_scene("nook_gl_scene_read", gl, scene, [&] {
    need(out, "out");
    const gl::VertexValues values = place_of(*gl, *scene, instance, channel);
    if (count != values.vertices)
      throw Failure(
          NOOK_ERROR_INVALID_ARGUMENT,
          "count is not the model's file_vertex_count (got %u, need %u); if your mesh has %u "
          "vertices, the model was baked for another mesh: load the model of this mesh, or match the "
          "vertices with nook_model_match_vertices",
          count, values.vertices, count);
    gl->guarded([&] { gl->characters->read(values, out); });
  });
}

nook_result nook_gl_scene_write(nook_gl gl, nook_scene scene, const nook_instance_id* instances,
                                uint32_t count, const nook_gl_ao_target* target) {
  return api::with_gl_scene("nook_gl_scene_write", gl, scene, [&] {
    need(instances, "instances");
    need(target, "target");
    check_target(*target, count);
    // Looks up all instances before it writes anything. So if an id is invalid, nothing is changed.
    for (uint32_t i = 0; i < count; ++i) gl->characters->place(scene->scene, instances[i]);
    gl->guarded(gl::output_users(gl->device.gl), [&] {
      for (uint32_t i = 0; i < count; ++i) {
        const gl::VertexValues values = gl->characters->place(scene->scene, instances[i]);
        const uint64_t offset = target->offset + i * target->instance_stride;
        if (target->buffer)
          gl->characters->output().write(
              values, gl::BufferTarget{target->buffer, offset, target->stride, target->format});
        else
          gl->characters->output().write(
              values, gl::TextureTarget{target->texture, offset, target->texture_width, target->format});
      }
    });
  });
}

nook_result nook_gl_scene_release(nook_gl gl, nook_scene scene) {
  return api::with_gl_scene("nook_gl_scene_release", gl, scene,
                            [&] { gl->characters->release(scene->scene); });
}
