// Runs an AO stage at half resolution as a compute shader. A group of threads reads the bodies of its tile
// once. It skips bodies that do not reach any point of the box around the group's surfaces. The remaining
// bodies are kept in shared memory, from which all threads of the group read them.
#define NOOK_GROUPS
#define nook_world_part_texel(number) nook_group_texel[number]
#include "shaders/world/constants.h"

layout(local_size_x = NOOK_WORLD_GROUP_SIZE, local_size_y = NOOK_WORLD_GROUP_SIZE) in;

// The number of bodies that a group keeps at a time. Each kept body is one bit in a mask. The mask ensures
// that bodies are always processed in the same order.
#define NOOK_GROUP_BODIES 32
shared uint nook_group_kept;
shared vec4 nook_group_bound[NOOK_GROUP_BODIES], nook_group_parts[NOOK_GROUP_BODIES];
// The parts of one near body, or the capsules that replace far bodies.
shared vec4 nook_group_texel[NOOK_MAX_PARTS * NOOK_PART_TEXELS];
// The box around the group's surfaces. Its floats are stored as integers that have the same order. The stage
// for far bodies also stores the box of the normals, and the minimum of dot(position, normal).
shared int nook_group_low[3], nook_group_high[3];
#include "shaders/world/darken.glsl"
#if NOOK_BODIES == NOOK_FAR_BODIES
shared int nook_group_normal_low[3], nook_group_normal_high[3], nook_group_minimum;
#endif

#if defined(GL_ES) || defined(NOOK_COLOURED)
layout(rgba8, binding = NOOK_IMAGE_UNIT) writeonly uniform image2D nook_out;  // OpenGL ES 3.1 cannot write r8
#else
layout(r8, binding = NOOK_IMAGE_UNIT) writeonly uniform image2D nook_out;
#endif

int nook_ordered(float number) {
  int bits = floatBitsToInt(number);
  return bits ^ ((bits >> 31) & 0x7fffffff);
}

float nook_number(int ordered) {
  return intBitsToFloat(ordered ^ ((ordered >> 31) & 0x7fffffff));
}

vec3 nook_numbers(int ordered[3]) {
  return vec3(nook_number(ordered[0]), nook_number(ordered[1]), nook_number(ordered[2]));
}

void nook_bound_group(NookSurface surface, int thread) {
  if (thread < 3) {
    nook_group_low[thread] = 0x7fffffff;
    nook_group_high[thread] = -0x7fffffff;
#if NOOK_BODIES == NOOK_FAR_BODIES
    nook_group_normal_low[thread] = nook_group_minimum = 0x7fffffff;
    nook_group_normal_high[thread] = -0x7fffffff;
#endif
  }
  barrier();
  if (surface.there) {
    for (int i = 0; i < 3; ++i) {
      atomicMin(nook_group_low[i], nook_ordered(surface.position[i]));
      atomicMax(nook_group_high[i], nook_ordered(surface.position[i]));
#if NOOK_BODIES == NOOK_FAR_BODIES
      atomicMin(nook_group_normal_low[i], nook_ordered(surface.normal[i]));
      atomicMax(nook_group_normal_high[i], nook_ordered(surface.normal[i]));
#endif
    }
#if NOOK_BODIES == NOOK_FAR_BODIES
    atomicMin(nook_group_minimum, nook_ordered(dot(surface.position, surface.normal)));
#endif
  }
  barrier();
}

// Returns false if the body reduces AO by less than the cut-off at every point of the group, or if the body
// is evaluated only in the other stage.
bool nook_group_keeps(vec4 bound, vec4 parts) {
  vec3 low = nook_numbers(nook_group_low), high = nook_numbers(nook_group_high);
  vec3 nearest = bound.xyz - clamp(bound.xyz, low, high);
  float distance2 = dot(nearest, nearest);
#if NOOK_BODIES == NOOK_FAR_BODIES
  vec3 farthest = max(abs(bound.xyz - low), abs(bound.xyz - high));
  if (nook_world_far_share(dot(farthest, farthest) / parts.z) == 0.0) return false;
  vec3 up = max(bound.xyz * nook_numbers(nook_group_normal_low), bound.xyz * nook_numbers(nook_group_normal_high));
  float height = up.x + up.y + up.z - nook_number(nook_group_minimum);
#else
  if (nook_world_far_share(distance2 / parts.z) == 1.0) return false;
  float height = NOOK_ENDLESS_BOUND;
#endif
  return !nook_world_out_of_reach(bound.w, sqrt(distance2), height);
}

// Reads the bodies of a list, starting at entry `begin`.
void nook_read_bodies(int first, int begin, int count, int thread) {
  barrier();
  if (thread == 0) nook_group_kept = 0u;
  barrier();
  int entry = begin + thread;
  if (thread < NOOK_GROUP_BODIES && entry < count) {
    int body = NOOK_BODY_TEXELS * int(nook_texel(nook_world_casters, first + (entry >> 2))[entry & 3]);
    vec4 bound = nook_texel(nook_world_casters, body), parts = nook_texel(nook_world_casters, body + 1);
    if (nook_group_keeps(bound, parts)) {
      nook_group_bound[thread] = bound;
      nook_group_parts[thread] = parts;
#if NOOK_BODIES == NOOK_FAR_BODIES
      nook_group_texel[2 * thread] = nook_texel(nook_world_casters, body + 2);
      nook_group_texel[2 * thread + 1] = nook_texel(nook_world_casters, body + 3);
#endif
      atomicOr(nook_group_kept, 1u << uint(thread));
    }
  }
  barrier();
}

// Returns the openness of the thread's surface if only this kept body occluded it. All threads of the group
// must call it.
float nook_kept_open(int slot, NookSurface surface, int thread) {
  vec4 bound = nook_group_bound[slot], parts = nook_group_parts[slot];
#if NOOK_BODIES != NOOK_FAR_BODIES
  int texels = NOOK_PART_TEXELS * int(parts.y);
  barrier();
  if (thread < texels) nook_group_texel[thread] = nook_texel(nook_world_casters, int(parts.x) + thread);
  barrier();
#endif
  vec3 d = bound.xyz - surface.position;
  float distance2 = dot(d, d), far = nook_world_far_share(distance2 / parts.z);
  nook_world_weight = NOOK_BODIES == NOOK_FAR_BODIES ? far : 1.0 - far;
  ++nook_world_tested;
  if (!surface.there || nook_world_weight == 0.0 ||
      nook_world_out_of_reach(bound.w, sqrt(distance2), dot(d, surface.normal)))
    return 1.0;
#if NOOK_BODIES == NOOK_FAR_BODIES
  return nook_world_merged_open(nook_group_texel[2 * slot], nook_group_texel[2 * slot + 1], surface.position,
                                surface.normal);
#else
  return nook_world_parts_open(0, texels, surface.position, surface.normal);
#endif
}

#if NOOK_BODIES == NOOK_NEAR_BODIES
// The texels of far bodies around the group's pixels.
#define NOOK_FAR_SIDE (2 * NOOK_WORLD_GROUP_SIZE / NOOK_FAR_STEP + 1)
shared vec4 nook_group_far_place[NOOK_FAR_SIDE * NOOK_FAR_SIDE];  // position; w is 1 if there is a surface
shared vec3 nook_group_far_open[NOOK_FAR_SIDE * NOOK_FAR_SIDE];

ivec2 nook_first_far_texel() {
  return 2 * NOOK_WORLD_GROUP_SIZE * ivec2(gl_WorkGroupID.xy) / NOOK_FAR_STEP;
}

NookFarTexel nook_far_texel(ivec2 texel) {
  ivec2 at = texel - nook_first_far_texel();
  int number = at.y * NOOK_FAR_SIDE + at.x;
  vec4 place = nook_group_far_place[number];
  return NookFarTexel(place.xyz, place.w != 0.0, nook_group_far_open[number]);
}

void nook_read_far(int thread) {
  ivec2 last = (nook_screen_size - 1) / NOOK_FAR_STEP;
  for (int i = thread; i < NOOK_FAR_SIDE * NOOK_FAR_SIDE; i += NOOK_WORLD_GROUP_SIZE * NOOK_WORLD_GROUP_SIZE) {
    ivec2 at = ivec2(i % NOOK_FAR_SIDE, i / NOOK_FAR_SIDE);
    NookFarTexel far = nook_fetch_far(min(nook_first_far_texel() + at, last));
    nook_group_far_place[i] = vec4(far.position, float(far.there));
    nook_group_far_open[i] = far.open;
  }
  barrier();
}
#endif

// `pixel` is the first pixel of the group. All pixels of the group are in the same tile.
float nook_group_open(ivec2 pixel, NookSurface surface, int thread) {
  if (nook_world_tile_columns == 0) return 1.0;
  nook_bound_group(surface, thread);
  ivec2 tile = pixel / nook_world_tile_size;
  vec4 range = nook_texel(nook_world_casters, nook_world_first_tile + tile.y * nook_world_tile_columns + tile.x);
  int first = nook_world_first_tile + int(range.x);
  int count = nook_group_low[0] <= nook_group_high[0] ? int(range.y) : 0;
  float open = 1.0;
  for (int begin = 0; begin < count; begin += NOOK_GROUP_BODIES) {
    nook_read_bodies(first, begin, count, thread);
    for (uint kept = nook_group_kept; kept != 0u; kept &= kept - 1u)
      open *= nook_kept_open(findLSB(kept), surface, thread);
  }
  return open;
}

void main() {
#if NOOK_BODIES == NOOK_FAR_BODIES
  const int stride = NOOK_FAR_STEP;
#else
  const int stride = 2;
#endif
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy), pixel = stride * texel;
  bool inside = nook_inside(pixel, nook_screen_size);
  NookSurface surface = NookSurface(false, vec3(0.0), vec3(0.0, 0.0, 1.0));
  if (inside) surface = nook_world_surface(pixel);
  ivec2 first_pixel = stride * NOOK_WORLD_GROUP_SIZE * ivec2(gl_WorkGroupID.xy);
  float open = nook_group_open(first_pixel, surface, int(gl_LocalInvocationIndex));
#if NOOK_BODIES == NOOK_NEAR_BODIES
  nook_read_far(int(gl_LocalInvocationIndex));
#endif
  if (inside) imageStore(nook_out, texel, nook_world_light(pixel, surface, open));
}
