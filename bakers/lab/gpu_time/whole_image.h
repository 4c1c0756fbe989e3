// Runs a fragment shader over the whole image, to time functions that hosts call in their own shaders.
#pragma once

#include <glad/gl.h>

#include <string>

#include "bakers/measure/nnao/gpu_image.h"

namespace nook::lab {

class WholeImage {
 public:
  // `functions` is GLSL of the library. `body` is the body of main(), which must set `vec3 colour`. In it,
  // `vec2 at` is the position in the image, 0 to 1.
  WholeImage(const GladGLContext& gl, int width, int height, const std::string& functions,
             const std::string& body);
  ~WholeImage();
  WholeImage(const WholeImage&) = delete;
  WholeImage& operator=(const WholeImage&) = delete;

  // Binds a texture to its own unit. `target` is a texture target such as GL_TEXTURE_BUFFER.
  void bind(GLenum target, GLuint texture, const char* uniform);
  void draw() const;

 private:
  const GladGLContext& gl_;
  int width_, height_;
  measure::GpuImage target_;
  GLuint program_ = 0, vertex_array_ = 0;
  GLint units_ = 0;
};

}  // namespace nook::lab
