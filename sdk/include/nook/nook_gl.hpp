// C++17 wrappers of nook_gl.h: characters on the GPU, and uploads of probes, materials and clips. Call every
// function and every destructor on the context thread.
#ifndef NOOK_GL_HPP
#define NOOK_GL_HPP

#include <cstdint>
#include <vector>

#include "experimental/nook_debug.h"
#include "nook_character.hpp"
#include "nook_clips.hpp"
#include "nook_gl.h"
#include "nook_material.hpp"
#include "nook_probe.hpp"

namespace nook {
inline namespace wrapper {

// You must set get_proc.
inline nook_gl_desc gl_desc() {
  nook_gl_desc desc;
  check(nook_gl_desc_init(&desc));
  return desc;
}

// You must set the size, the depth texture and the projection. If the camera moves, also set the view.
inline nook_gl_frame_desc gl_frame_desc() {
  nook_gl_frame_desc desc;
  check(nook_gl_frame_desc_init(&desc));
  return desc;
}

// Call every function and the destructor on the context thread, as nook_gl.h documents.
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
  // Evaluates the scene on the GPU. Call it instead of scene.update().
  void update(Scene& scene) { check(nook_gl_scene_update(get(), scene.get())); }
  nook_gl_view view(const Scene& scene, nook_instance_id id, nook_channel channel = NOOK_CHANNEL_AO) const {
    nook_gl_view view{};
    view.struct_size = sizeof view;
    check(nook_gl_scene_view(get(), scene.get(), id, channel, &view));
    return view;
  }
  // Copies AO to your own buffer or texture on the GPU. This function sets target.struct_size.
  void write_ao(const Scene& scene, const std::vector<nook_instance_id>& ids,
                nook_gl_ao_target target) const {
    target.struct_size = sizeof target;
    check(
        nook_gl_scene_write(get(), scene.get(), ids.data(), static_cast<std::uint32_t>(ids.size()), &target));
  }
  // Copies the values of an instance to `out`. Waits for the GPU.
  void read(const Scene& scene, nook_instance_id id, nook_channel channel, float* out,
            std::uint32_t count) const {
    check(nook_gl_scene_read(get(), scene.get(), id, channel, out, count));
  }
  void release(const Scene& scene) { check(nook_gl_scene_release(get(), scene.get())); }

 private:
  static nook_gl create(const Context& context, const nook_gl_desc& desc) {
    nook_gl handle = nullptr;
    check(nook_gl_create(context.get(), &desc, &handle));
    return handle;
  }
};

// Holds a probe, a grid, a material or clips in textures, and the GLSL that reads the textures. Call every
// function and the destructor on the context thread, as nook_gl.h documents.
class Upload : public Unique<nook_gl_upload, nook_gl_upload_destroy> {
 public:
  Upload() = default;
  // Takes ownership of a handle, such as one that you got from a function of an experimental header.
  explicit Upload(nook_gl_upload handle) : Unique(handle) {}
  Upload(const Gl& gl, nook_probe probe, nook_gl_probe_form form) : Unique(create(gl, probe, form)) {}
  Upload(const Gl& gl, const Material& material) : Unique(create(gl, material)) {}

  Upload(const Gl& gl, const Clips& clips) : Unique(create(gl, clips)) {}

  // Replaces the probe. The upload must hold a probe or a grid.
  void update(nook_probe probe) { check(nook_gl_update_probe(get(), probe)); }
  nook_gl_upload_info info() const {
    nook_gl_upload_info info{};
    info.struct_size = sizeof info;
    check(nook_gl_upload_describe(get(), &info));
    return info;
  }
  // After the call, the program is in use and the textures are bound.
  void bind(std::uint32_t program, std::uint32_t first_unit) const {
    check(nook_gl_upload_bind(get(), program, first_unit));
  }

 private:
  static nook_gl_upload create(const Gl& gl, nook_probe probe, nook_gl_probe_form form) {
    nook_gl_upload handle = nullptr;
    check(nook_gl_upload_probe(gl.get(), probe, form, &handle));
    return handle;
  }
  static nook_gl_upload create(const Gl& gl, const Material& material) {
    nook_gl_upload handle = nullptr;
    check(nook_gl_upload_material(gl.get(), material.get(), &handle));
    return handle;
  }
  static nook_gl_upload create(const Gl& gl, const Clips& clips) {
    nook_gl_upload handle = nullptr;
    check(nook_gl_upload_clips(gl.get(), clips.get(), &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
