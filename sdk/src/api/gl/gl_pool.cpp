// The pool functions of nook_gl_poses.h.
#include <nook/experimental/nook_gl_poses.h>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/scene_handle.h"
#include "sdk/src/character/scene_pool.h"
#include "sdk/src/core/checks.h"

using namespace nook;

namespace {

nook_gl_pool_view view_of(const gl::PooledView& view) {
  return {view.values.offset, view.values.buffer, view.values.vertices, view.generation,
          view.is_near ? 1u : 0u};
}

void need_pool(const Scene& scene, bool has_views = false) {
  if (!scene.pool.is_used() && !has_views)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the scene has no pool; call nook_gl_scene_set_pool first, or nook_gl_scene_view");
}

}  // namespace

nook_result nook_gl_scene_set_pool(nook_gl gl, nook_scene scene, const nook_gl_pool_desc* desc) {
  return api::with_gl_scene("nook_gl_scene_set_pool", gl, scene, [&] {
    need(desc, "desc");
    if (desc->struct_size < sizeof *desc)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.struct_size is too small (got %u, need at least %zu); set it to sizeof",
                    desc->struct_size, sizeof *desc);
    check_fits("desc.places", desc->places, desc->places >= 1 && desc->places <= max_slots,
               "1 to 1,048,575 places");
    check_fits("desc.distance", desc->distance, desc->distance > 0 && desc->distance <= 1e9f,
               "finite metres above 0");
    check_at_most("desc.instance_count", desc->instance_count, max_slots);
    if (!gl->device.gl.can.compute)
      throw Failure(NOOK_ERROR_UNSUPPORTED,
                    "a pool needs compute shaders (OpenGL 4.3 or OpenGL ES 3.1), which this context does not "
                    "have; use a scene without a pool");
    if (gl->characters->is_streaming(scene->scene))
      throw Failure(
          NOOK_ERROR_UNSUPPORTED,
          "the scene is in streaming mode (nook_gl_scene_set_streaming), which needs a scene without "
          "a pool; use one of them");
    set_pool(scene->scene, desc->places, desc->distance, desc->instance_count);
  });
}

nook_result nook_gl_scene_read_pool(nook_gl gl, nook_scene scene, const nook_instance_id* instances,
                                    uint32_t count, nook_gl_pool_view* views, nook_gl_pool_info* info) {
  return api::with_gl_scene("nook_gl_scene_read_pool", gl, scene, [&] {
    need_pool(scene->scene, gl->characters->is_streaming(scene->scene));
    if (count > 0) {
      need(instances, "instances");
      need(views, "views");
    }
    // Looks up all instances before it writes anything. So if an id is invalid, nothing is changed.
    for (uint32_t i = 0; i < count; ++i) gl->characters->pooled_view(scene->scene, instances[i]);
    if (info) {
      const gl::PoolCount known = gl->characters->pool_count(scene->scene);
      write_info(info, nook_gl_pool_info{0, known.near, known.waiting});
    }
    for (uint32_t i = 0; i < count; ++i)
      views[i] = view_of(gl->characters->pooled_view(scene->scene, instances[i]));
  });
}

nook_result nook_gl_scene_read_pool_table(nook_gl gl, nook_scene scene, nook_model model,
                                          nook_gl_pool_table* table, uint32_t* ao_buffers,
                                          uint32_t capacity) {
  return api::with_gl_scene("nook_gl_scene_read_pool_table", gl, scene, [&] {
    need(model, "model");
    need(table, "table");
    if (capacity > 0) need(ao_buffers, "ao_buffers");
    need_pool(scene->scene);
    gl->guarded([&] {
      const gl::PoolTablePlace place =
          gl->characters->pool_table(api::handle_of(scene), *model, {ao_buffers, capacity});
      write_info(table, nook_gl_pool_table{0, place.buffer, place.entries, place.ao_buffers});
    });
  });
}
