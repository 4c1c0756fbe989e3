// The C functions of nook_streaming.h.
#include <nook/experimental/nook_streaming.h>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/gl/scene_handle.h"
#include "sdk/src/character/scene_pool.h"
#include "sdk/src/core/checks.h"

using namespace nook;

nook_result nook_gl_scene_set_streaming(nook_gl gl, nook_scene scene, const nook_gl_stream_desc* desc) {
  return api::with_gl_scene("nook_gl_scene_set_streaming", gl, scene, [&] {
    need(desc, "desc");
    if (desc->struct_size < sizeof *desc)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.struct_size is too small (got %u, need at least %zu); set it to sizeof",
                    desc->struct_size, sizeof *desc);
    check_at_most("desc.fade_updates", desc->fade_updates, gl::max_fade_updates);
    check_at_most("desc.instance_count", desc->instance_count, max_slots);
    need_no_pool(scene->scene, "streaming mode needs a scene without a pool");
    scene->scene.instances.reserve(desc->instance_count);
    gl->guarded([&] { gl->characters->set_streaming(api::handle_of(scene), desc->fade_updates); });
  });
}

nook_result nook_gl_scene_prepare_within(nook_gl gl, nook_scene scene, uint32_t budget_us,
                                         nook_gl_stream_info* info) {
  return api::with_gl_scene("nook_gl_scene_prepare_within", gl, scene, [&] {
    const gl::Budget budget(budget_us);
    if (!gl->characters->is_streaming(scene->scene))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "the scene is not in streaming mode with this nook_gl; first call "
                    "nook_gl_scene_set_streaming, or call nook_gl_scene_prepare");
    nook_gl_stream_info known{};
    gl::StreamLeft left;
    gl->guarded([&] { left = gl->characters->prepare_within(api::handle_of(scene), budget); });
    known.pending_count = left.pending;
    // A view that ended with this call must be asked for again before the next update.
    if (left.has_new_views) ++scene->scene.pool.generation;
    known.generation = scene->scene.pool.generation;
    if (info) write_info(info, known);
  });
}
