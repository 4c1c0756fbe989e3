// Call nook_clip_ao in your vertex shader to get the AO of baked clips. Fill the two textures with the data
// that nook_clips_read_table writes. Each vertex and each frame has nook_clip_vec4s consecutive texels.
#include "shaders/core/texel_layout.h"

uniform highp sampler2D nook_clip_modes, nook_clip_weights;
uniform int nook_clip_vec4s;

vec4 nook_clip_texel(highp sampler2D table, int number) {
  return texelFetch(table, ivec2(number & (NOOK_TEXEL_ROW - 1), number >> NOOK_TEXEL_ROW_SHIFT), 0);
}

// Returns the AO that the character itself causes, in [0, 1]. Pass the frames and the share that
// nook_clips_frames returns.
float nook_clip_ao(int vertex, ivec2 frames, float share) {
  ivec2 weights = frames * nook_clip_vec4s;
  int modes = vertex * nook_clip_vec4s;
  float ao = 0.5;
  for (int k = 0; k < nook_clip_vec4s; ++k)
    ao += dot(nook_clip_texel(nook_clip_modes, modes + k),
              mix(nook_clip_texel(nook_clip_weights, weights.x + k),
                  nook_clip_texel(nook_clip_weights, weights.y + k), share));
  return clamp(ao, 0.0, 1.0);
}
