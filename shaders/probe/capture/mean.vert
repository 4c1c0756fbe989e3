// Adds up the sums of all rows of a cube map. Then updates the average over maps with the result. One point
// is drawn for each sum.
#include "shaders/core/texels.glsl"
#include "shaders/probe/capture/layout.h"

uniform NOOK_TEXELS nook_table;
uniform ivec4 nook_rows;        // texel of the first sum of the first row, number of sums per row, number of rows, texel of the average so far
uniform vec2 nook_scale_share;  // a factor of the mean, and the share of this map in the average

out vec4 nook_mean;  // w: the solid angle of the texels that were used, steradians

void main() {
  vec4 sum = vec4(0.0);
  int texel = nook_rows.x + gl_VertexID;
  for (int row = 0; row < nook_rows.z; ++row, texel += nook_rows.y) sum += nook_texel(nook_table, texel);
  vec4 before = nook_texel(nook_table, nook_rows.w + gl_VertexID);
  // A map in which no texel is finite does not change the average.
  float share = sum.w > 0.0 ? nook_scale_share.y : 0.0;
  nook_mean.xyz = mix(before.xyz, sum.xyz * (nook_scale_share.x / max(sum.w, 1e-30)), share);
  nook_mean.w = mix(before.w, sum.w, nook_scale_share.y);
  gl_Position = vec4(0.0);
}
