// Writes the surface: normals for every pixel, or depth and normal of every second pixel of every second row.
#include "shaders/nnao/normal.glsl"
#include "shaders/nnao/octahedral.glsl"

#if NOOK_HALF || defined(GL_ES)
out uvec2 nook_out;
#else
out vec2 nook_out;
#endif

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
#if NOOK_HALF
  ivec2 pixel = 2 * texel;
#else
  ivec2 pixel = texel;
#endif
  float depth = nook_screen_depth(pixel);
  vec2 normal = vec2(0.5);
  if (depth != nook_no_surface) normal = nook_octahedral(nook_pixel_normal(pixel, depth));
#if NOOK_HALF
  uvec2 bits = uvec2(normal * 65535.0 + 0.5);
  nook_out = uvec2(floatBitsToUint(depth), bits.x | bits.y << 16);
#elif defined(GL_ES)
  nook_out = uvec2(normal * 65535.0 + 0.5);  // OpenGL ES draws into no normalised 16-bit format
#else
  nook_out = normal;
#endif
}
