// The openness that all casters of a frame leave at a point. The table holds two texels for each group, its sphere of
// reach and (first texel, number of casters), then two for each caster: its ends with their radii in AO.
#include "shaders/core/texels.glsl"
#include "shaders/world/coverage.glsl"

uniform NOOK_TEXELS nook_world_casters;
uniform int nook_world_groups;

float nook_world_open(vec3 point, vec3 normal) {
  float open = 1.0;
  for (int group = 0; group < nook_world_groups; ++group) {
    vec4 reach = nook_texel(nook_world_casters, 2 * group);
    vec3 d = reach.xyz - point;
    if (dot(d, d) > reach.w * reach.w) continue;
    vec4 range = nook_texel(nook_world_casters, 2 * group + 1);
    int first = int(range.x), last = first + 2 * int(range.y);
    for (int k = first; k < last; k += 2)
      open *= 1.0 - nook_world_coverage(nook_texel(nook_world_casters, k), nook_texel(nook_world_casters, k + 1),
                                        point, normal);
  }
  return open;
}
