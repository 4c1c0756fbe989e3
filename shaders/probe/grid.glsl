// Reads a probe, or a grid of probes, from a table of RGBA32F texels in the layout of
// sdk/src/gl/probe/probe_texture.cpp. The table contains, in this order: one texel with the grid's counts and
// the number of lobes, the origin, 1 / spacing, axis and sharpness of each lobe, and the amplitudes of each
// probe. Probes are ordered with x varying fastest, then y, then z. If the w of the origin is 1, the
// amplitudes for gloss follow in the same order.
#include "shaders/core/texels.glsl"
#include "shaders/probe/lobe.glsl"

uniform NOOK_TEXELS nook_probe_texels;

// The eight probes around a point, and their trilinear weights. Points outside the grid are clamped to it.
struct NookProbePlace {
  int lobe_count;
  int gloss;       // distance in texels from an amplitude of the light to the amplitude for gloss; 0 if the
                   // probes have none
  int first[8];    // texel of the first amplitude
  float weight[8];
};

NookProbePlace nook_probe_place(vec3 position_ws) {
  NookProbePlace place;
  vec4 head = nook_texel(nook_probe_texels, 0);
  ivec3 counts = ivec3(head.xyz);
  place.lobe_count = int(head.w);
  vec4 origin = nook_texel(nook_probe_texels, 1);
  vec3 inverse_spacing = nook_texel(nook_probe_texels, 2).xyz;
  place.gloss = int(origin.w) * place.lobe_count * counts.x * counts.y * counts.z;
  vec3 at = clamp((position_ws - origin.xyz) * inverse_spacing, vec3(0.0), vec3(counts - 1));
  ivec3 low = min(ivec3(at), max(counts - 2, 0));
  vec3 share = at - vec3(low);
  int row = counts.x, slice = counts.x * counts.y;
  for (int corner = 0; corner < 8; ++corner) {
    ivec3 step = ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
    ivec3 cell = min(low + step, counts - 1);
    vec3 w = mix(1.0 - share, share, vec3(step));
    place.first[corner] = 3 + place.lobe_count * (1 + cell.x + row * cell.y + slice * cell.z);
    place.weight[corner] = w.x * w.y * w.z;
  }
  return place;
}

// Returns lobe i at a place. Reads its amplitude `apart` texels after the amplitude of the light.
NookLobe nook_probe_read_lobe(NookProbePlace place, int i, int apart) {
  vec4 shape = nook_texel(nook_probe_texels, 3 + i);
  vec3 amplitude = vec3(0.0);
  for (int corner = 0; corner < 8; ++corner)
    if (place.weight[corner] > 0.0)
      amplitude += place.weight[corner] * nook_texel(nook_probe_texels, place.first[corner] + i + apart).xyz;
  return NookLobe(shape.xyz, shape.w, amplitude, 0.0);
}

// Returns lobe i of the light. Use it for irradiance.
NookLobe nook_probe_lobe_at(NookProbePlace place, int i) {
  return nook_probe_read_lobe(place, i, 0);
}

// Returns lobe i for glossy reflection. If the probe has amplitudes for gloss, the amplitude is never
// negative.
NookLobe nook_probe_gloss_lobe_at(NookProbePlace place, int i) {
  return nook_probe_read_lobe(place, i, place.gloss);
}
