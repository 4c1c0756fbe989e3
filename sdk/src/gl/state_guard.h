// Implements nook_gl_state_mode for a call. Depending on the mode, the guard saves and restores the OpenGL
// state, resets it to defaults, or does nothing.
#pragma once

#include <nook/nook_gl.h>

#include <cstddef>
#include <iterator>
#include <span>

#include "sdk/src/gl/device.h"
#include "sdk/src/gl/functions.h"
#include "sdk/src/gl/touched_state.h"

namespace nook::gl {

struct BufferRange {
  GLint buffer = 0;
  GLint64 offset = 0;  // bytes
  GLint64 size = 0;    // bytes; 0: the whole buffer
};

// The capabilities that the item fragment_tests saves. OpenGL ES has only the first five, and from
// version 3.1 on also GL_SAMPLE_MASK.
inline constexpr GLenum fragment_tests[] = {
    GL_DEPTH_TEST,     GL_STENCIL_TEST,   GL_CULL_FACE,      GL_SAMPLE_COVERAGE, GL_SAMPLE_ALPHA_TO_COVERAGE,
    GL_SAMPLE_MASK,    GL_COLOR_LOGIC_OP, GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE1,  GL_CLIP_DISTANCE2,
    GL_CLIP_DISTANCE3, GL_CLIP_DISTANCE4, GL_CLIP_DISTANCE5, GL_CLIP_DISTANCE6,  GL_CLIP_DISTANCE7};
inline constexpr std::size_t fragment_test_count = std::size(fragment_tests);
inline std::span<const GLenum> fragment_tests_of(const Functions& gl) {
  const std::size_t es = gl.profile == Profile::es && gl.version >= 31 ? 6 : 5;
  return std::span(fragment_tests).first(gl.profile == Profile::desktop ? fragment_test_count : es);
}

// The initial values of the members are OpenGL's defaults.
struct BlendState {
  GLboolean enabled = GL_FALSE;
  GLint source_rgb = GL_ONE, destination_rgb = GL_ZERO, source_alpha = GL_ONE, destination_alpha = GL_ZERO;
  GLint equation_rgb = GL_FUNC_ADD, equation_alpha = GL_FUNC_ADD;
};

// OpenGL ES does not have the last two of these parameters.
inline constexpr GLenum pixel_store_names[] = {
    GL_UNPACK_ALIGNMENT,   GL_UNPACK_ROW_LENGTH,  GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_ROWS,
    GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_IMAGES, GL_UNPACK_SWAP_BYTES,   GL_UNPACK_LSB_FIRST};
struct PixelStore {
  GLint values[std::size(pixel_store_names)] = {4};
};

// OpenGL ES does not have the last of these parameters.
inline constexpr GLenum pixel_pack_names[] = {GL_PACK_ALIGNMENT, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS,
                                              GL_PACK_SKIP_PIXELS, GL_PACK_SWAP_BYTES};
struct PixelPack {
  GLint values[std::size(pixel_pack_names)] = {4};
};

struct ImageUnit {
  // If `format` is 0, it means the default of the API: GL_R8, or GL_R32UI on OpenGL ES.
  GLint texture = 0, level = 0, layered = GL_FALSE, layer = 0, access = GL_READ_ONLY, format = 0;
};

struct SavedState {
  GLint program = 0;
  GLint array_buffer = 0;
  GLint vertex_array = 0;
  GLint active_texture = GL_TEXTURE0;
  GLint texture_unit_0 = 0;
  GLint draw_framebuffer = 0, read_framebuffer = 0;
  GLint renderbuffer = 0;
  GLboolean rasterizer_discard = GL_FALSE;
  GLboolean primitive_restart = GL_FALSE;
  GLint transform_feedback = 0;
  struct {
    GLint generic = 0;
    BufferRange range;
  } feedback_buffer;
  GLint storage_buffer = 0;
  BufferRange storage_ranges[storage_binding_count];
  GLint texture_2d[texture_unit_count] = {};
  GLint samplers[texture_unit_count] = {};
  GLint filter_texture = 0;
  ImageUnit image_unit;
  GLint texture_2d_array = 0;
  GLint texture_3d = 0;
  GLint cube_map = 0;
  GLint capture_samplers[2] = {};
  GLint layer_textures[std::size(layer_units)] = {};
  GLint sample_texture = 0, sample_array = 0;
  GLint pixel_unpack_buffer = 0, pixel_pack_buffer = 0;
  PixelStore pixel_store;
  PixelPack pixel_pack;
  struct {
    bool known = false;  // false: not saved, and there is no default
    GLfloat box[4] = {};
  } viewport;
  BlendState blend;
  GLboolean color_mask[4] = {GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE};
  GLint polygon_mode = GL_FILL;
  GLboolean scissor_test = GL_FALSE;
  GLboolean framebuffer_srgb = GL_FALSE;
  GLboolean fragment_tests[fragment_test_count] = {};
  GLboolean dither = GL_TRUE;
  GLint query_buffer = 0;
};

// These functions change only draw buffer 0 and viewport 0 if OpenGL has separate state for them.
void set_blend(const Functions& gl, const BlendState& blend);
void set_viewport(const Functions& gl, const GLfloat (&box)[4]);
void set_pixel_store(const Functions& gl, const PixelStore& store);
void set_pixel_pack(const Functions& gl, const PixelPack& pack);
void set_scissor_test(const Functions& gl, bool enabled);
// Does nothing on OpenGL ES, where the restart index is fixed by the index type.
void set_primitive_restart(const Functions& gl, bool enabled);
// Sets blending, masks, tests and capabilities so that a triangle fills the viewport without side effects.
void set_plain_drawing(const Functions& gl);

// While a guard exists, passes may change any state in touched_state.h. If passes delete objects during this
// time, the guard deletes them after it has restored the state. Transform feedback must end before the guard
// is destroyed.
class StateGuard {
 public:
  // `users` selects the items of NOOK_GL_TOUCHED_STATE.
  StateGuard(Device& device, unsigned users);
  ~StateGuard();
  StateGuard(const StateGuard&) = delete;
  StateGuard& operator=(const StateGuard&) = delete;

 private:
  Device& device_;
  unsigned users_;
  SavedState saved_;
};

// Returns the users whose state the evaluation of characters changes.
inline unsigned character_users(const Functions& gl) {
  return unsigned{gl.can.compute ? tier_43 : tier_33} |
         (gl.can.texture_buffers ? 0u : unsigned{texel_uploads});
}
// Returns the users whose state the upload of probes changes.
inline unsigned probe_users(const Functions& gl) {
  return probes | (gl.can.texture_buffers ? 0u : unsigned{texel_uploads});
}

// Returns the users whose state the creation of a screen-space pass changes. The creation also uploads
// filters.
inline unsigned screen_creation_users(const Functions& gl) {
  return screen | (gl.can.texture_buffers ? 0u : unsigned{texel_uploads});
}

// Declares a query function and a restore function for each item of the list. If you restore a
// default-constructed SavedState, the item gets OpenGL's default.
#define NOOK_X(name, users, what, note)                  \
  void query_##name(const Functions& gl, SavedState& s); \
  void restore_##name(const Functions& gl, const SavedState& s);
NOOK_GL_TOUCHED_STATE(NOOK_X)
#undef NOOK_X

}  // namespace nook::gl
