/* Functions for debugging. You can draw the shapes that a scene evaluates, choose which casters an update
 * evaluates, and query the GPU memory of a model. You can also set debug views and options of the screen pass
 * and the world pass. The shapes of an instance are its proxy spheres and key points in the current pose. You
 * can also read its links and its level of detail. Draw the shapes over your own image to see why the AO of a
 * character is wrong. For example, a sphere may stick out of the body, a bone may not follow, or a neighbour
 * may not be linked.
 *
 * The functions that describe or read an instance do not allocate memory and do not change the scene.
 * nook_scene_set_terms changes which casters the next updates evaluate. Spheres and points follow the current
 * pose; links and levels come from the last update, on the CPU or on OpenGL. */
#ifndef NOOK_DEBUG_H
#define NOOK_DEBUG_H

#include "../nook_character.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_scene_instance_info {
  uint32_t struct_size;
  /* The level of detail of the last update; 0 is full detail. */
  uint32_t level;
  /* The RMS difference in AO between this level and full detail, as the bake measured it; 0 at full
   * detail. */
  float level_error;
  /* The numbers of spheres and key points that are evaluated at this level. */
  uint32_t sphere_count;
  uint32_t key_point_count;
  /* link_count is the number of linked casters that darken the instance. culled_count is the number of linked
   * casters, occluders and grounds that the last update skipped because of cutoff_error. */
  uint32_t link_count;
  uint32_t culled_count;
  /* 1: the last update evaluated the instance. 0: a later update will evaluate the instance (see
   * lod_max_interval). */
  uint32_t updated;
  /* A sphere that contains all spheres and key points of the pose; world space, metres. */
  float bound_centre_ws[3];
  float bound_radius;
} nook_scene_instance_info;

/* Describes an instance.
 * Any thread, while no call changes the scene. Errors: INVALID_ARGUMENT, INVALID_HANDLE. */
NOOK_API nook_result nook_scene_describe_instance(nook_scene scene, nook_instance_id instance,
                                                  nook_scene_instance_info* info);

/* A proxy sphere in the pose of an instance. World space, metres. */
typedef struct nook_scene_sphere {
  float centre_ws[3];
  float radius;
  uint32_t bone;
  /* The weight of the sphere when it darkens another instance, >= 0. */
  float caster_weight;
} nook_scene_sphere;

/* Writes the proxy spheres of an instance at its level. Set *count to the capacity of `out`; the call sets it
 * to the number of spheres. With `out` NULL, the call only sets *count.
 * Any thread, while no call changes the scene. Errors: INVALID_ARGUMENT (`out` is too small),
 * INVALID_HANDLE. */
NOOK_API nook_result nook_scene_read_spheres(nook_scene scene, nook_instance_id instance,
                                             nook_scene_sphere* out, uint32_t* count);

/* A key point in the pose of an instance. World space, metres; normals have unit length. */
typedef struct nook_scene_key_point {
  /* The point at which self-shadow is evaluated. The bake fits its position, so it may lie off the
   * surface. */
  float position_ws[3];
  /* The shadow of the instance's own spheres in the last nook_scene_update, at least 0. It is not yet
   * multiplied by the weights of the vertices. `shadow` is -1 before the first nook_scene_update. OpenGL
   * updates do not set `shadow`, because they keep the shadows on the GPU. */
  float shadow;
  float normal_ws[3];
  /* The occlusion by links, ground and occluders in the last nook_scene_update, in [0, 1], or -1 like
   * `shadow`. With NOOK_FORM_PAPER it is 0, because `shadow` then includes links, ground and occluders. */
  float added;
  /* The point on the surface at which links, ground and occluders are evaluated. */
  float surface_position_ws[3];
  /* The point's index in the model. */
  uint32_t index;
} nook_scene_key_point;

/* Writes the key points of an instance that are evaluated at its level, by ascending index. Set *count to the
 * capacity of `out`; the call sets it to the number of points. With `out` NULL, the call only sets *count.
 * Any thread, while no call changes the scene. Errors: INVALID_ARGUMENT (`out` is too small),
 * INVALID_HANDLE. */
NOOK_API nook_result nook_scene_read_key_points(nook_scene scene, nook_instance_id instance,
                                                nook_scene_key_point* out, uint32_t* count);

/* Writes the instances that darken an instance by links (nook_scene_link and nook_scene_link_nearest).
 * Casters that the last update skipped are left out. After you remove any instance from the scene, the call
 * finds no casters until the next update. Set *count to the capacity of `out`; the call sets it to the number
 * of casters. With `out` NULL, the call only sets *count. Any thread, while no call changes the scene.
 * Errors: INVALID_ARGUMENT (`out` is too small), INVALID_HANDLE. */
NOOK_API nook_result nook_scene_read_links(nook_scene scene, nook_instance_id instance, nook_instance_id* out,
                                           uint32_t* count);

/* The casters that an update can leave out. */
enum {
  NOOK_TERM_SELF = 1,
  NOOK_TERM_LINKS = 2,
  NOOK_TERM_GROUND = 4,
  NOOK_TERM_OCCLUDERS = 8,
  NOOK_TERM_ALL = 15
};

/* Chooses the casters that updates evaluate, for debug views. `terms` is a sum of NOOK_TERM_ values; default
 * NOOK_TERM_ALL. Without NOOK_TERM_SELF, the bias of the fit is left out too, so that an instance without
 * other casters has AO 1. One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_scene_set_terms(nook_scene scene, uint32_t terms);

/* ---- Memory of a model on the GPU ---- */

/* The OpenGL memory of a model, in bytes, as nook_gl_info.buffer_bytes counts it. */
typedef struct nook_gl_memory {
  uint32_t struct_size;
  uint32_t reserved;
  /* The bytes that all instances of the model share. */
  uint64_t model_bytes;
  /* The bytes of one instance, without links. */
  uint64_t instance_bytes;
  /* The bytes of one instance that has a light. */
  uint64_t lit_instance_bytes;
} nook_gl_memory;

/* Computes the OpenGL memory of a model before you use it. The memory in use can be up to 50 % more, because
 * buffers are enlarged in large steps. The call makes no OpenGL call. One at a time. Errors:
 * INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_model_memory(nook_gl gl, nook_model model, nook_gl_memory* memory);

/* ---- Debug descriptors: for `next` of a descriptor of the screen pass or the world pass ---- */

/* Where the network of the screen pass runs. All other stages are always draws. Both paths give the same AO;
 * on Mesa's llvmpipe, it is bit-identical. */
enum {
  /* Uses a compute shader if OpenGL supports it, otherwise a fragment shader. On OpenGL ES, always uses a
   * fragment shader. */
  NOOK_NNAO_PATH_AUTOMATIC = 0,
  /* The network runs in a fragment shader. This works on OpenGL 3.3, OpenGL ES 3.0 and WebGL 2. */
  NOOK_NNAO_PATH_FRAGMENT = 1,
  /* The network runs in a compute shader. This needs OpenGL 4.3 or OpenGL ES 3.1, the function
   * glBindImageTexture, and a nook_gl_desc.max_tier that allows compute shaders. On OpenGL ES, AO takes four
   * bytes per pixel, because compute shaders cannot write one-byte images there. */
  NOOK_NNAO_PATH_COMPUTE = 2
};
typedef int32_t nook_nnao_path;

/* Which sample of a multisampled depth texture gives the pixel its depth and, with
   nook_nnao_desc.normal_samples, its normal. */
enum {
  /* The sample with the median depth, or of two samples the nearer one. If one surface covers most of the
   * pixel, this sample is on that surface. */
  NOOK_NNAO_SAMPLE_MEDIAN = 0,
  /* Sample 0. */
  NOOK_NNAO_SAMPLE_FIRST = 1,
  /* The nearest sample. */
  NOOK_NNAO_SAMPLE_NEAREST = 2
};
typedef int32_t nook_nnao_sample;

/* Settings of a screen pass for tests and measurements. Point nook_nnao_desc.next to this struct. */
typedef struct nook_nnao_debug_desc {
  uint32_t struct_size, type;
  const void* next;
  /* Default NOOK_NNAO_PATH_AUTOMATIC. */
  nook_nnao_path path;
  /* Default NOOK_NNAO_SAMPLE_MEDIAN, which had the smallest error in measurements (docs/nnao.md). */
  nook_nnao_sample depth_sample;
  /* 1: the pass measures the time of every stage, for nook_nnao_read_timings of experimental/nook_stages.h.
   * Default 0. */
  int32_t timers;
} nook_nnao_debug_desc;
static inline nook_result nook_nnao_debug_desc_init(nook_nnao_debug_desc* desc) {
  return nook_desc_init(NOOK_DESC_NNAO_DEBUG, desc, sizeof *desc, NOOK_VERSION);
}

/* What the screen pass shows. */
enum {
  /* The result. */
  NOOK_NNAO_VIEW_AO = 0,
  /* The network's AO of this frame, before filter, intensity, power and G-buffer AO are applied. */
  NOOK_NNAO_VIEW_RAW = 1,
  /* The AO after the filter, without intensity, power and G-buffer AO. */
  NOOK_NNAO_VIEW_BLURRED = 2,
  /* The normals that the network used, as (n + 1) / 2 in red, green and blue. Not with
   * NOOK_TARGET_OWN. */
  NOOK_NNAO_VIEW_NORMALS = 3
};
typedef int32_t nook_nnao_view;

/* A debug view of the screen pass. Point nook_nnao_frame_desc.next to this struct. */
typedef struct nook_nnao_frame_debug_desc {
  uint32_t struct_size, type;
  const void* next;
  /* Default NOOK_NNAO_VIEW_AO. */
  nook_nnao_view show;
} nook_nnao_frame_debug_desc;
static inline nook_result nook_nnao_frame_debug_desc_init(nook_nnao_frame_debug_desc* desc) {
  return nook_desc_init(NOOK_DESC_NNAO_FRAME_DEBUG, desc, sizeof *desc, NOOK_VERSION);
}

/* What the world pass shows. */
enum {
  /* The result. */
  NOOK_WORLD_VIEW_AO = 0,
  /* The number of casters that each pixel evaluates, divided by 255. At half resolution, a caster of a far
   * body is weighted by the fraction of the pixels that evaluate it. */
  NOOK_WORLD_VIEW_CASTERS = 1,
  /* The number of exact capsules that each pixel evaluates, divided by 255. Exact capsules are the capsules
   * of a model or of nook_world_frame_desc. A merged capsule that replaces a whole limb or body is not
   * counted. */
  NOOK_WORLD_VIEW_EXACT_CASTERS = 2,
  /* The number of bodies for which each pixel tests whether it lies within the body's reach, divided by
   * 255. */
  NOOK_WORLD_VIEW_TESTS = 3,
  /* The number of far bodies that the pixels of the half-resolution stage evaluate, interpolated to all
   * pixels; divided by 255. The view shows 0 if the pass has full resolution. */
  NOOK_WORLD_VIEW_FAR_CASTERS = 4,
  /* The number of far bodies for which each pixel of the half-resolution stage tests whether it lies within
   * the body's reach, interpolated to all pixels; divided by 255. */
  NOOK_WORLD_VIEW_FAR_TESTS = 5
};
typedef int32_t nook_world_view;

/* A debug view of the world pass. Point nook_world_frame_desc.next to this struct. */
typedef struct nook_world_frame_debug_desc {
  uint32_t struct_size, type;
  const void* next;
  /* Default NOOK_WORLD_VIEW_AO. */
  nook_world_view show;
} nook_world_frame_debug_desc;
static inline nook_result nook_world_frame_debug_desc_init(nook_world_frame_debug_desc* desc) {
  return nook_desc_init(NOOK_DESC_WORLD_FRAME_DEBUG, desc, sizeof *desc, NOOK_VERSION);
}

#ifdef __cplusplus
}
#endif
#endif
