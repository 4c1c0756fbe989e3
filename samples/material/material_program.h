// What an engine does with a material: its GLSL in a program, its textures on units.
#pragma once

#include <glad/gl.h>

#include <glm/glm.hpp>
#include <nook/nook.hpp>
#include <vector>

#include "scene.h"

namespace material {

enum class Pass : int {
  whole = 0,        // every pixel, without the visibility of the meso-structure
  visible = 1,      // fully visible pixels
  part_visible = 2  // the others, by alpha
};

class MaterialProgram {
 public:
  MaterialProgram(const GladGLContext& gl, const nook::GlMaterial& material);
  ~MaterialProgram();
  MaterialProgram(const MaterialProgram&) = delete;
  MaterialProgram& operator=(const MaterialProgram&) = delete;

  // Binds the program and the textures, and sets what a pass needs of OpenGL's state.
  void begin(const View& view, Pass pass) const;

 private:
  GLint uniform(const char* name) const { return gl_.GetUniformLocation(program_, name); }

  const GladGLContext& gl_;
  std::vector<nook_gl_material_texture> textures_;
  GLuint program_ = 0;
};

}  // namespace material
