// Values that are the same for all pixels of a frame. sdk/src/gl/nnao/frame_constants.cpp computes them.
// Pixel coordinates are relative to the viewport, with (0, 0) at its lower left corner. The surface is the
// viewport at the resolution of AO: every pixel, or every second pixel of every second row.
#include "shaders/nnao/layout.h"
uniform highp vec4 nook_frame[NOOK_FRAME_VEC4S];

#define nook_screen_rays nook_frame[NOOK_FRAME_SCREEN_RAYS]   // x_scale, x_offset, y_scale, y_offset of the rays through pixels of the screen
#define nook_surface_rays nook_frame[NOOK_FRAME_SURFACE_RAYS]  // the same values for the rays through texels of the surface
#define nook_depth_decode nook_frame[NOOK_FRAME_DEPTH_DECODE]  // depth = (x + y s) / (z + w s); s is the stored value plus nook_stored_slope, or see nook_log_rate
#define nook_far_stored nook_frame[NOOK_FRAME_FAR].x  // the stored value of the far plane
#define nook_far_sign nook_frame[NOOK_FRAME_FAR].y    // 1: stored values increase with the distance; -1: they decrease
#define nook_min_depth nook_frame[NOOK_FRAME_FAR].z
#define nook_writes_bent_normals (nook_frame[NOOK_FRAME_FAR].w != 0.0)
#define nook_spread nook_frame[NOOK_FRAME_SPREAD].xy  // the extent of the screen at a depth is x * depth + y: (1, 0) if perspective, (0, 1) if orthographic
#define nook_edges_per_metre nook_frame[NOOK_FRAME_SPREAD].z  // 1 / the change of depth that is treated as an edge
#define nook_edges_per_extent nook_frame[NOOK_FRAME_INPUT].y  // like nook_edges_per_metre, but relative to the extent; used if the radius is in pixels
#define nook_array_layer int(nook_frame[NOOK_FRAME_INPUT].z)  // layer of the host's texture arrays
#define nook_log_rate nook_frame[NOOK_FRAME_INPUT].x  // if not 0, depth is logarithmic and s = exp2(nook_log_rate * stored)
#define nook_range_sharpness nook_frame[NOOK_FRAME_SPREAD].w  // for the filter along y: AO values that differ by more than 2 / sharpness are not averaged
#define nook_radius nook_frame[NOOK_FRAME_RADIUS].x         // metres
#define nook_max_radius_px nook_frame[NOOK_FRAME_RADIUS].y  // texels of the surface
#define nook_min_radius_px nook_frame[NOOK_FRAME_FADE].x    // texels of the surface, at most nook_max_radius_px
#define nook_fade nook_frame[NOOK_FRAME_FADE].yz            // (1 - AO) is multiplied by x * depth + y, clamped
#define nook_intensity nook_frame[NOOK_FRAME_RADIUS].z
#define nook_power nook_frame[NOOK_FRAME_RADIUS].w
#define nook_normal_scale nook_frame[NOOK_FRAME_NORMAL].x
#define nook_normal_bias nook_frame[NOOK_FRAME_NORMAL].y
#define nook_shortest_normal nook_frame[NOOK_FRAME_NORMAL].z  // texels shorter than this do not contain a normal; 0: the host has no normals
#define nook_has_normals (nook_shortest_normal != 0.0)
#define nook_layer_mode int(nook_frame[NOOK_FRAME_NORMAL].w)
#define nook_origin ivec2(nook_frame[NOOK_FRAME_VIEWPORT].xy)  // lower left pixel of the viewport in the host's textures
#define nook_screen_size ivec2(nook_frame[NOOK_FRAME_VIEWPORT].zw)
#define nook_surface_last nook_frame[NOOK_FRAME_SURFACE].xy  // texel of the upper right corner
#define nook_surface_size (ivec2(nook_surface_last) + 1)
#define nook_stored_slope nook_frame[NOOK_FRAME_SURFACE].zw  // added to stored depth for each pixel along x and y; 0 unless the projection is oblique
#define nook_normal_matrix mat3(nook_frame[NOOK_FRAME_NORMAL_MATRIX].xyz, nook_frame[NOOK_FRAME_NORMAL_MATRIX + 1].xyz, nook_frame[NOOK_FRAME_NORMAL_MATRIX + 2].xyz)

#define nook_noise_shift vec2(nook_frame[NOOK_FRAME_NORMAL_MATRIX].w, nook_frame[NOOK_FRAME_NORMAL_MATRIX + 1].w)  // shift of the noise in this frame
#define nook_own_weight nook_frame[NOOK_FRAME_NORMAL_MATRIX + 2].w  // weight of the centre texel in the filter: 1, or a value so large that the filter has no effect

// The depth where there is no surface, which is the sky or the far plane. Its square does not overflow a
// float.
const float nook_no_surface = 1.0e15;

bool nook_inside(ivec2 texel, ivec2 size) {
  return all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, size));
}

// Returns the extent at a depth. The extent times a pixel's ray is the x and y in view space.
float nook_extent(float depth) {
  return nook_spread.x * depth + nook_spread.y;
}

// Returns the extent at a depth, divided by the smallest change of depth that is treated as an edge at this
// depth.
float nook_edge_scale(float depth) {
  return nook_extent(depth) * nook_edges_per_metre + nook_edges_per_extent;
}

// Returns the view-space position of the centre of a pixel at a depth.
vec3 nook_position(vec4 rays, vec2 pixel, float depth) {
  return vec3((rays.xz * pixel + rays.yw) * nook_extent(depth), -depth);
}

vec3 nook_to_viewer(vec3 position) {
  return nook_spread.y != 0.0 ? vec3(0.0, 0.0, 1.0) : normalize(-position);
}

// Returns the texels of the surface per metre at a depth.
vec2 nook_pixel_scale(float depth) {
  return 1.0 / (nook_surface_rays.xz * nook_extent(depth));
}

// Returns the radius of a pixel in metres and in texels, and the factor by which the pixel's darkness (1 -
// AO) is multiplied. The radius is reduced if it covers too many texels, and enlarged if it covers too few.
// If it is enlarged, an occluder darkens more texels, and the factor keeps the total darkness the same. The
// factor also contains the fade with distance.
vec3 nook_pixel_radius(vec2 scale, float depth) {
  float per_metre = abs(scale.y), wanted = nook_radius * per_metre;
  float texels = clamp(wanted, nook_min_radius_px, nook_max_radius_px);
  float share = min(wanted / texels, 1.0) * clamp(nook_fade.x * depth + nook_fade.y, 0.0, 1.0);
  return vec3(texels / per_metre, texels, share);
}
