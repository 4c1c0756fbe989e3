// OpenGL 4.3: spheres, shadows and vertices of a scene in compute shaders.
#pragma once

#include "sdk/src/gl/character/scene_buffers.h"

namespace nook::gl {

class ComputeTier {
 public:
  explicit ComputeTier(Device& device);

  // Compiles what the models and lights of the scene need; nothing the second time. Throws Failure.
  void prepare(const ModelList& models, const SceneBuffers& buffers);
  // An update of the scene, whose buffers are prepared. Throws Failure if OpenGL gives no memory.
  void update(SceneBuffers& buffers, Scene& scene) const;

 private:
  void run_spheres(const SceneBuffers& buffers) const;
  void run_key_points(const SceneBuffers& buffers, const Scene& scene, const Chunk& chunk) const;
  void spread_levels(const SceneBuffers& buffers, const Chunk& chunk) const;
  void blend_vertices(const SceneBuffers& buffers, const Scene& scene, const Chunk& chunk,
                      const Buffer& out) const;
  void run_shadows(const SceneBuffers& buffers, const Scene& scene) const;
  void run_spread(const SceneBuffers& buffers, const Scene& scene) const;
  void run_vertices(const SceneBuffers& buffers, const Scene& scene) const;
  // The same for instances with a light.
  void run_colours(const SceneBuffers& buffers, const Scene& scene) const;
  void run_colours_spread(const SceneBuffers& buffers) const;
  void run_lit_vertices(const SceneBuffers& buffers, const Scene& scene) const;

  Device& device_;
  Object spheres_;
  Object shadows_[kernel_form_count];  // name 0 until a model needs it
  Object spread_;                      // name 0 until a model has levels of detail
  Object vertices_;
  Object colours_[kernel_form_count];  // these: name 0 until an instance has a light
  Object colours_spread_;
  Object lit_vertices_;
};

}  // namespace nook::gl
