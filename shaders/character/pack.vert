// Packs consecutive values into one word, which transform feedback writes to a host's buffer.
#include "shaders/character/pack.glsl"

layout(location = 0) in vec4 nook_values;
flat out uint nook_word;

void main() {
  nook_word = nook_packed(nook_values.x);
#if NOOK_VALUES_PER_WORD >= 2
  nook_word |= nook_packed(nook_values.y) << (32 / NOOK_VALUES_PER_WORD);
#endif
#if NOOK_VALUES_PER_WORD == 4
  nook_word |= nook_packed(nook_values.z) << 16;
  nook_word |= nook_packed(nook_values.w) << 24;
#endif
  gl_Position = vec4(0.0);
}
