// Saves and restores the state that the draws of the screen-space pass change.
#include "sdk/src/gl/state_guard.h"

#include "sdk/src/gl/functions.h"

namespace nook::gl {
namespace {

// If OpenGL has a separate value for each draw buffer or viewport, changes only the value with index 0.
void set_enabled_0(const Functions& gl, GLenum capability, bool enabled) {
  if (!gl.can.indexed_draw_buffers)
    set_enabled(gl, capability, enabled);
  else
    enabled ? gl.Enablei(capability, 0) : gl.Disablei(capability, 0);
}

void set_color_mask(const Functions& gl, const GLboolean (&mask)[4]) {
  if (gl.can.indexed_draw_buffers)
    gl.ColorMaski(0, mask[0], mask[1], mask[2], mask[3]);
  else
    gl.ColorMask(mask[0], mask[1], mask[2], mask[3]);
}

bool has_indexed_blend(const Functions& gl) {
  return gl.BlendFuncSeparatei && gl.BlendEquationSeparatei;
}
bool has_indexed_viewports(const Functions& gl) {
  return gl.ViewportIndexedf && gl.GetFloati_v;
}

GLint blend_integer(const Functions& gl, GLenum name) {
  GLint value = 0;
  if (has_indexed_blend(gl))
    gl.GetIntegeri_v(name, 0, &value);
  else
    gl.GetIntegerv(name, &value);
  return value;
}

template <class Visit>
void for_units(const Functions& gl, const SavedState& s, Visit&& visit) {
  for (GLuint unit = 0; unit < texture_unit_count; ++unit) {
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    visit(unit);
  }
  gl.ActiveTexture(s.active_texture);
}

}  // namespace

void set_blend(const Functions& gl, const BlendState& blend) {
  const auto [enabled, source_rgb, destination_rgb, source_alpha, destination_alpha, equation_rgb,
              equation_alpha] = blend;
  set_enabled_0(gl, GL_BLEND, enabled);
  if (has_indexed_blend(gl)) {
    gl.BlendFuncSeparatei(0, source_rgb, destination_rgb, source_alpha, destination_alpha);
    gl.BlendEquationSeparatei(0, equation_rgb, equation_alpha);
  } else {
    gl.BlendFuncSeparate(source_rgb, destination_rgb, source_alpha, destination_alpha);
    gl.BlendEquationSeparate(equation_rgb, equation_alpha);
  }
}

void set_viewport(const Functions& gl, const GLfloat (&box)[4]) {
  if (has_indexed_viewports(gl))
    gl.ViewportIndexedf(0, box[0], box[1], box[2], box[3]);
  else
    gl.Viewport(static_cast<GLint>(box[0]), static_cast<GLint>(box[1]), static_cast<GLsizei>(box[2]),
                static_cast<GLsizei>(box[3]));
}

void set_scissor_test(const Functions& gl, bool enabled) {
  if (gl.can.indexed_viewports)
    set_enabled_0(gl, GL_SCISSOR_TEST, enabled);
  else
    set_enabled(gl, GL_SCISSOR_TEST, enabled);
}

void set_plain_drawing(const Functions& gl) {
  set_enabled_0(gl, GL_BLEND, false);
  set_color_mask(gl, {GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE});
  set_scissor_test(gl, false);
  for (const GLenum test : fragment_tests_of(gl)) gl.Disable(test);
  for (const GLenum other : {GL_DITHER, GL_RASTERIZER_DISCARD}) gl.Disable(other);
  if (!gl.can.desktop_raster) return;
  gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  for (const GLenum other : {GL_FRAMEBUFFER_SRGB, GL_PRIMITIVE_RESTART}) gl.Disable(other);
}

void query_texture_2d(const Functions& gl, SavedState& s) {
  for_units(gl, s, [&](GLuint unit) { s.texture_2d[unit] = integer(gl, GL_TEXTURE_BINDING_2D); });
}
void restore_texture_2d(const Functions& gl, const SavedState& s) {
  for_units(gl, s, [&](GLuint unit) { gl.BindTexture(GL_TEXTURE_2D, s.texture_2d[unit]); });
}

void query_layer_textures(const Functions& gl, SavedState& s) {
  for (std::size_t i = 0; i < std::size(layer_units); ++i) {
    gl.ActiveTexture(GL_TEXTURE0 + layer_units[i]);
    s.layer_textures[i] = integer(gl, GL_TEXTURE_BINDING_2D_ARRAY);
  }
  gl.ActiveTexture(s.active_texture);
}
void restore_layer_textures(const Functions& gl, const SavedState& s) {
  for (std::size_t i = 0; i < std::size(layer_units); ++i) {
    gl.ActiveTexture(GL_TEXTURE0 + layer_units[i]);
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, s.layer_textures[i]);
  }
  gl.ActiveTexture(s.active_texture);
}

GLint host_depth_binding(const Functions& gl, const SavedState& s, GLenum binding) {
  gl.ActiveTexture(GL_TEXTURE0 + host_depth_unit);
  const GLint name = integer(gl, binding);
  gl.ActiveTexture(s.active_texture);
  return name;
}
void bind_host_depth(const Functions& gl, const SavedState& s, GLenum target, GLint name) {
  gl.ActiveTexture(GL_TEXTURE0 + host_depth_unit);
  gl.BindTexture(target, name);
  gl.ActiveTexture(s.active_texture);
}

void query_sample_texture(const Functions& gl, SavedState& s) {
  s.sample_texture = host_depth_binding(gl, s, GL_TEXTURE_BINDING_2D_MULTISAMPLE);
}
void restore_sample_texture(const Functions& gl, const SavedState& s) {
  bind_host_depth(gl, s, GL_TEXTURE_2D_MULTISAMPLE, s.sample_texture);
}

void query_sample_array(const Functions& gl, SavedState& s) {
  s.sample_array = host_depth_binding(gl, s, GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY);
}
void restore_sample_array(const Functions& gl, const SavedState& s) {
  bind_host_depth(gl, s, GL_TEXTURE_2D_MULTISAMPLE_ARRAY, s.sample_array);
}

void query_samplers(const Functions& gl, SavedState& s) {
  for_units(gl, s, [&](GLuint unit) { s.samplers[unit] = integer(gl, GL_SAMPLER_BINDING); });
}
void restore_samplers(const Functions& gl, const SavedState& s) {
  for (GLuint unit = 0; unit < texture_unit_count; ++unit) gl.BindSampler(unit, s.samplers[unit]);
}

void query_filter_texture(const Functions& gl, SavedState& s) {
  if (!gl.can.texture_buffers) return;  // then the texture is one of the 2D textures
  gl.ActiveTexture(GL_TEXTURE0 + filter_unit);
  s.filter_texture = integer(gl, GL_TEXTURE_BINDING_BUFFER);
  gl.ActiveTexture(s.active_texture);
}
void restore_filter_texture(const Functions& gl, const SavedState& s) {
  if (!gl.can.texture_buffers) return;
  gl.ActiveTexture(GL_TEXTURE0 + filter_unit);
  gl.BindTexture(GL_TEXTURE_BUFFER, s.filter_texture);
  gl.ActiveTexture(s.active_texture);
}

void query_pixel_unpack_buffer(const Functions& gl, SavedState& s) {
  s.pixel_unpack_buffer = integer(gl, GL_PIXEL_UNPACK_BUFFER_BINDING);
}
void restore_pixel_unpack_buffer(const Functions& gl, const SavedState& s) {
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, s.pixel_unpack_buffer);
}

void query_viewport(const Functions& gl, SavedState& s) {
  if (has_indexed_viewports(gl))
    gl.GetFloati_v(GL_VIEWPORT, 0, s.viewport.box);
  else
    gl.GetFloatv(GL_VIEWPORT, s.viewport.box);
  s.viewport.known = true;
}
void restore_viewport(const Functions& gl, const SavedState& s) {
  if (s.viewport.known) set_viewport(gl, s.viewport.box);
}

void query_blend(const Functions& gl, SavedState& s) {
  s.blend.enabled = gl.can.indexed_draw_buffers ? gl.IsEnabledi(GL_BLEND, 0) : gl.IsEnabled(GL_BLEND);
  s.blend.source_rgb = blend_integer(gl, GL_BLEND_SRC_RGB);
  s.blend.destination_rgb = blend_integer(gl, GL_BLEND_DST_RGB);
  s.blend.source_alpha = blend_integer(gl, GL_BLEND_SRC_ALPHA);
  s.blend.destination_alpha = blend_integer(gl, GL_BLEND_DST_ALPHA);
  s.blend.equation_rgb = blend_integer(gl, GL_BLEND_EQUATION_RGB);
  s.blend.equation_alpha = blend_integer(gl, GL_BLEND_EQUATION_ALPHA);
}
void restore_blend(const Functions& gl, const SavedState& s) {
  set_blend(gl, s.blend);
}

void query_color_mask(const Functions& gl, SavedState& s) {
  if (gl.can.indexed_draw_buffers)
    gl.GetBooleani_v(GL_COLOR_WRITEMASK, 0, s.color_mask);
  else
    gl.GetBooleanv(GL_COLOR_WRITEMASK, s.color_mask);
}
void restore_color_mask(const Functions& gl, const SavedState& s) {
  set_color_mask(gl, s.color_mask);
}

void query_polygon_mode(const Functions& gl, SavedState& s) {
  if (!gl.can.desktop_raster) return;
  // Some drivers return two values, for front and back faces. In core profiles they are equal.
  GLint modes[2] = {GL_FILL, GL_FILL};
  gl.GetIntegerv(GL_POLYGON_MODE, modes);
  s.polygon_mode = modes[0];
}
void restore_polygon_mode(const Functions& gl, const SavedState& s) {
  if (gl.can.desktop_raster) gl.PolygonMode(GL_FRONT_AND_BACK, s.polygon_mode);
}

void query_scissor_test(const Functions& gl, SavedState& s) {
  s.scissor_test =
      gl.can.indexed_viewports ? gl.IsEnabledi(GL_SCISSOR_TEST, 0) : gl.IsEnabled(GL_SCISSOR_TEST);
}
void restore_scissor_test(const Functions& gl, const SavedState& s) {
  set_scissor_test(gl, s.scissor_test);
}

void query_framebuffer_srgb(const Functions& gl, SavedState& s) {
  if (gl.can.desktop_raster) s.framebuffer_srgb = gl.IsEnabled(GL_FRAMEBUFFER_SRGB);
}
void restore_framebuffer_srgb(const Functions& gl, const SavedState& s) {
  if (gl.can.desktop_raster) set_enabled(gl, GL_FRAMEBUFFER_SRGB, s.framebuffer_srgb);
}

void query_fragment_tests(const Functions& gl, SavedState& s) {
  const std::span<const GLenum> tests = fragment_tests_of(gl);
  for (std::size_t i = 0; i < tests.size(); ++i) s.fragment_tests[i] = gl.IsEnabled(tests[i]);
}
void restore_fragment_tests(const Functions& gl, const SavedState& s) {
  const std::span<const GLenum> tests = fragment_tests_of(gl);
  for (std::size_t i = 0; i < tests.size(); ++i) set_enabled(gl, tests[i], s.fragment_tests[i]);
}

void query_dither(const Functions& gl, SavedState& s) {
  s.dither = gl.IsEnabled(GL_DITHER);
}
void restore_dither(const Functions& gl, const SavedState& s) {
  set_enabled(gl, GL_DITHER, s.dither);
}

void query_query_buffer(const Functions& gl, SavedState& s) {
  if (gl.can.query_buffers) s.query_buffer = integer(gl, GL_QUERY_BUFFER_BINDING);
}
void restore_query_buffer(const Functions& gl, const SavedState& s) {
  if (gl.can.query_buffers) gl.BindBuffer(GL_QUERY_BUFFER, s.query_buffer);
}

}  // namespace nook::gl
