// A host's shader can include these functions to shade the instances of a scene with their lights. `light`
// comes from nook_gl_view; normals are unit vectors in world space; colours are linear RGB.
#include "shaders/character/bent_normal.glsl"
#include "shaders/character/light_layout.h"
#include "shaders/core/texels.glsl"
#include "shaders/probe/irradiance.glsl"

// shaders/character/light_layout.h defines the layout.
uniform NOOK_TEXELS nook_scene_lights;

// Returns the irradiance of the lobes on an open surface. The sum of lobes that were fitted to probes can be
// slightly negative. Negative values are clamped to 0.
vec3 nook_scene_open_irradiance(int light, vec3 normal_ws) {
  int count = int(nook_texel(nook_scene_lights, light + NOOK_LIGHT_HEAD).x);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < count; ++i) {
    int lobe = light + NOOK_LIGHT_LOBES + NOOK_LIGHT_LOBE_TEXELS * i;
    vec4 shape = nook_texel(nook_scene_lights, lobe);
    vec3 amplitude = nook_texel(nook_scene_lights, lobe + 1).xyz;
    sum += nook_sg_lobe_irradiance(NookLobe(shape.xyz, shape.w, amplitude, 0.0), normal_ws);
  }
  return max(sum, 0.0);
}

// Returns the irradiance that is left after occlusion by bodies, ground and occluders. Pass the directional
// AO of the vertex from nook_gl_view.
vec3 nook_scene_irradiance(int light, vec3 normal_ws, vec3 directional_ao) {
  return nook_scene_open_irradiance(light, normal_ws) * directional_ao;
}
