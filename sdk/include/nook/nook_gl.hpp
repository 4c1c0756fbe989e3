// C++17 wrappers of the OpenGL objects of characters: nook_gl.h. Every function and every destructor belongs
// to the context thread.
#ifndef NOOK_GL_HPP
#define NOOK_GL_HPP

#include <cstdint>
#include <vector>

#include "nook_character.hpp"
#include "nook_gl.h"

namespace nook {
inline namespace wrapper {

// The caller sets get_proc.
inline nook_gl_desc gl_desc() {
  nook_gl_desc desc;
  check(nook_gl_desc_init(&desc, sizeof desc, NOOK_VERSION));
  return desc;
}

// Every function and the destructor belong to the context thread, as nook_gl.h documents.
class Gl : public Unique<nook_gl, nook_gl_destroy> {
 public:
  Gl() = default;
  Gl(const Context& context, const nook_gl_desc& desc) : Unique(create(context, desc)) {}

  void context_lost() { check(nook_gl_context_lost(get())); }
  nook_gl_info info() const {
    nook_gl_info info{};
    info.struct_size = sizeof info;
    check(nook_gl_describe(get(), &info));
    return info;
  }
  nook_gl_memory memory_of(const CharacterModel& model) const {
    nook_gl_memory memory{};
    memory.struct_size = sizeof memory;
    check(nook_gl_model_memory(get(), model.get(), &memory));
    return memory;
  }
  void prepare(const Scene& scene) { check(nook_gl_scene_prepare(get(), scene.get())); }
  // Replaces scene.update().
  void update(Scene& scene) { check(nook_gl_scene_update(get(), scene.get())); }
  nook_gl_ao_view ao_buffer(const Scene& scene, nook_instance_id id) const {
    nook_gl_ao_view view{};
    view.struct_size = sizeof view;
    check(nook_gl_scene_ao_buffer(get(), scene.get(), id, &view));
    return view;
  }
  // Copies AO to a buffer or texture of the host on the GPU; struct_size of the target is set here.
  void write_ao(const Scene& scene, const std::vector<nook_instance_id>& ids,
                nook_gl_ao_target target) const {
    target.struct_size = sizeof target;
    check(nook_gl_scene_write_ao(get(), scene.get(), ids.data(), static_cast<std::uint32_t>(ids.size()),
                                 &target));
  }
  // Waits for the GPU.
  void read_ao(const Scene& scene, nook_instance_id id, float* out, std::uint32_t count) const {
    check(nook_gl_scene_read_ao(get(), scene.get(), id, out, count));
  }
  nook_gl_light_view light(const Scene& scene, nook_instance_id id) const {
    nook_gl_light_view view{};
    view.struct_size = sizeof view;
    check(nook_gl_scene_light(get(), scene.get(), id, &view));
    return view;
  }
  // Writes three floats for each vertex; waits for the GPU.
  void read_directional_ao(const Scene& scene, nook_instance_id id, float* out_rgb,
                           std::uint32_t count) const {
    check(nook_gl_scene_read_directional_ao(get(), scene.get(), id, out_rgb, count));
  }
  void release(const Scene& scene) { check(nook_gl_scene_release(get(), scene.get())); }

 private:
  static nook_gl create(const Context& context, const nook_gl_desc& desc) {
    nook_gl handle = nullptr;
    check(nook_gl_create(context.get(), &desc, &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
