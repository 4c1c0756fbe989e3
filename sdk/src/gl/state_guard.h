// Keeps the promise of nook_gl_state_mode round a call: saves before and puts back after, or resets to
// defaults, or neither.
#pragma once

#include <nook/nook_gl.h>

#include "gl/functions.h"
#include "gl/touched_state.h"

namespace nook::gl {

struct BufferRange {
  GLint buffer = 0;
  GLint64 offset = 0;  // bytes
  GLint64 size = 0;    // bytes; 0: the whole buffer
};

struct SavedState {
  GLint program = 0;
  GLint array_buffer = 0;
  GLint vertex_array = 0;
  GLint active_texture = GL_TEXTURE0;
  GLint texture_unit_0 = 0;
  GLint draw_framebuffer = 0;
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
};

// Until its end the passes may leave any of the touched state changed. Transform feedback must be ended by
// then.
class StateGuard {
 public:
  StateGuard(const Functions& gl, nook_gl_state_mode mode);
  ~StateGuard();
  StateGuard(const StateGuard&) = delete;
  StateGuard& operator=(const StateGuard&) = delete;

 private:
  const Functions& gl_;
  nook_gl_state_mode mode_;
  SavedState saved_;
};

}  // namespace nook::gl
