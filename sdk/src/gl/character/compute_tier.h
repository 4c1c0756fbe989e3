// OpenGL 4.3: spheres, shadows and vertices of a scene in compute shaders.
#pragma once

#include "gl/character/scene_buffers.h"

namespace nook::gl {

class ComputeTier {
 public:
  explicit ComputeTier(Device& device);

  // Compiles what the models of the scene need; nothing the second time. Throws Failure.
  void prepare(const ModelList& models);
  // An update of the scene, whose buffers are prepared. Throws Failure if OpenGL gives no memory.
  void update(SceneBuffers& buffers, Scene& scene) const;

 private:
  void run_spheres(const SceneBuffers& buffers) const;
  void run_shadows(const SceneBuffers& buffers, const Scene& scene) const;
  void run_spread(const SceneBuffers& buffers, const Scene& scene) const;
  void run_vertices(const SceneBuffers& buffers, const Scene& scene) const;

  Device& device_;
  Object spheres_;
  Object shadows_[kernel_form_count];  // name 0 until a model needs it
  Object spread_;                      // name 0 until a model has levels of detail
  Object vertices_;
};

}  // namespace nook::gl
