// Computes the AO that casters cause on the surfaces in the host's depth image. darken.frag and darken.comp
// include this file. AO is computed for every pixel, or at half resolution: for every second pixel of every
// second row. resolve.frag then upsamples it. At half resolution, the AO of far bodies is computed first, for
// every NOOK_FAR_STEP-th pixel along each axis. The AO of near bodies is then multiplied by it.
#include "shaders/nnao/host_depth.glsl"
#if NOOK_HALF
#include "shaders/nnao/depth.glsl"
#endif
#include "shaders/world/casters.glsl"

uniform sampler2D nook_host_normal;
// The lists of the bodies that may reach a tile are stored after the casters: one texel for each tile, then
// the entries.
uniform int nook_world_first_tile;
uniform int nook_world_tile_columns;  // 0: no body reaches the view
uniform int nook_world_tile_size;     // pixels along a side
uniform int nook_world_counts;        // not 0: a debug view (nook_world_view), which shows counters divided
                                      // by 255

#ifdef NOOK_LAYERED
bool nook_world_replaced(ivec2 pixel, float above) {
  return nook_layer_mode >= NOOK_LAYER_REPLACE && texelFetch(nook_layer, pixel + nook_origin, 0).g > above;
}
#endif

// The distance in pixels from a pixel of this stage to the next one whose depth is known.
#if NOOK_HALF
#define NOOK_NORMAL_STEP 2
#else
#define NOOK_NORMAL_STEP 1
#endif

// Returns the depth of a pixel beside a pixel of this stage. Returns nook_no_surface if there is no surface,
// or if the host's layer covers the pixel. Otherwise the floor next to a foot that the layer covers would get
// the normal of the foot.
float nook_world_depth_beside(ivec2 pixel) {
#if NOOK_HALF
  return nook_depth_near(pixel / NOOK_NORMAL_STEP);
#else
  ivec2 inside = clamp(pixel, ivec2(0), nook_screen_size - 1);
#ifdef NOOK_LAYERED
  if (nook_world_replaced(inside, NOOK_EXCLUDED_ABOVE)) return nook_no_surface;
#endif
  return nook_screen_depth(inside);
#endif
}

// Returns the surface tangent along an axis. It is the mean of the steps to both neighbours, weighted by the
// inverse square of their changes of depth. The reason for these weights is that depth changes more across a
// silhouette than on the pixel's own surface. `axis` is one pixel long.
vec3 nook_world_tangent(ivec2 pixel, ivec2 axis, vec3 position) {
  ivec2 step = NOOK_NORMAL_STEP * axis;
  vec2 depths = vec2(nook_world_depth_beside(pixel - step), nook_world_depth_beside(pixel + step));
#ifdef NOOK_LAYERED
  // If the pixel is between two fingers that the layer covers, both neighbours may have no surface. The loop
  // then looks for the surface beyond the fingers.
  for (int i = 0; i < 7 && min(depths.x, depths.y) == nook_no_surface; ++i) {
    step += NOOK_NORMAL_STEP * axis;
    depths = vec2(nook_world_depth_beside(pixel - step), nook_world_depth_beside(pixel + step));
  }
#endif
  vec3 back = position - nook_position(nook_screen_rays, vec2(pixel - step), depths.x);
  vec3 forth = nook_position(nook_screen_rays, vec2(pixel + step), depths.y) - position;
  // Beyond the border of the screen, the surface is assumed to continue.
  bool inside = nook_inside(pixel - step, nook_screen_size);
  if (inside != nook_inside(pixel + step, nook_screen_size)) return inside ? back : forth;
  float b = back.z * back.z + 1.0e-12, f = forth.z * forth.z + 1.0e-12;
  return b < f ? back + forth * (b / f) : back * (f / b) + forth;
}

vec3 nook_world_normal(ivec2 pixel, vec3 position) {
  if (nook_has_normals) {
    vec3 stored = texelFetch(nook_host_normal, pixel + nook_origin, 0).xyz;
    vec3 n = nook_normal_matrix * (stored * nook_normal_scale + nook_normal_bias);
    float size = length(n);
    // If the length is outside these bounds, the image does not have a normal here.
    if (size > nook_shortest_normal && size < 1.0e6) return n / size;
  }
  vec3 x = nook_world_tangent(pixel, ivec2(1, 0), position), y = nook_world_tangent(pixel, ivec2(0, 1), position);
  vec3 n = normalize(cross(x, y));
  return dot(n, nook_to_viewer(position)) < 0.0 ? -n : n;
}

#ifdef NOOK_COLOURED
// The first texel of the lists of bodies whose shadow may fall on a tile. The bodies are stored after these
// lists.
uniform int nook_world_first_light_tile;
uniform int nook_world_first_shade;
uniform int nook_world_light_columns;  // 0: there is no cone, or it is open

// A texel of a list holds four body indices. The loops rotate the vector, so that the next index is always in
// x. If the vector were indexed at run time, compilers would put it into memory or use four comparisons.
float nook_world_tile_light(ivec2 pixel, vec3 point) {
  if (nook_world_light_columns == 0) return 1.0;
  for (int i = 0; i < NOOK_CONE_PARTS; ++i) nook_world_parts[i] = 1.0;
  ivec2 tile = pixel / nook_world_tile_size;
  vec4 range = nook_texel(nook_world_casters, nook_world_first_light_tile + tile.y * nook_world_light_columns + tile.x);
  int first = nook_world_first_light_tile + int(range.x), count = int(range.y);
  vec4 bodies = vec4(0.0);
  for (int i = 0; i < count; ++i) {
    if ((i & 3) == 0) bodies = nook_texel(nook_world_casters, first + (i >> 2));
    nook_world_body_shade(nook_world_casters, nook_world_first_shade + NOOK_SHADE_TEXELS * int(bodies.x), point);
    bodies = bodies.yzwx;  // the next body comes to x
  }
  return nook_world_open_cone();
}
#endif

float nook_world_list_open(int first_tile, ivec2 pixel, vec3 point, vec3 normal) {
  if (nook_world_tile_columns == 0) return 1.0;
  ivec2 tile = pixel / nook_world_tile_size;
  vec4 range = nook_texel(nook_world_casters, first_tile + tile.y * nook_world_tile_columns + tile.x);
  int first = first_tile + int(range.x), count = int(range.y);
  float open = 1.0;
  vec4 bodies = vec4(0.0);
  for (int i = 0; i < count; ++i) {
    if ((i & 3) == 0) bodies = nook_texel(nook_world_casters, first + (i >> 2));
    open *= nook_world_body_open(int(bodies.x), point, normal);
    bodies = bodies.yzwx;  // the next body comes to x
  }
  return open;
}

// Returns the depth of a pixel of this stage. At half resolution, depth.frag has already removed the pixels
// that a layer replaces.
float nook_world_depth(ivec2 pixel) {
#if NOOK_HALF
  return nook_depth_at(pixel / 2);
#else
#ifdef NOOK_LAYERED
  if (nook_world_replaced(pixel, NOOK_REPLACED_ABOVE)) return nook_no_surface;
#endif
  return nook_screen_depth(pixel);
#endif
}

#if NOOK_BODIES == NOOK_NEAR_BODIES
uniform sampler2D nook_far_open;
uniform int nook_world_far;  // 0: no far body reaches the view

// A texel of the far bodies' AO: its point in view space, whether it has a surface, and the openness after
// occlusion by far bodies.
struct NookFarTexel {
  vec3 position;
  bool there;
  vec3 open;
};

NookFarTexel nook_fetch_far(ivec2 texel) {
  ivec2 pixel = NOOK_FAR_STEP * texel;
  float depth = nook_world_depth(pixel);
  return NookFarTexel(nook_position(nook_screen_rays, vec2(pixel), depth), depth != nook_no_surface,
                      texelFetch(nook_far_open, texel, 0).rgb);
}

// A compute stage keeps these texels in shared memory.
#ifdef NOOK_GROUPS
NookFarTexel nook_far_texel(ivec2 texel);
#else
#define nook_far_texel nook_fetch_far
#endif

// Returns the openness after occlusion by far bodies, interpolated from the four texels around this pixel. A
// texel has a large weight if its point is near the plane of the pixel's surface. Alpha is 0 if no point is
// near the plane.
vec4 nook_world_far_open(ivec2 pixel, vec3 point, vec3 normal) {
  ivec2 low = pixel / NOOK_FAR_STEP, last = (nook_screen_size - 1) / NOOK_FAR_STEP;
  vec2 place = vec2(pixel - NOOK_FAR_STEP * low) / float(NOOK_FAR_STEP);
  // The weight of a texel is halved if the distance of its point from the plane is a hundredth of the
  // distance from the camera.
  float inverse_off = 100.0 * inversesqrt(dot(point, point) + 1.0e-12);
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 corner = ivec2(i & 1, i >> 1);
    NookFarTexel far = nook_far_texel(min(low + corner, last));
    vec2 share = mix(1.0 - place, place, vec2(corner));
    float off = dot(normal, far.position - point) * inverse_off;
    float weight = far.there ? (share.x * share.y + 1.0e-3) / (1.0 + off * off * off * off) : 0.0;
    sum += weight * far.open;
    weights += weight;
  }
  // If the points of all four texels are far from the plane, the sum of their weights is below this
  // threshold.
  return weights > 5.0e-4 ? vec4(sum / weights, 1.0) : vec4(0.0);
}

uniform int nook_world_first_far_tile;

vec3 nook_world_far_here(ivec2 pixel, vec3 point, vec3 normal) {
  nook_world_far_bodies = true;
#ifdef NOOK_COLOURED
  nook_world_taken = NOOK_NOTHING_TAKEN;
#endif
  float open = nook_world_list_open(nook_world_first_far_tile, pixel, point, normal);
#ifdef NOOK_COLOURED
  return nook_world_open_light(normal, open);
#else
  return vec3(open);
#endif
}
#endif

struct NookSurface {
  bool there;
  vec3 position, normal;  // in view space
};

NookSurface nook_world_surface(ivec2 pixel) {
  float depth = nook_world_depth(pixel);
  if (depth == nook_no_surface) return NookSurface(false, vec3(0.0), vec3(0.0, 0.0, 1.0));
  vec3 position = nook_position(nook_screen_rays, vec2(pixel), depth);
  return NookSurface(true, position, nook_world_normal(pixel, position));
}

// Returns the counter that the debug view (nook_world_view) shows for this point, divided by 255.
float nook_world_count() {
  bool tests = nook_world_counts == NOOK_VIEW_TESTS || nook_world_counts == NOOK_VIEW_FAR_TESTS;
  int number = nook_world_counts == NOOK_VIEW_EXACT_CASTERS ? nook_world_exact
               : tests                                      ? nook_world_tested
                                                            : nook_world_evaluated;
  return float(number) / 255.0;
}

// `open` is the openness after occlusion by the bodies of this stage.
vec4 nook_world_light(ivec2 pixel, NookSurface surface, float open) {
  vec4 light = vec4(vec3(open), 1.0);
  float count = surface.there ? nook_world_count() : 0.0;
  if (surface.there) {
#ifdef NOOK_COLOURED
    light.rgb = nook_world_open_light(surface.normal, open);
#if NOOK_BODIES != NOOK_FAR_BODIES
    light.a = nook_world_tile_light(pixel, surface.position);
#endif
#endif
#if NOOK_BODIES == NOOK_NEAR_BODIES
    float seen = 0.0;
    if (nook_world_far == 1) {
      vec4 far = nook_world_far_open(pixel, surface.position, surface.normal);
      if (far.a == 0.0) {
        far.rgb = nook_world_far_here(pixel, surface.position, surface.normal);
        count = nook_world_count();
      } else {
        seen = far.r;
      }
      light.rgb *= far.rgb;
    }
    if (nook_world_counts == NOOK_VIEW_CASTERS) count += seen / float(NOOK_FAR_STEP * NOOK_FAR_STEP / 4);
    if (nook_world_counts >= NOOK_VIEW_FAR_CASTERS) count = seen;
#elif NOOK_BODIES == NOOK_ALL_BODIES
    if (nook_world_counts >= NOOK_VIEW_FAR_CASTERS) count = 0.0;
#endif
  }
  return nook_world_counts == 0 ? light : vec4(vec3(count), 1.0);
}
