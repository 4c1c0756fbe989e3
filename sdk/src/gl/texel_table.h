// A one-dimensional table of float texels that shaders fetch by index. On OpenGL it is a texture buffer. On
// OpenGL ES and WebGL it is a 2D texture that stores the table row by row. shaders/core/texels.glsl reads
// both kinds of table.
#pragma once

#include <algorithm>
#include <cstdint>

#include "sdk/src/core/containers.h"
#include "sdk/src/gl/object.h"

namespace nook::gl {

class TexelTable {
 public:
  // Creates an empty table. Shaders must not fetch from an empty table. All functions bind the table to the
  // texture unit `unit` and leave this unit active.
  explicit TexelTable(Memory* memory, GLuint unit = 0) : unit_(unit), staging_(memory) {}
  TexelTable(TexelTable&&) noexcept = default;
  TexelTable& operator=(TexelTable&&) noexcept = default;

  // Reserves memory for at least `texels` texels. If the table grows, its contents are lost. `format` is
  // GL_RG32F or GL_RGBA32F and must be the same in every call. `label` must outlive the table. Throws
  // Failure.
  void reserve(Device& device, GLenum format, std::uint64_t texels, const char* label);
  bool made() const { return texture_.name() != 0; }
  std::uint64_t capacity() const { return capacity_; }
  std::uint64_t bytes() const { return capacity_ * bytes_of_texel(); }
  GLuint texture() const { return texture_.name(); }

  // Replaces the first `texels` texels, at most device.max_texels. fill(memory) must write them, with two or
  // four floats each. The table grows if necessary. The call does not wait for the GPU. Throws Failure.
  template <class Fill>
  void write(Device& device, std::uint64_t texels, Fill&& fill) {
    // Reserves 50 % more, so that a growing scene rarely reallocates.
    if (texels > capacity_)
      reserve(device, format_, std::min(texels + texels / 2, std::uint64_t{device.max_texels}), label_);
    staging_.resize(std::max(staging_.size(), std::size_t(texels * bytes_of_texel())));
    fill(static_cast<void*>(staging_.data()));
    if (device.gl.can.texture_buffers)
      buffer_.send(texels * bytes_of_texel(), staging_.data());
    else
      upload(device, texels);
  }

  // Replaces the table by exactly these texels. Use it for contents that rarely change. Throws Failure; a
  // texture buffer then keeps its old contents.
  void replace(Device& device, GLenum format, std::uint64_t texels, const float* data, const char* label);

  // Copies texels from a GPU buffer, which must not be bound for transform feedback. The texels must lie
  // within the capacity. The call does not wait for the GPU. Changes the binding of GL_PIXEL_UNPACK_BUFFER,
  // and of GL_ARRAY_BUFFER or the table's texture.
  void copy(const Device& device, GLuint buffer, std::uint64_t offset_bytes, std::uint64_t first_texel,
            std::uint64_t texels) const;

  void bind(const Device& device) const {
    device.gl.ActiveTexture(GL_TEXTURE0 + unit_);
    device.gl.BindTexture(target(device), texture_.name());
  }
  static GLenum target(const Device& device) {
    return device.gl.can.texture_buffers ? GL_TEXTURE_BUFFER : GL_TEXTURE_2D;
  }

 private:
  std::uint64_t bytes_of_texel() const { return (format_ == GL_RG32F ? 2 : 4) * sizeof(float); }
  void make_texture_buffer(Device& device, std::uint64_t texels, const float* data, GLenum usage);
  void make_texture_2d(Device& device, std::uint64_t texels);
  void upload(const Device& device, std::uint64_t texels) const;
  void copy_rows(const Device& device, std::uint64_t offset_bytes, std::uint64_t first_texel,
                 std::uint64_t texels) const;

  GLuint unit_ = 0;
  GLenum format_ = 0;
  const char* label_ = "";
  std::uint64_t capacity_ = 0;  // texels
  Buffer buffer_;               // used if the table is a texture buffer
  Vector<std::byte> staging_;   // memory for `fill` if the table is a 2D texture
  Object texture_;
};

}  // namespace nook::gl
