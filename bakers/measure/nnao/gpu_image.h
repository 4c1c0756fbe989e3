// OpenGL objects for methods that draw: images that can be drawn into and read back, and programs that run
// over a whole image.
#pragma once

#include <glad/gl.h>

#include <span>
#include <string>
#include <vector>

#include "bakers/nnao/cameras.h"

namespace nook::measure {

class GpuImage {
 public:
  // `data` may be null. Rows start at the bottom.
  GpuImage(const GladGLContext& gl, GLint internal_format, GLenum format, int width, int height,
           const float* data);
  ~GpuImage();
  GpuImage(const GpuImage&) = delete;
  GpuImage& operator=(const GpuImage&) = delete;

  GLuint texture() const { return texture_; }
  GLuint framebuffer() const { return framebuffer_; }

 private:
  const GladGLContext& gl_;
  GLuint texture_ = 0, framebuffer_ = 0;
};

// Returns the red channel of level 0.
std::vector<float> read_red(const GladGLContext& gl, GLuint texture, int width, int height);

// Returns all four channels of level 0.
std::vector<float> read_rgba(const GladGLContext& gl, GLuint texture, int width, int height);

// A shader file of a folder. Its includes are expanded at build time.
struct EmbeddedShader {
  const char* path;  // relative to the folder
  const char* text;
};
using ShaderTable = std::span<const EmbeddedShader>;

// The shaders of bakers/measure/nnao/shaders.
const EmbeddedShader* embedded_shaders_begin();
const EmbeddedShader* embedded_shaders_end();
inline ShaderTable embedded_shaders() {
  return {embedded_shaders_begin(), embedded_shaders_end()};
}

class GpuProgram {
 public:
  // `path` is the path of a fragment shader in the table `shaders`. `defines` contains lines that are
  // inserted before the shader's text. Throws std::runtime_error with the compiler's message.
  GpuProgram(const GladGLContext& gl, ShaderTable shaders, const std::string& path,
             const std::string& defines = "");
  ~GpuProgram();
  GpuProgram(const GpuProgram&) = delete;
  GpuProgram& operator=(const GpuProgram&) = delete;

  GLuint name() const { return name_; }
  GLint at(const char* uniform) const { return gl_.GetUniformLocation(name_, uniform); }

 private:
  const GladGLContext& gl_;
  GLuint name_ = 0;
};

// A traced G-buffer in textures: depth in metres (R32F) and view-space normals (RGB32F).
struct GpuView {
  GpuView(const GladGLContext& gl, const bake::nnao::TracedView& view);

  nook::nnao::ScreenRays rays;
  int width, height;
  GpuImage depth, normal;
};

}  // namespace nook::measure
