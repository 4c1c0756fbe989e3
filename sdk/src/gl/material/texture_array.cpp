#include "sdk/src/gl/material/texture_array.h"

#include <algorithm>
#include <cstddef>

#include "sdk/src/gl/state_guard.h"
#include "sdk/src/material/layered_image.h"

namespace nook::gl {
namespace {

struct Layout {
  GLint internal_format;
  GLenum format, type;      // 0 for blocks
  std::size_t texel_bytes;  // 0 for blocks
  GLint min_filter, mag_filter, wrap;
};

// OpenGL ES cannot filter textures of 32-bit floats, so half floats are used there.
Layout layout_of(const Functions& gl, ArrayUse use) {
  switch (use) {
    case ArrayUse::spatial:
      return {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 8, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT};
    case ArrayUse::coefficients:
      return {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 8, GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE};
    case ArrayUse::membership:
      return {GL_RGBA16UI, GL_RGBA_INTEGER, GL_UNSIGNED_SHORT, 8, GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE};
    case ArrayUse::membership_8:
      return {GL_RGBA8UI, GL_RGBA_INTEGER, GL_UNSIGNED_BYTE, 4, GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE};
    case ArrayUse::rgtc:
      return {GL_COMPRESSED_SIGNED_RG_RGTC2, 0, 0, 0, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT};
    case ArrayUse::eac:
      return {GL_COMPRESSED_SIGNED_RG11_EAC, 0, 0, 0, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT};
    case ArrayUse::spatial_8:
      return {GL_RGBA8_SNORM, GL_RGBA, GL_BYTE, 4, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT};
    case ArrayUse::light_8:
      return {GL_RGBA8_SNORM, GL_RGBA, GL_BYTE, 4, GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE};
    case ArrayUse::coordinates:
      return {GL_RG16UI, GL_RG_INTEGER, GL_UNSIGNED_SHORT, 4, GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE};
    case ArrayUse::heights:
      return {GL_R16F, GL_RED, GL_HALF_FLOAT, 2, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT};
    default:
      return {gl.profile == Profile::desktop ? GL_RGBA32F : GL_RGBA16F,
              GL_RGBA,
              GL_FLOAT,
              16,
              GL_LINEAR,
              GL_LINEAR,
              GL_CLAMP_TO_EDGE};
  }
}

}  // namespace

Object make_texture_array(Device& device, const ArrayPlan& plan, const void* data, const char* label) {
  const Functions& gl = device.gl;
  const Layout layout = layout_of(gl, plan.use);
  Object texture = Object::make(device, Object::Kind::texture);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D_ARRAY, texture.name());
  const struct {
    GLenum name;
    GLint value;
  } parameters[] = {{GL_TEXTURE_MAX_LEVEL, plan.levels - 1},
                    {GL_TEXTURE_MIN_FILTER, layout.min_filter},
                    {GL_TEXTURE_MAG_FILTER, layout.mag_filter},
                    {GL_TEXTURE_WRAP_S, layout.wrap},
                    {GL_TEXTURE_WRAP_T, layout.wrap}};
  for (const auto& parameter : parameters)
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, parameter.name, parameter.value);
  const bool is_packed = layout.texel_bytes == 0;
  const material::BlockSize blocks{std::uint32_t(plan.width), std::uint32_t(plan.height),
                                   std::uint32_t(plan.all_layers), std::uint32_t(plan.levels)};
  const auto* bytes = static_cast<const std::byte*>(data);
  for (GLsizei level = 0; level < plan.levels; ++level) {
    const GLsizei width = std::max(plan.width >> level, 1), height = std::max(plan.height >> level, 1);
    const std::size_t layer_bytes = is_packed ? blocks.layer_bytes(std::uint32_t(level))
                                              : layout.texel_bytes * std::size_t(width) * std::size_t(height);
    const std::byte* const first = bytes + layer_bytes * std::size_t(plan.first_layer);
    if (is_packed)
      gl.CompressedTexImage3D(GL_TEXTURE_2D_ARRAY, level, GLenum(layout.internal_format), width, height,
                              plan.layers, 0, GLsizei(layer_bytes * std::size_t(plan.layers)), first);
    else
      gl.TexImage3D(GL_TEXTURE_2D_ARRAY, level, layout.internal_format, width, height, plan.layers, 0,
                    layout.format, layout.type, first);
    bytes += layer_bytes * std::size_t(plan.all_layers);
  }
  device.check("uploading a material's texture");
  device.label(GL_TEXTURE, texture.name(), label);
  return texture;
}

void set_plain_unpacking(const Functions& gl) {
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  set_pixel_store(gl, {});
}

}  // namespace nook::gl
