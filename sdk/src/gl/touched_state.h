// The OpenGL state that Nook touches, as one list: the guard, docs/gl_state.md and the poisoned-state test
// expand it.
#pragma once

namespace nook::gl {

enum : unsigned {
  tier_33 = 1,
  tier_43 = 2,
  tier_any = 3,
};

// X(name, tiers, state as OpenGL calls it, what for and its default). An item needs a member of SavedState
// and a query, a restore and a reset of that name in state_guard.cpp.
#define NOOK_GL_TOUCHED_STATE(X)                                                                        \
  X(program, tier_any, "GL_CURRENT_PROGRAM", "runs the passes; default 0")                              \
  X(array_buffer, tier_any, "GL_ARRAY_BUFFER_BINDING", "every upload goes through it; default 0")       \
  X(vertex_array, tier_33, "GL_VERTEX_ARRAY_BINDING", "inputs of the vertex pass; default 0")           \
  X(active_texture, tier_33, "GL_ACTIVE_TEXTURE", "selects unit 0; default GL_TEXTURE0")                \
  X(texture_unit_0, tier_33, "GL_TEXTURE_BINDING_BUFFER of unit 0", "shadows at key points; default 0") \
  X(draw_framebuffer, tier_33, "GL_DRAW_FRAMEBUFFER_BINDING",                                           \
    "a draw needs a complete framebuffer; default 0")                                                   \
  X(renderbuffer, tier_33, "GL_RENDERBUFFER_BINDING", "in nook_gl_create only; default 0")              \
  X(rasterizer_discard, tier_33, "GL_RASTERIZER_DISCARD", "nothing is drawn; default disabled")         \
  X(primitive_restart, tier_33, "GL_PRIMITIVE_RESTART", "every index is a vertex; default disabled")    \
  X(transform_feedback, tier_33, "GL_TRANSFORM_FEEDBACK_BINDING", "from OpenGL 4.0 on; default 0")      \
  X(feedback_buffer, tier_33, "GL_TRANSFORM_FEEDBACK_BUFFER_BINDING and its range, index 0",            \
    "AO; default 0")                                                                                    \
  X(storage_buffer, tier_43, "GL_SHADER_STORAGE_BUFFER_BINDING", "binding a range sets it; default 0")  \
  X(storage_ranges, tier_43, "GL_SHADER_STORAGE_BUFFER_BINDING and its range, index 0 to 7",            \
    "passes; default 0")

inline constexpr int storage_binding_count = 8;

}  // namespace nook::gl
