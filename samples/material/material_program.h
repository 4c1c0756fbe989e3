// Shows how an engine uses a material: it inserts the material's GLSL into a program and binds the textures.
#pragma once

#include <glad/gl.h>

#include <glm/glm.hpp>
#include <nook/nook.hpp>
#include <vector>

#include "platform/program.h"
#include "samples/material/material_scene.h"

namespace material {

// The passes of a frame. Decoding costs much more than visibility. So the depth of the fully visible pixels
// is drawn first, and each of these pixels is then decoded only once.
enum class Pass {
  depth,         // the depth of fully visible pixels
  colour,        // the colour of the pixels that have that depth
  part_visible,  // the other pixels, blended by their alpha
  whole          // the colour and depth of every pixel, without the visibility of the meso-structure
};

class MaterialProgram {
 public:
  // `fetches` is the number of fetches along the longer side of a pixel; 0 uses the isotropic functions. The
  // material must outlive the program.
  MaterialProgram(const GladGLContext& gl, const nook::Upload& material, std::uint32_t fetches);

  // Binds the pass's program and the textures, and sets the OpenGL state that the pass needs.
  void begin(const View& view, Pass pass) const;

 private:
  bool samples_material(const platform::Program& program) const;

  const GladGLContext& gl_;
  const nook::Upload& material_;
  std::vector<platform::Program> programs_;  // one for each of the first three passes
};

}  // namespace material
