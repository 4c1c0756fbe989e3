#include "sdk/src/gl/texel_table.h"

#include <cstring>

#include "sdk/src/gl/state_guard.h"
#include "shaders/core/texel_layout.h"

namespace nook::gl {
namespace {

constexpr std::uint64_t width = NOOK_TEXEL_ROW;

GLenum components(GLenum format) {
  return format == GL_RG32F ? GL_RG : GL_RGBA;
}

}  // namespace

void TexelTable::reserve(Device& device, GLenum format, std::uint64_t texels, const char* label) {
  format_ = format;
  label_ = label;
  if (made() && texels <= capacity_) return;
  if (device.gl.can.texture_buffers) {
    make_texture_buffer(device, texels, nullptr, GL_STREAM_DRAW);
    staging_.resize(texels * bytes_of_texel());
  } else {
    make_texture_2d(device, texels);
  }
}

void TexelTable::replace(Device& device, GLenum format, std::uint64_t texels, const float* data,
                         const char* label) {
  format_ = format;
  label_ = label;
  if (device.gl.can.texture_buffers) {
    make_texture_buffer(device, texels, data, GL_STATIC_DRAW);
    return;
  }
  make_texture_2d(device, texels);
  std::memcpy(staging_.data(), data, texels * bytes_of_texel());
  upload(device, texels);
  staging_ = Vector<std::byte>(staging_.get_allocator());
}

void TexelTable::make_texture_buffer(Device& device, std::uint64_t texels, const float* data, GLenum usage) {
  // The host may have bound the texture, so the texture keeps its name and only its buffer is replaced.
  Buffer buffer(device, label_, texels * bytes_of_texel(), data, usage);
  if (!made()) texture_ = Object::make(device, Object::Kind::texture);
  bind(device);
  device.gl.TexBuffer(GL_TEXTURE_BUFFER, format_, buffer.name());
  device.check("making a table of texels");
  device.label(GL_TEXTURE, texture_.name(), label_);
  buffer_ = std::move(buffer);
  capacity_ = texels;
}

void TexelTable::make_texture_2d(Device& device, std::uint64_t texels) {
  const Functions& gl = device.gl;
  const std::uint64_t rows = (texels + width - 1) / width;
  staging_.resize(rows * width * bytes_of_texel());
  if (!made()) texture_ = Object::make(device, Object::Kind::texture);
  bind(device);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.TexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  // If a buffer were bound, OpenGL would read the null pointer as an offset into the host's buffer.
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format_), static_cast<GLsizei>(width),
                static_cast<GLsizei>(rows), 0, components(format_), GL_FLOAT, nullptr);
  device.check("making a table of texels");
  device.label(GL_TEXTURE, texture_.name(), label_);
  capacity_ = rows * width;
}

void TexelTable::upload(const Device& device, std::uint64_t texels) const {
  const Functions& gl = device.gl;
  bind(device);
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  set_pixel_store(gl, {});
  const auto send = [&](std::uint64_t row, std::uint64_t across, std::uint64_t rows) {
    if (across > 0 && rows > 0)
      gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, static_cast<GLint>(row), static_cast<GLsizei>(across),
                       static_cast<GLsizei>(rows), components(format_), GL_FLOAT,
                       staging_.data() + row * width * bytes_of_texel());
  };
  const std::uint64_t whole = texels / width;
  send(0, width, whole);
  send(whole, texels % width, 1);
}

void TexelTable::copy(const Device& device, GLuint buffer, std::uint64_t offset_bytes,
                      std::uint64_t first_texel, std::uint64_t texels) const {
  const Functions& gl = device.gl;
  if (device.gl.can.texture_buffers) {
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
    gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.name());
    gl.CopyBufferSubData(GL_PIXEL_UNPACK_BUFFER, GL_ARRAY_BUFFER, static_cast<GLintptr>(offset_bytes),
                         static_cast<GLintptr>(first_texel * bytes_of_texel()),
                         static_cast<GLsizeiptr>(texels * bytes_of_texel()));
  } else {
    bind(device);
    gl.BindBuffer(GL_ARRAY_BUFFER, 0);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
    set_pixel_store(gl, {});
    copy_rows(device, offset_bytes, first_texel, texels);
  }
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

// Copies the rest of the first row, then whole rows, then the beginning of the last row.
void TexelTable::copy_rows(const Device& device, std::uint64_t offset_bytes, std::uint64_t first_texel,
                           std::uint64_t texels) const {
  std::uint64_t done = 0;
  while (done < texels) {
    const std::uint64_t x = (first_texel + done) % width, left = texels - done;
    const bool whole = x == 0 && left >= width;
    const std::uint64_t across = whole ? width : std::min(width - x, left), rows = whole ? left / width : 1;
    device.gl.TexSubImage2D(
        GL_TEXTURE_2D, 0, static_cast<GLint>(x), static_cast<GLint>((first_texel + done) / width),
        static_cast<GLsizei>(across), static_cast<GLsizei>(rows), components(format_), GL_FLOAT,
        reinterpret_cast<const void*>(static_cast<std::uintptr_t>(offset_bytes + done * bytes_of_texel())));
    done += across * rows;
  }
}

}  // namespace nook::gl
