#include "sdk/src/gl/nnao/texel_reader.h"

#include <algorithm>

#include "sdk/src/core/bit_cast.h"
#include "sdk/src/gl/program.h"
#include "sdk/src/gl/state_guard.h"

namespace nook::gl {

TexelReader::TexelReader(Device& device, int width)
    : device_(device),
      program_(draw_program(device, "nnao/screen.vert", "nnao/texel_bits.frag", "")),
      sampler_(Object::make(device, Object::Kind::sampler)),
      vertex_array_(Object::make(device, Object::Kind::vertex_array)),
      strip_(device, TextureFormat::texel_bits, width, texel_strip_rows, "nook: texels to read"),
      bits_(std::size_t(width) * texel_strip_rows * 4, 0, device.memory) {
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    device.gl.SamplerParameteri(sampler_.name(), filter, GL_NEAREST);
}

Vector<float> TexelReader::read(GLuint texture, const Viewport& viewport, int channels) {
  const Functions& gl = device_.gl;
  Vector<float> values(device_.memory);
  values.reserve(std::size_t(viewport.width) * std::size_t(viewport.height) * std::size_t(channels));
  set_plain_drawing(gl);
  set_pixel_pack(gl, {});
  gl.BindVertexArray(vertex_array_.name());
  gl.UseProgram(program_.name());
  gl.Uniform1i(uniform_location(device_, program_, "nook_image"), 0);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.BindSampler(0, sampler_.name());
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  for (const GLenum target : {GL_DRAW_FRAMEBUFFER, GL_READ_FRAMEBUFFER})
    gl.BindFramebuffer(target, strip_.framebuffer());
  const GLint first = uniform_location(device_, program_, "nook_first");
  for (int y = 0; y < viewport.height; y += texel_strip_rows) {
    const int rows = std::min(texel_strip_rows, viewport.height - y);
    set_viewport(gl, {0, 0, float(viewport.width), float(rows)});
    gl.Uniform2i(first, viewport.x, viewport.y + y);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    // OpenGL ES reads integers in this form alone.
    gl.ReadPixels(0, 0, viewport.width, rows, GL_RGBA_INTEGER, GL_UNSIGNED_INT, bits_.data());
    device_.check("reading texels back");
    const std::size_t texels = std::size_t(viewport.width) * std::size_t(rows);
    for (std::size_t i = 0; i < texels; ++i)
      for (int channel = 0; channel < channels; ++channel)
        values.push_back(bit_cast<float>(bits_[4 * i + std::size_t(channel)]));
  }
  return values;
}

}  // namespace nook::gl
