// Textures and buffers as a host has them, filled and read back on OpenGL and on OpenGL ES. OpenGL ES
// converts nothing: an upload needs the exact type of its format, and reads give four channels.
#pragma once

#include <glad/gl.h>

#include <cstddef>
#include <vector>

namespace nook::test {

// The kinds of multisample textures: GL_DEPTH_COMPONENT32F, of images with one channel, and GL_RGBA8, of
// images with three.
enum class SampledImage { depth, colours };

// Textures that are deleted with it.
class Textures {
 public:
  explicit Textures(const GladGLContext& gl) : gl_(gl) {}
  ~Textures() {
    for (const GLuint name : names_) gl_.DeleteTextures(1, &name);
  }
  Textures(const Textures&) = delete;
  Textures& operator=(const Textures&) = delete;

  // data may be null.
  GLuint make(GLint internal_format, GLenum format, GLenum type, int width, int height, const void* data) {
    return make(internal_format, format, type, width, height, 0, data);
  }
  // An empty vector leaves the texels undefined. A format that OpenGL ES lacks, GL_RGB16, is GL_RGB32F there.
  GLuint floats(GLint internal_format, int channels, int width, int height, const std::vector<float>& data) {
    return floats(internal_format, channels, width, height, 0, data);
  }
  // A texture array of the images one after the other.
  GLuint array(GLint internal_format, int channels, int width, int height,
               const std::vector<std::vector<float>>& images);
  // A multisample texture: an image for each sample. It draws, and leaves the state at its defaults but for
  // the viewport.
  GLuint samples(SampledImage kind, int width, int height, const std::vector<std::vector<float>>& images);
  // An array of them: the images of the samples for each layer.
  GLuint sample_array(SampledImage kind, int width, int height,
                      const std::vector<std::vector<std::vector<float>>>& layers);

 private:
  // The name of a multisample texture without contents; layers 0: no array.
  GLuint make_samples(SampledImage kind, int width, int height, GLsizei samples, int layers);
  // layer -1: the texture is not an array.
  void draw_samples(SampledImage kind, GLuint texture, int layer, int width, int height,
                    const std::vector<std::vector<float>>& images);
  // layers 0: a 2D texture.
  GLuint make(GLint internal_format, GLenum format, GLenum type, int width, int height, int layers,
              const void* data);
  GLuint floats(GLint internal_format, int channels, int width, int height, int layers,
                const std::vector<float>& data);
  const GladGLContext& gl_;
  std::vector<GLuint> names_;
};

// The first channels of level 0, of a format that can be drawn into. layer: of a texture array.
std::vector<float> read_texture(const GladGLContext& gl, GLuint texture, int width, int height,
                                int channels = 1, int layer = -1);
std::vector<unsigned char> read_buffer(const GladGLContext& gl, GLuint buffer, std::size_t offset,
                                       std::size_t bytes);

// The target of the tables of texels that Nook's functions for hosts fetch from.
GLenum table_target(const GladGLContext& gl);

}  // namespace nook::test
