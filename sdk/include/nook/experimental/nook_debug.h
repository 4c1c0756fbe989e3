/* Shapes for debug drawing, the terms that updates evaluate, and the memory of a model on the GPU. The shapes
 * show the parts that a scene evaluates: the proxy spheres and key points of an instance in its pose, its
 * links, and its level of detail. A host draws them over its own picture to see why a character is dark: a
 * sphere that sticks out of the body, a bone that does not follow, a neighbour that is not linked.
 *
 * Calls that describe or read do not allocate and change nothing. nook_scene_set_terms changes what the next
 * updates evaluate, and nook_gl_model_memory gives the memory of a model on the GPU. Spheres and points
 * follow the pose that is set; links and levels are those of the last update, on the CPU or on OpenGL. */
#ifndef NOOK_DEBUG_H
#define NOOK_DEBUG_H

#include "../nook_character.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_scene_instance_info {
  /* sizeof(nook_scene_instance_info); the caller sets it. */
  uint32_t struct_size;
  /* The level of detail of the last update; 0 is full detail. */
  uint32_t level;
  /* AO, root mean square: the error of this level against full detail, as the bake measured it; 0 at full
   * detail. */
  float level_error;
  /* The numbers of spheres and key points that are evaluated at this level. */
  uint32_t sphere_count;
  uint32_t key_point_count;
  /* The numbers of linked casters that darken the instance, and of linked casters, occluders and ground that
   * the last update skipped because of cutoff_error. */
  uint32_t link_count;
  uint32_t culled_count;
  /* 1 if the last update evaluated the instance, 0 if its turn comes later (lod_max_interval). */
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
  /* The share of the sphere that counts where it darkens another instance, >= 0. */
  float caster_weight;
} nook_scene_sphere;

/* Writes the proxy spheres of an instance at its level. *count is the room in `out`, and becomes the number
 * of spheres; with out NULL only that is written.
 * Any thread, while no call changes the scene. Errors: INVALID_ARGUMENT (there is too little room),
 * INVALID_HANDLE. */
NOOK_API nook_result nook_scene_read_spheres(nook_scene scene, nook_instance_id instance,
                                             nook_scene_sphere* out, uint32_t* count);

/* A key point in the pose of an instance. World space, metres; normals have unit length. */
typedef struct nook_scene_key_point {
  /* Where the self-shadow is evaluated. The fit may leave it beside the surface. */
  float position_ws[3];
  /* The shadow of the instance's own spheres in the last nook_scene_update, >= 0, before the weights of the
   * vertices. Updates on OpenGL keep theirs on the GPU: it is -1 before the first nook_scene_update. */
  float shadow;
  float normal_ws[3];
  /* The occlusion by links, ground and occluders in the last nook_scene_update, in [0, 1], or -1 like the
   * shadow. It is 0 with NOOK_FORM_PAPER, where they count in the shadow. */
  float added;
  /* Where links, ground and occluders are evaluated: a point on the surface. */
  float surface_position_ws[3];
  /* The point's index in the model. */
  uint32_t index;
} nook_scene_key_point;

/* Writes the key points of an instance that are evaluated at its level, by ascending index. *count is the
 * room in `out`, and becomes the number of points; with out NULL only that is written.
 * Any thread, while no call changes the scene. Errors: INVALID_ARGUMENT (there is too little room),
 * INVALID_HANDLE. */
NOOK_API nook_result nook_scene_read_key_points(nook_scene scene, nook_instance_id instance,
                                                nook_scene_key_point* out, uint32_t* count);

/* Writes the instances that darken an instance by links, those of nook_scene_link and the nearest ones. They
 * are the casters of its last update that matter; between the removal of an instance and the next update
 * there are none. *count is the room in `out`, and becomes the number of casters; with out NULL only that is
 * written.
 * Any thread, while no call changes the scene. Errors: INVALID_ARGUMENT (there is too little room),
 * INVALID_HANDLE. */
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

/* Chooses the casters that updates evaluate, a sum of NOOK_TERM_ values, for debug views and artists; default
 * NOOK_TERM_ALL. Without NOOK_TERM_SELF the bias of the fit is left out as well, so that an instance without
 * added casters is open.
 * One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_scene_set_terms(nook_scene scene, uint32_t terms);

/* ---- Memory of a model on the GPU ---- */

/* The OpenGL memory of a model, in bytes, as nook_gl_info.buffer_bytes counts it. */
typedef struct nook_gl_memory {
  /* sizeof(nook_gl_memory); the caller sets it. */
  uint32_t struct_size;
  uint32_t reserved;
  /* The bytes that all instances of the model share. */
  uint64_t model_bytes;
  /* The bytes of one instance, without links. */
  uint64_t instance_bytes;
  /* The same with a light. */
  uint64_t lit_instance_bytes;
} nook_gl_memory;

/* Computes the OpenGL memory of a model before any of it is used; buffers that grow have up to half as much
 * again. The call makes no OpenGL call. One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_gl_model_memory(nook_gl gl, nook_model model, nook_gl_memory* memory);

#ifdef __cplusplus
}
#endif
#endif
