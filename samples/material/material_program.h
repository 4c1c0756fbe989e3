// What an engine does with a material: its GLSL in a program, its textures on units.
#pragma once

#include <glad/gl.h>

#include <glm/glm.hpp>
#include <nook/nook.hpp>
#include <vector>

#include "samples/material/scene.h"

namespace material {

// Decoding costs many times what the visibility costs, so the depth of the fully visible pixels comes first,
// and each is decoded once.
enum class Pass {
  depth,         // of fully visible pixels
  colour,        // where that depth is
  part_visible,  // the other pixels, blended by alpha
  whole          // colour and depth of every pixel, without the visibility of the meso-structure
};

class MaterialProgram {
 public:
  MaterialProgram(const GladGLContext& gl, const nook::GlMaterial& material);
  ~MaterialProgram();
  MaterialProgram(const MaterialProgram&) = delete;
  MaterialProgram& operator=(const MaterialProgram&) = delete;

  // Binds the pass's program and the textures, and sets what a pass needs of OpenGL's state.
  void begin(const View& view, Pass pass) const;

 private:
  const GladGLContext& gl_;
  std::vector<nook_gl_material_texture> textures_;
  GLuint programs_[3] = {};  // of the first three passes
};

}  // namespace material
