#version 330 core
#extension GL_ARB_texture_gather : require
// A version of XeGTAO (F. Strugar, S. Mccalla, Intel XeGTAO, 2021), written from its description. XeGTAO is
// GTAO (J. Jimenez, X. Wu, A. Pesce, A. Jarabo, Practical realtime strategies for accurate indirect occlusion,
// 2016) with three changes. Each tap reads one of five depth levels. The horizon of a distant tap fades
// towards the tangent plane. The noise is the R2 sequence, indexed by the pixel's position along a Hilbert
// curve. The pass also writes the edges for its denoiser.
#include "bakers/measure/nnao/shaders/surface.glsl"
#include "bakers/lab/nnao/shaders/edges.glsl"

#ifndef NOOK_BORDER
#define NOOK_BORDER 2  // as in baseline.glsl
#endif
#ifndef NOOK_STEPS
#define NOOK_STEPS 3  // on one side of a slice
#endif
#ifndef NOOK_THIN
#define NOOK_THIN 0  // 1: applies `thin`
#endif

uniform sampler2D depth_levels;   // metres, five levels; sampled clamped and without filtering
uniform sampler2D hilbert_image;  // positions along a Hilbert curve over 64 x 64 pixels
uniform vec2 texel;               // 1 / size
uniform float radius_scale;
uniform int groups;        // slices
uniform float falloff;     // fraction of the radius over which taps fade
uniform float power;
uniform float thin;        // compensation for thin occluders: the depth difference of a tap is scaled by 1 + thin
uniform float output_scale;

layout(location = 0) out float result;
layout(location = 1) out float packed_edges;
#ifdef NOOK_BENT_NORMALS
layout(location = 2) out vec4 bent_normal;  // view space
#endif

const float pi = 3.14159265;
const float mip_offset = 3.3;          // log2 of the tap distance in pixels up to which taps read level 0
const float too_close_px = 1.3;        // smallest distance of a tap
const float golden_ratio = 0.61803399;

vec2 pixel_noise(ivec2 pixel) {
  float place = texelFetch(hilbert_image, pixel & 63, 0).r;
  return fract(0.5 + place * vec2(0.75487767, 0.56984029));
}

// Returns an approximate arc cosine (S. Lagarde, Inverse trigonometric functions GPU optimization, 2014). The
// square root is estimated from the bits of the float (M. Drobot, Low level optimizations for GCN, 2014). The
// error is at most 0.02.
float fast_acos(float x) {
  float size = abs(x);
  float root = intBitsToFloat(0x1fbd1df5 + (floatBitsToInt(max(1.0 - size, 0.0)) >> 1));
  float angle = (0.5 * pi - 0.156583 * size) * root;
  return x < 0.0 ? pi - angle : angle;
}

// The values that all taps of a pixel share.
struct Centre {
  vec3 position, viewer;
  vec2 fade;  // a tap's weight is fade.y - fade.x * distance, in metres
};

// Returns the cosine of the angle between the directions to the viewer and to a tap. Distant taps fade to the
// cosine of the tangent plane.
float tap_cosine(Centre centre, vec2 offset_px, float level, float lowest) {
  vec2 at_px = gl_FragCoord.xy + offset_px;
#if NOOK_BORDER == 1
  at_px = clamp(at_px, vec2(0.5), vec2(size_px) - 0.5);
#endif
  float depth = textureLod(depth_levels, at_px * texel, level).r;
  vec3 v = vec3((screen_rays.xz * at_px + screen_rays.yw) * depth, -depth) - centre.position;
  float squared = dot(v, v), inverse = inversesqrt(squared), away = squared * inverse;
#if NOOK_THIN
  away = length(vec3(v.xy, v.z * (1.0 + thin)));
#endif
  float weight = clamp(centre.fade.y - away * centre.fade.x, 0.0, 1.0);
#if NOOK_BORDER == 0
  if (at_px != clamp(at_px, vec2(0.0), vec2(size_px))) weight = 0.0;
#endif
  return mix(lowest, dot(v, centre.viewer) * inverse, weight);
}

// Returns the cosine-weighted integral from the direction to the viewer to an angle, as in slice.glsl.
float arc(float angle, float tilt, float cos_tilt, float sin_tilt) {
  return 0.25 * (cos_tilt + 2.0 * angle * sin_tilt - cos(2.0 * angle - tilt));
}

// Returns the cosine-weighted integral of the directions between the viewer and an angle. x is the component
// along the slice, and y the component towards the viewer. It is the integral of cos(a - tilt) |sin a| (sin
// a, cos a).
vec2 arc_mean(float angle, float tilt) {
  float once = sin(angle - tilt) + sin(tilt), thrice = (sin(3.0 * angle - tilt) + sin(tilt)) / 3.0;
  return vec2(0.5 * once - 0.25 * (thrice + sin(angle + tilt) - sin(tilt)),
              0.25 * ((cos(tilt) - cos(3.0 * angle - tilt)) / 3.0 + cos(tilt) - cos(angle + tilt)));
}

// Returns the visibility of a slice, and adds its open directions to `bent`.
float slice_visibility(int slice, vec2 noise, Centre centre, vec3 normal, float facing, float radius_px, inout vec3 bent) {
  float turn = pi * (float(slice) + noise.x) / float(groups);
  vec2 direction = vec2(cos(turn), sin(turn));
  vec3 across = vec3(direction, 0.0) - dot(direction, centre.viewer.xy) * centre.viewer;
  float rise = dot(normal, across) * inversesqrt(dot(across, across));
  float inverse = inversesqrt(max(rise * rise + facing * facing, 1.0e-12));
  float cos_tilt = clamp(facing * inverse, 0.0, 1.0), sin_tilt = rise * inverse;
  float tilt = sign(rise) * fast_acos(cos_tilt);
  float ahead = -sin_tilt, behind = sin_tilt;
  for (int k = 0; k < NOOK_STEPS; ++k) {
    float share = (float(k) + fract(noise.y + golden_ratio * float(slice + k * NOOK_STEPS))) / float(NOOK_STEPS);
    float distance_px = share * share * radius_px + too_close_px;
    float level = clamp(log2(distance_px) - mip_offset, 0.0, 5.0);
    vec2 offset_px = floor(distance_px * direction + 0.5);
    ahead = max(ahead, tap_cosine(centre, offset_px, level, -sin_tilt));
    behind = max(behind, tap_cosine(centre, -offset_px, level, sin_tilt));
  }
  // Mixes in a twentieth of 1, because open planes at a slant would be too dark otherwise. The cause is that
  // slice directions are uniform on the screen. Away from the middle of the image, they are not uniform around
  // the direction to the viewer. GTAO cancels this error by a division, but XeGTAO as published does not.
  float projected = mix((rise * rise + facing * facing) * inverse, 1.0, 0.05);
#ifdef NOOK_BENT_NORMALS
  vec2 mean = projected * (arc_mean(fast_acos(ahead), tilt) + arc_mean(-fast_acos(behind), tilt));
  bent += mean.x * normalize(across) + mean.y * centre.viewer;
#endif
  return projected * (arc(fast_acos(ahead), tilt, cos_tilt, sin_tilt) + arc(-fast_acos(behind), tilt, cos_tilt, sin_tilt));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 low = textureGather(depth_levels, vec2(pixel) * texel), high = textureGather(depth_levels, vec2(pixel + 1) * texel);
  float depth = low.y;
  packed_edges = pack_edges(edge_weights(depth, vec4(low.x, high.z, low.z, high.x)));
  result = output_scale;
#ifdef NOOK_BENT_NORMALS
  bent_normal = vec4(0.0);
#endif
  if (depth >= far_depth) return;
  vec2 radius = pixel_radius(depth) * radius_scale;
  // Moves the position slightly towards the viewer, so that rounding of depths does not make a plane occlude
  // itself.
  vec3 position = position_at(pixel, 0.99999 * depth);
  Centre centre = Centre(position, normalize(-position), vec2(1.0 / radius.x, 1.0) / falloff);
  vec3 normal = normal_at(pixel);
  float facing = dot(normal, centre.viewer);
  vec2 noise = pixel_noise(pixel);
  // The AO fades out for small radii.
  float open = 0.5 * clamp((10.0 - radius.y) / 100.0, 0.0, 1.0);
  vec3 bent = vec3(0.0);
  for (int slice = 0; slice < groups; ++slice)
    open += slice_visibility(slice, noise, centre, normal, facing, radius.y, bent);
#ifdef NOOK_BENT_NORMALS
  bent_normal = vec4(normalize(bent + 1.0e-6 * normal), 1.0);
#endif
  result = output_scale * max(pow(max(open, 0.0) / float(groups), power), 0.03);
}
