#include "sdk/src/gl/state_guard.h"

#include <iterator>
#include <utility>

#include "sdk/src/gl/functions.h"

namespace nook::gl {
namespace {

BufferRange indexed_range(const Functions& gl, GLenum binding, GLenum start, GLenum size, GLuint index) {
  BufferRange range;
  gl.GetIntegeri_v(binding, index, &range.buffer);
  gl.GetInteger64i_v(start, index, &range.offset);
  gl.GetInteger64i_v(size, index, &range.size);
  return range;
}

void bind_range(const Functions& gl, GLenum target, GLuint index, const BufferRange& range) {
  if (range.buffer == 0 || range.size == 0)
    gl.BindBufferBase(target, index, range.buffer);
  else
    gl.BindBufferRange(target, index, range.buffer, range.offset, range.size);
}

bool has_feedback_objects(const Functions& gl) {
  return gl.BindTransformFeedback != nullptr;
}

}  // namespace

void query_program(const Functions& gl, SavedState& s) {
  s.program = integer(gl, GL_CURRENT_PROGRAM);
}
void restore_program(const Functions& gl, const SavedState& s) {
  // The host may have deleted its program while it was current. OpenGL then freed the program when Nook made
  // its own program current, so it cannot be restored.
  const bool gone = s.program != 0 && !gl.IsProgram(s.program);
  gl.UseProgram(gone ? 0 : s.program);
}

void query_array_buffer(const Functions& gl, SavedState& s) {
  s.array_buffer = integer(gl, GL_ARRAY_BUFFER_BINDING);
}
void restore_array_buffer(const Functions& gl, const SavedState& s) {
  gl.BindBuffer(GL_ARRAY_BUFFER, s.array_buffer);
}

void query_vertex_array(const Functions& gl, SavedState& s) {
  s.vertex_array = integer(gl, GL_VERTEX_ARRAY_BINDING);
}
void restore_vertex_array(const Functions& gl, const SavedState& s) {
  gl.BindVertexArray(s.vertex_array);
}

void query_active_texture(const Functions& gl, SavedState& s) {
  s.active_texture = integer(gl, GL_ACTIVE_TEXTURE);
}
void restore_active_texture(const Functions& gl, const SavedState& s) {
  gl.ActiveTexture(s.active_texture);
}

// The next two items are bindings of unit 0, whatever the active unit is. The active unit is restored by the
// item above.
void query_texture_unit_0(const Functions& gl, SavedState& s) {
  gl.ActiveTexture(GL_TEXTURE0);
  s.texture_unit_0 = integer(gl, gl.can.texture_buffers ? GL_TEXTURE_BINDING_BUFFER : GL_TEXTURE_BINDING_2D);
  gl.ActiveTexture(s.active_texture);
}
void restore_texture_unit_0(const Functions& gl, const SavedState& s) {
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(gl.can.texture_buffers ? GL_TEXTURE_BUFFER : GL_TEXTURE_2D, s.texture_unit_0);
  gl.ActiveTexture(s.active_texture);
}

void query_texture_2d_array(const Functions& gl, SavedState& s) {
  gl.ActiveTexture(GL_TEXTURE0);
  s.texture_2d_array = integer(gl, GL_TEXTURE_BINDING_2D_ARRAY);
  gl.ActiveTexture(s.active_texture);
}
void restore_texture_2d_array(const Functions& gl, const SavedState& s) {
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D_ARRAY, s.texture_2d_array);
  gl.ActiveTexture(s.active_texture);
}

void query_texture_3d(const Functions& gl, SavedState& s) {
  gl.ActiveTexture(GL_TEXTURE0);
  s.texture_3d = integer(gl, GL_TEXTURE_BINDING_3D);
  gl.ActiveTexture(s.active_texture);
}
void restore_texture_3d(const Functions& gl, const SavedState& s) {
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_3D, s.texture_3d);
  gl.ActiveTexture(s.active_texture);
}

void query_cube_map(const Functions& gl, SavedState& s) {
  gl.ActiveTexture(GL_TEXTURE0 + cube_map_unit);
  s.cube_map = integer(gl, GL_TEXTURE_BINDING_CUBE_MAP);
  gl.ActiveTexture(s.active_texture);
}
void restore_cube_map(const Functions& gl, const SavedState& s) {
  gl.ActiveTexture(GL_TEXTURE0 + cube_map_unit);
  gl.BindTexture(GL_TEXTURE_CUBE_MAP, s.cube_map);
  gl.ActiveTexture(s.active_texture);
}

void query_capture_samplers(const Functions& gl, SavedState& s) {
  for (GLuint unit = 0; unit < std::size(s.capture_samplers); ++unit) {
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    s.capture_samplers[unit] = integer(gl, GL_SAMPLER_BINDING);
  }
  gl.ActiveTexture(s.active_texture);
}
void restore_capture_samplers(const Functions& gl, const SavedState& s) {
  for (GLuint unit = 0; unit < std::size(s.capture_samplers); ++unit)
    gl.BindSampler(unit, s.capture_samplers[unit]);
}

void query_image_unit(const Functions& gl, SavedState& s) {
  const std::pair<GLenum, GLint*> values[] = {
      {GL_IMAGE_BINDING_NAME, &s.image_unit.texture},    {GL_IMAGE_BINDING_LEVEL, &s.image_unit.level},
      {GL_IMAGE_BINDING_LAYERED, &s.image_unit.layered}, {GL_IMAGE_BINDING_LAYER, &s.image_unit.layer},
      {GL_IMAGE_BINDING_ACCESS, &s.image_unit.access},   {GL_IMAGE_BINDING_FORMAT, &s.image_unit.format}};
  for (const auto& [name, value] : values) gl.GetIntegeri_v(name, image_unit_index, value);
}
void restore_image_unit(const Functions& gl, const SavedState& s) {
  const auto [texture, level, layered, layer, access, format] = s.image_unit;
  const GLenum first_format = gl.profile == Profile::desktop ? GL_R8 : GL_R32UI;
  gl.BindImageTexture(image_unit_index, texture, level, layered != GL_FALSE, layer, access,
                      format ? static_cast<GLenum>(format) : first_format);
}

namespace {

std::size_t pixel_store_count(const Functions& gl) {
  return std::size(pixel_store_names) - (gl.profile == Profile::desktop ? 0 : 2);
}

}  // namespace

void set_pixel_store(const Functions& gl, const PixelStore& store) {
  for (std::size_t i = 0; i < pixel_store_count(gl); ++i)
    gl.PixelStorei(pixel_store_names[i], store.values[i]);
}
void query_pixel_store(const Functions& gl, SavedState& s) {
  for (std::size_t i = 0; i < pixel_store_count(gl); ++i)
    s.pixel_store.values[i] = integer(gl, pixel_store_names[i]);
}
void restore_pixel_store(const Functions& gl, const SavedState& s) {
  set_pixel_store(gl, s.pixel_store);
}

namespace {

std::size_t pixel_pack_count(const Functions& gl) {
  return std::size(pixel_pack_names) - (gl.profile == Profile::desktop ? 0 : 1);
}

}  // namespace

void set_pixel_pack(const Functions& gl, const PixelPack& pack) {
  for (std::size_t i = 0; i < pixel_pack_count(gl); ++i) gl.PixelStorei(pixel_pack_names[i], pack.values[i]);
}
void query_pixel_pack(const Functions& gl, SavedState& s) {
  for (std::size_t i = 0; i < pixel_pack_count(gl); ++i)
    s.pixel_pack.values[i] = integer(gl, pixel_pack_names[i]);
}
void restore_pixel_pack(const Functions& gl, const SavedState& s) {
  set_pixel_pack(gl, s.pixel_pack);
}

void query_pixel_pack_buffer(const Functions& gl, SavedState& s) {
  s.pixel_pack_buffer = integer(gl, GL_PIXEL_PACK_BUFFER_BINDING);
}
void restore_pixel_pack_buffer(const Functions& gl, const SavedState& s) {
  gl.BindBuffer(GL_PIXEL_PACK_BUFFER, s.pixel_pack_buffer);
}

void query_read_framebuffer(const Functions& gl, SavedState& s) {
  s.read_framebuffer = integer(gl, GL_READ_FRAMEBUFFER_BINDING);
}
void restore_read_framebuffer(const Functions& gl, const SavedState& s) {
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, s.read_framebuffer);
}

void query_draw_framebuffer(const Functions& gl, SavedState& s) {
  s.draw_framebuffer = integer(gl, GL_DRAW_FRAMEBUFFER_BINDING);
}
void restore_draw_framebuffer(const Functions& gl, const SavedState& s) {
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, s.draw_framebuffer);
}

void query_renderbuffer(const Functions& gl, SavedState& s) {
  s.renderbuffer = integer(gl, GL_RENDERBUFFER_BINDING);
}
void restore_renderbuffer(const Functions& gl, const SavedState& s) {
  gl.BindRenderbuffer(GL_RENDERBUFFER, s.renderbuffer);
}

void query_rasterizer_discard(const Functions& gl, SavedState& s) {
  s.rasterizer_discard = gl.IsEnabled(GL_RASTERIZER_DISCARD);
}
void restore_rasterizer_discard(const Functions& gl, const SavedState& s) {
  set_enabled(gl, GL_RASTERIZER_DISCARD, s.rasterizer_discard);
}

void set_primitive_restart(const Functions& gl, bool enabled) {
  if (gl.can.desktop_raster) set_enabled(gl, GL_PRIMITIVE_RESTART, enabled);
}
void query_primitive_restart(const Functions& gl, SavedState& s) {
  if (gl.can.desktop_raster) s.primitive_restart = gl.IsEnabled(GL_PRIMITIVE_RESTART);
}
void restore_primitive_restart(const Functions& gl, const SavedState& s) {
  set_primitive_restart(gl, s.primitive_restart);
}

void query_transform_feedback(const Functions& gl, SavedState& s) {
  if (has_feedback_objects(gl)) s.transform_feedback = integer(gl, GL_TRANSFORM_FEEDBACK_BINDING);
}
void restore_transform_feedback(const Functions& gl, const SavedState& s) {
  if (has_feedback_objects(gl)) gl.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, s.transform_feedback);
}

// If there are transform-feedback objects, the indexed binding is part of Nook's own object. Only the generic
// binding is shared with the host.
void query_feedback_buffer(const Functions& gl, SavedState& s) {
  s.feedback_buffer.generic = integer(gl, GL_TRANSFORM_FEEDBACK_BUFFER_BINDING);
  if (!has_feedback_objects(gl))
    s.feedback_buffer.range =
        indexed_range(gl, GL_TRANSFORM_FEEDBACK_BUFFER_BINDING, GL_TRANSFORM_FEEDBACK_BUFFER_START,
                      GL_TRANSFORM_FEEDBACK_BUFFER_SIZE, 0);
}
void restore_feedback_buffer(const Functions& gl, const SavedState& s) {
  if (!has_feedback_objects(gl)) bind_range(gl, GL_TRANSFORM_FEEDBACK_BUFFER, 0, s.feedback_buffer.range);
  gl.BindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, s.feedback_buffer.generic);
}

void query_storage_buffer(const Functions& gl, SavedState& s) {
  s.storage_buffer = integer(gl, GL_SHADER_STORAGE_BUFFER_BINDING);
}
// Does nothing, because binding a range also changes the generic binding. restore_storage_ranges binds the
// ranges first and then restores the generic binding.
void restore_storage_buffer(const Functions&, const SavedState&) {}

void query_storage_ranges(const Functions& gl, SavedState& s) {
  for (GLuint i = 0; i < storage_binding_count; ++i)
    s.storage_ranges[i] = indexed_range(gl, GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
                                        GL_SHADER_STORAGE_BUFFER_SIZE, i);
}
void restore_storage_ranges(const Functions& gl, const SavedState& s) {
  for (GLuint i = 0; i < storage_binding_count; ++i)
    bind_range(gl, GL_SHADER_STORAGE_BUFFER, i, s.storage_ranges[i]);
  gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, s.storage_buffer);
}

namespace {

void query_all(const Functions& gl, unsigned users, SavedState& state) {
#define NOOK_X(name, item_users, what, note) \
  if (users & (item_users)) query_##name(gl, state);
  NOOK_GL_TOUCHED_STATE(NOOK_X)
#undef NOOK_X
}

void restore_all(const Functions& gl, unsigned users, const SavedState& state) {
#define NOOK_X(name, item_users, what, note) \
  if (users & (item_users)) restore_##name(gl, state);
  NOOK_GL_TOUCHED_STATE(NOOK_X)
#undef NOOK_X
}

}  // namespace

StateGuard::StateGuard(Device& device, unsigned users) : device_(device), users_(users) {
  if (device.state_mode == NOOK_GL_STATE_PRESERVE) query_all(device.gl, users, saved_);
  device.begin_call();
}

StateGuard::~StateGuard() {
  const Functions& gl = device_.gl;
  if (device_.state_mode != NOOK_GL_STATE_HOST) {
    restore_all(gl, users_, saved_);
  } else if (users_ & tier_33) {
    // If these two capabilities stayed enabled, the host's next draw would be invisible or wrong.
    gl.Disable(GL_RASTERIZER_DISCARD);
    set_primitive_restart(gl, false);
  }
  device_.end_call();
}

}  // namespace nook::gl
