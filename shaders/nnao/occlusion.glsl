// Computes the raw AO of a texel of the surface, by the network, and the edges around the texel. The fragment
// shader and the compute shader share this file.
#include "shaders/nnao/normal.glsl"
#include "shaders/nnao/taps.glsl"
#if NOOK_BENT_NORMALS
#include "shaders/nnao/bent_normal.glsl"
#endif
#if NOOK_HORIZON
#include "shaders/nnao/horizon.glsl"
#else
#include "shaders/nnao/paper.glsl"
#endif

// Returns AO, edges, and the bent normal in passes that have it.
vec4 nook_occlusion(ivec2 texel) {
  float depth = nook_depth_at(texel);
  if (depth == nook_no_surface) return vec4(1.0, 0.0, vec2(128.0 / 255.0));
  NookNeighbours around = nook_neighbours_of(texel, depth);
#if NOOK_HORIZON
  vec3 normal = nook_texel_normal(texel, around);
#else
  vec3 normal = nook_surface_normal(texel);
#endif
  vec2 scale = nook_pixel_scale(depth);
  vec3 position = nook_position(nook_surface_rays, vec2(texel), depth), bent;
  vec3 radius = nook_pixel_radius(scale, depth);
  float ao = nook_evaluate(texel, position, normal, scale, radius.xy, bent);
  // If the factor radius.z is 1, this is exactly AO.
  ao = radius.z * ao + (1.0 - radius.z);
  vec4 found = vec4(clamp(ao, 0.0, 1.0), nook_packed_edges(around.connected), 0.0, 1.0);
#if NOOK_BENT_NORMALS
  found.ba = nook_coded_bent_normal(radius.z * bent + (1.0 - radius.z) * normal, nook_to_viewer(position));
#endif
  return found;
}
