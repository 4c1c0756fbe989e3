#include "tests/gl/host_textures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "platform/program.h"
#include "tests/catch.h"
#include "tests/gl/test_context.h"

namespace nook::test {
namespace {

constexpr GLenum colour_formats[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};

// The form of an upload of floats on OpenGL ES.
struct Upload {
  GLint internal_format;
  GLenum format, type;
};

Upload upload_on_es(GLint internal_format, int channels) {
  const GLenum colours = colour_formats[channels - 1];
  switch (internal_format) {
    case GL_R8:
    case GL_RGBA8:
    case GL_SRGB8_ALPHA8:
      return {internal_format, colours, GL_UNSIGNED_BYTE};
    case GL_DEPTH_COMPONENT24:
      return {internal_format, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT};
    case GL_DEPTH_COMPONENT32F:
      return {internal_format, GL_DEPTH_COMPONENT, GL_FLOAT};
    case GL_RGB16:
      return {GL_RGB32F, colours, GL_FLOAT};
    default:
      return {internal_format, colours, GL_FLOAT};
  }
}

template <class Number>
std::vector<unsigned char> normalised_bytes(const std::vector<float>& data, double largest) {
  std::vector<Number> numbers;
  for (const float value : data)
    numbers.push_back(static_cast<Number>(std::clamp(double(value), 0.0, 1.0) * largest + 0.5));
  std::vector<unsigned char> bytes(numbers.size() * sizeof(Number));
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

}  // namespace

GLuint Textures::make(GLint internal_format, GLenum format, GLenum type, int width, int height, int layers,
                      const void* data) {
  const GLenum target = layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
  GLuint name = 0;
  gl_.GenTextures(1, &name);
  names_.push_back(name);
  gl_.BindTexture(target, name);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  // Left without a complete set of mipmaps, as the host's may be: the pass reads through samplers of its own.
  if (layers > 0)
    gl_.TexImage3D(target, 0, internal_format, width, height, layers, 0, format, type, data);
  else
    gl_.TexImage2D(target, 0, internal_format, width, height, 0, format, type, data);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  gl_.BindTexture(target, 0);
  return name;
}

GLuint Textures::floats(GLint internal_format, int channels, int width, int height, int layers,
                        const std::vector<float>& data) {
  const void* const floats = data.empty() ? nullptr : data.data();
  if (!is_es(gl_)) {
    const bool depth = internal_format == GL_DEPTH_COMPONENT32F || internal_format == GL_DEPTH_COMPONENT24 ||
                       internal_format == GL_DEPTH_COMPONENT16;
    return make(internal_format, depth ? GL_DEPTH_COMPONENT : colour_formats[channels - 1], GL_FLOAT, width,
                height, layers, floats);
  }
  const Upload upload = upload_on_es(internal_format, channels);
  if (upload.type == GL_FLOAT || !floats)
    return make(upload.internal_format, upload.format, upload.type, width, height, layers, floats);
  const std::vector<unsigned char> bytes = upload.type == GL_UNSIGNED_BYTE
                                               ? normalised_bytes<std::uint8_t>(data, 255)
                                               : normalised_bytes<std::uint32_t>(data, 4294967295.0);
  return make(upload.internal_format, upload.format, upload.type, width, height, layers, bytes.data());
}

GLuint Textures::array(GLint internal_format, int channels, int width, int height,
                       const std::vector<std::vector<float>>& images) {
  std::vector<float> data;
  for (const std::vector<float>& image : images) data.insert(data.end(), image.begin(), image.end());
  return floats(internal_format, channels, width, height, int(images.size()), data);
}

GLuint Textures::make_samples(SampledImage kind, int width, int height, GLsizei samples, int layers) {
  const GLenum target = layers > 0 ? GL_TEXTURE_2D_MULTISAMPLE_ARRAY : GL_TEXTURE_2D_MULTISAMPLE,
               format = kind == SampledImage::depth ? GL_DEPTH_COMPONENT32F : GL_RGBA8;
  GLuint name = 0;
  gl_.GenTextures(1, &name);
  names_.push_back(name);
  gl_.BindTexture(target, name);
  if (layers > 0 && is_es(gl_))
    gl_.TexStorage3DMultisample(target, samples, format, width, height, layers, GL_TRUE);
  else if (layers > 0)
    gl_.TexImage3DMultisample(target, samples, format, width, height, layers, GL_TRUE);
  else if (is_es(gl_))
    gl_.TexStorage2DMultisample(target, samples, format, width, height, GL_TRUE);
  else
    gl_.TexImage2DMultisample(target, samples, format, width, height, GL_TRUE);
  gl_.BindTexture(target, 0);
  return name;
}

void Textures::draw_samples(SampledImage kind, GLuint texture, int layer, int width, int height,
                            const std::vector<std::vector<float>>& images) {
  const bool depth = kind == SampledImage::depth;
  const char* const header = is_es(gl_) ? "#version 310 es\nprecision highp float; precision highp int;\n"
                                          "precision highp sampler2D;\n"
                                        : "#version 330 core\n";
  const char* const copy = depth ? "uniform sampler2D image; void main() { gl_FragDepth = texelFetch(image, "
                                   "ivec2(gl_FragCoord.xy), 0).r; }"
                                 : "uniform sampler2D image; out vec4 colour; void main() { colour = "
                                   "texelFetch(image, ivec2(gl_FragCoord.xy), 0); }";
  const platform::Program program(
      gl_,
      {header,
       "void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0, 1); }"},
      {header, copy});
  const GLenum attachment = depth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0,
               drawn = depth ? GL_NONE : GL_COLOR_ATTACHMENT0;
  GLuint framebuffer = 0, vertices = 0;
  gl_.GenFramebuffers(1, &framebuffer);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  if (layer < 0)
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D_MULTISAMPLE, texture, 0);
  else
    gl_.FramebufferTextureLayer(GL_FRAMEBUFFER, attachment, texture, 0, layer);
  gl_.DrawBuffers(1, &drawn);
  gl_.ReadBuffer(GL_NONE);
  REQUIRE(gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
  gl_.GenVertexArrays(1, &vertices);
  gl_.BindVertexArray(vertices);
  program.use();
  gl_.Viewport(0, 0, width, height);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_ALWAYS);
  gl_.Enable(GL_SAMPLE_MASK);
  // A pass with NOOK_GL_STATE_HOST may have left others.
  gl_.Disable(GL_BLEND);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl_.ActiveTexture(GL_TEXTURE0);
  for (std::size_t sample = 0; sample < images.size(); ++sample) {
    const GLuint image = floats(depth ? GL_R32F : GL_RGB32F, depth ? 1 : 3, width, height, images[sample]);
    gl_.BindTexture(GL_TEXTURE_2D, image);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl_.SampleMaski(0, GLbitfield(1) << sample);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  }
  gl_.SampleMaski(0, ~GLbitfield(0));
  gl_.Disable(GL_SAMPLE_MASK);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LESS);
  gl_.BindTexture(GL_TEXTURE_2D, 0);
  gl_.UseProgram(0);
  gl_.BindVertexArray(0);
  gl_.DeleteVertexArrays(1, &vertices);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl_.DeleteFramebuffers(1, &framebuffer);
}

GLuint Textures::samples(SampledImage kind, int width, int height,
                         const std::vector<std::vector<float>>& images) {
  const GLuint name = make_samples(kind, width, height, GLsizei(images.size()), 0);
  draw_samples(kind, name, -1, width, height, images);
  return name;
}

GLuint Textures::sample_array(SampledImage kind, int width, int height,
                              const std::vector<std::vector<std::vector<float>>>& layers) {
  const GLuint name = make_samples(kind, width, height, GLsizei(layers.at(0).size()), int(layers.size()));
  for (std::size_t layer = 0; layer < layers.size(); ++layer)
    draw_samples(kind, name, int(layer), width, height, layers[layer]);
  return name;
}

std::vector<float> read_texture(const GladGLContext& gl, GLuint texture, int width, int height, int channels,
                                int layer) {
  const std::size_t count = std::size_t(width) * std::size_t(height);
  GLuint framebuffer = 0;
  gl.GenFramebuffers(1, &framebuffer);
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  if (layer < 0)
    gl.FramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  else
    gl.FramebufferTextureLayer(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture, 0, layer);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  std::vector<float> out(count * std::size_t(channels));
  if (is_es(gl)) {
    GLint type = GL_NONE;
    gl.GetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                           GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, &type);
    std::vector<float> all(4 * count);
    if (type == GL_FLOAT) {
      gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, all.data());
    } else {
      std::vector<std::uint8_t> bytes(4 * count);
      gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
      std::ranges::transform(bytes, all.begin(), [](std::uint8_t byte) { return float(byte) / 255; });
    }
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = all[i / std::size_t(channels) * 4 + i % std::size_t(channels)];
  } else {
    gl.ReadPixels(0, 0, width, height, colour_formats[channels - 1], GL_FLOAT, out.data());
  }
  gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  gl.DeleteFramebuffers(1, &framebuffer);
  return out;
}

std::vector<unsigned char> read_buffer(const GladGLContext& gl, GLuint buffer, std::size_t offset,
                                       std::size_t bytes) {
  std::vector<unsigned char> out(bytes);
  gl.BindBuffer(GL_COPY_READ_BUFFER, buffer);
  // OpenGL and OpenGL ES both map; glGetBufferSubData is OpenGL's alone.
  const void* const memory =
      gl.MapBufferRange(GL_COPY_READ_BUFFER, GLintptr(offset), GLsizeiptr(bytes), GL_MAP_READ_BIT);
  REQUIRE(memory != nullptr);
  std::memcpy(out.data(), memory, bytes);
  gl.UnmapBuffer(GL_COPY_READ_BUFFER);
  gl.BindBuffer(GL_COPY_READ_BUFFER, 0);
  return out;
}

GLenum table_target(const GladGLContext& gl) {
  return is_es(gl) ? GL_TEXTURE_2D : GL_TEXTURE_BUFFER;
}

}  // namespace nook::test
