#include "bakers/measure/nnao/gpu_image.h"

#include "platform/program.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

const char* shader_text(ShaderTable shaders, const std::string& path) {
  for (const EmbeddedShader& shader : shaders)
    if (path == shader.path) return shader.text;
  throw Failure(NOOK_ERROR_INTERNAL, "this build does not contain the shader %s", path.c_str());
}

GLuint linked(const GladGLContext& gl, ShaderTable shaders, const std::string& path,
              const std::string& defines) {
  const std::string text = shader_text(shaders, path);
  const std::size_t second_line = text.find('\n') + 1;  // the line after #version
  const std::string head = text.substr(0, second_line) + defines;
  return platform::link_program(gl, {shader_text(embedded_shaders(), "screen.vert")},
                                {head.c_str(), text.c_str() + second_line});
}

const float* numbers(const std::vector<Vec3>& vectors) {
  static_assert(sizeof(Vec3) == 3 * sizeof(float));
  return &vectors.front().x;
}

}  // namespace

GpuImage::GpuImage(const GladGLContext& gl, GLint internal_format, GLenum format, int width, int height,
                   const float* data)
    : gl_(gl) {
  gl.GenTextures(1, &texture_);
  gl.BindTexture(GL_TEXTURE_2D, texture_);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  gl.TexImage2D(GL_TEXTURE_2D, 0, internal_format, width, height, 0, format, GL_FLOAT, data);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.TexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
  if (data) return;
  gl.GenFramebuffers(1, &framebuffer_);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
}

GpuImage::~GpuImage() {
  if (framebuffer_) gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(1, &texture_);
}

std::vector<float> read_red(const GladGLContext& gl, GLuint texture, int width, int height) {
  std::vector<float> values(std::size_t(width) * std::size_t(height));
  gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_FLOAT, values.data());
  return values;
}

std::vector<float> read_rgba(const GladGLContext& gl, GLuint texture, int width, int height) {
  std::vector<float> values(std::size_t(width) * std::size_t(height) * 4);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, values.data());
  return values;
}

GpuProgram::GpuProgram(const GladGLContext& gl, ShaderTable shaders, const std::string& path,
                       const std::string& defines)
    : gl_(gl), name_(linked(gl, shaders, path, defines)) {}

GpuProgram::~GpuProgram() {
  gl_.DeleteProgram(name_);
}

GpuView::GpuView(const GladGLContext& gl, const bake::nnao::TracedView& view)
    : rays(view.camera.rays),
      width(int(view.camera.width)),
      height(int(view.camera.height)),
      depth(gl, GL_R32F, GL_RED, width, height, view.depth.data()),
      normal(gl, GL_RGB32F, GL_RGB, width, height, numbers(view.normal)) {}

}  // namespace nook::measure
